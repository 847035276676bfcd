"""Range of validity of Hertz contacts of spheres."""

from __future__ import annotations

from typing import Any

from acausal import expect

SHARE = 0.1  # penetration over radius: the contact radius, small in Hertz's theory, is then 30 % of that of the sphere


def shallow(x: Any, radius: Any) -> Any:
    """Expect a penetration that is small compared with the radius."""
    text = "the penetration of the sphere exceeds a tenth of its radius, beyond the range of the Hertz law k x^1.5; increase `k`"
    return expect((x + abs(x)) / 2, radius, SHARE, text)
