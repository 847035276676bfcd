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
    """A force of any value up to `limit` while `speed`, whose derivative is `rate`, is 0; see `set_valued`."""

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
    """State a set-valued force law: while a speed is 0, the force takes any value up to a limit.

    Yield it in equations() beside the law of the force and the conditions at which its mode changes, as
    `components.rotational.Slipping` does. All arguments but the speed and the limit are scalar discrete variables. At
    an event at which a `mode` becomes 0 or nonzero, all set-valued laws at rest are decided together, from the
    accelerations that the forces cause (Pfeiffer and Glocker 1996, Multibody Dynamics with Unilateral Contacts). Then a
    law

    - sticks, `mode` 0 and `shared` 0: its speed is constant;
    - is kept at rest by other laws, `mode` 0 and `shared` 1: its force is `share` times the limit;
    - slides, `mode` 1 or -1; also if its force does not change the acceleration, as at a joint whose motion the rest of
      the machine prescribes.

    Parameters
    ----------
    speed : Expr
        Speed that the force resists.
    limit : Expr
        Largest force at rest; its product with the speed is a power.
    mode : Expr
        Sign of the speed, 1 or -1; 0 at rest.
    offset : Expr
        Speed at the last decision, 0 except for round-off.
    shared, share : Expr
        1 if the force is a share of the limit, and that share, from -1 to 1.
    slip : Expr
        Change of the speed beyond which a law with a share is no longer at rest; 0 before its decision.
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
