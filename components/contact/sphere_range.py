"""Where the theory of contacts between spheres is valid."""

from __future__ import annotations

from typing import Any

from acausal import expect

SHARE = 0.1  # of the radius: there the radius of the area of contact is 30 % of that of the sphere, which Hertz takes as small


def shallow(x: Any, radius: Any) -> Any:
    """Expect that the penetration is small compared with the radius."""
    text = (
        "its sphere is pressed in by more than a tenth of its radius, where the force of a contact is no longer k x^1.5; take "
        "a greater `k`"
    )
    return expect((x + abs(x)) / 2, radius, SHARE, text)
