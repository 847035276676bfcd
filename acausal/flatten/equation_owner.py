"""Ownership of equations by the user's model or by parts, and messages on contradictions."""

from __future__ import annotations

from collections.abc import Iterable
from types import FunctionType

from acausal.errors import PACKAGE
from acausal.flatten.origin import Origin
from acausal.language.component import Component

MOST = 5  # equations listed in a message


def is_stated_by_user(tree: Component, origin: Origin) -> bool:
    """Return whether an equation is stated in a file of the model's own classes, where a mistake is most likely.

    Parameters
    ----------
    tree : Component
        Bound model.
    origin : Origin
        Origin of the equation.
    """
    methods = [value for c in type(tree).__mro__ for value in vars(c).values() if isinstance(value, FunctionType)]
    files = {method.__code__.co_filename for method in methods}
    return origin.where.rpartition(":")[0] in {f for f in files if not f.startswith(PACKAGE)}


def contradiction_text(tree: Component, wrong: list[tuple[Origin, float]], others: Iterable[Origin]) -> str:
    """Return the message for equations that contradict each other for all values of their unknowns, the user's first.

    Parameters
    ----------
    tree : Component
        Bound model.
    wrong : list of (Origin, float)
        Equations without remaining unknowns, and the difference of their sides.
    others : iterable of Origin
        Equations that eliminated their unknowns.
    """
    own = {origin: f": its sides differ by {value:.6g}" for origin, value in wrong[:MOST]}
    every = own | {origin: "" for origin in others if origin not in own}
    groups = [
        [f"  {o}{text}" for o, text in every.items() if is_stated_by_user(tree, o) == users] for users in (True, False)
    ]
    first, second = groups if all(groups) else ([*groups[0], *groups[1]], [])
    one = len(first) == 1
    what = "this equation contradicts" if one else "these equations contradict"
    lines = [
        f"{what} {'others' if second else 'each other'}, whatever the values of {'its' if one else 'their'} unknowns:"
    ]
    lines += first[:MOST] + (["The others:", *second[:MOST]] if second else [])
    return "\n".join(
        [*lines, "A length, position or value is given twice with different values; remove one or make them agree."]
    )
