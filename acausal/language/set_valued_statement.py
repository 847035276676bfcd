"""Set-valued force laws: `yield set_valued(speed, limit=..., ...)`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_call
from acausal.language.expression import Expr, as_expr
from acausal.language.functions import der


@dataclass(frozen=True)
class SetValued:
    """A force that takes any value up to `limit` where `speed`, whose derivative is `rate`, rests; see `set_valued`."""

    speed: Expr
    rate: Expr
    limit: Expr
    mode: Expr
    offset: Expr
    shared: Expr
    share: Expr
    slip: Expr


@checked_call
def set_valued(speed: Any, *, limit: Any, mode: Any, offset: Any, shared: Any, share: Any, slip: Any) -> SetValued:
    """Declare a force set-valued: where a speed rests, it takes any value up to a limit.

    Yield it in equations() beside the law of the force and the conditions at which its mode changes, as
    `components.rotational.Slipping` does. All arguments but the speed and the limit are scalar discrete variables. At an
    instant at which `mode` becomes 0 or leaves it, all such laws at rest are decided together, from the acceleration that each
    force makes (Pfeiffer and Glocker 1996, Multibody Dynamics with Unilateral Contacts). Then a law

    - sticks, `mode` 0 and `shared` 0: its speed stays as it is;
    - rests while others keep it at rest, `mode` 0 and `shared` 1: its force is `share` times the limit;
    - slides, `mode` 1 or -1, also where the force does not change the acceleration, as at a joint that the rest of a machine
      carries through rest.

    Parameters
    ----------
    speed : Expr
        Speed that the force resists.
    limit : Expr
        Greatest force at rest. Its product with the speed is a power.
    mode : Expr
        Sense of the speed, 1 or -1; 0 at rest.
    offset : Expr
        Speed at the last decision, 0 but for rounding.
    shared, share : Expr
        Whether the force is a share of the limit, and which, from -1 to 1.
    slip : Expr
        Change of the speed beyond which a law with a share no longer rests; 0 until it is decided.
    """
    given = {"mode": mode, "offset": offset, "shared": shared, "share": share, "slip": slip}
    for name, value in given.items():
        if not isinstance(value, Expr) or not value.name or value.shape:
            raise DeclarationError(f"set_valued needs a scalar discrete variable as `{name}`, not {value!r}.")
    pair = as_expr(speed), as_expr(limit)
    for name, value in zip(("speed", "limit"), pair, strict=True):
        if value.shape:
            raise DeclarationError(f"set_valued needs a scalar as `{name}`, not a value of shape {value.shape}.")
    return SetValued(pair[0], der(pair[0]), pair[1], **given)
