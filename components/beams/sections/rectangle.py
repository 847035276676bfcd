"""Rectangle: solid rectangular section."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Any, ClassVar

import numpy as np

from acausal import geometry
from components.beams.sections.solid import SolidSection

# The sum of 1 / n^5 over odd n, 31/32 zeta(5).
ODD_FIFTH = 1.0045237627951384


@dataclass(frozen=True)
class Rectangle(SolidSection):
    """Solid rectangular section.

    Parameters
    ----------
    width, height : float
        Lengths of the sides along y and along z in m.
    angle : float
        Angle in rad by which the section is turned about x.
    """

    width: Any
    height: Any
    angle: Any = 0.0
    profile: ClassVar[geometry.Profile] = "rectangle"

    @property
    def half_axes(self) -> tuple[Any, Any]:
        """Half-axes of the drawn profile along y and z in m."""
        return self.width / 2, self.height / 2

    @property
    def A(self) -> Any:
        """Area in m2."""
        return self.width * self.height

    @property
    def J_y(self) -> Any:
        """Second moment of area about y in m4."""
        return self.width * self.height**3 / 12

    @property
    def J_z(self) -> Any:
        """Second moment of area about z in m4."""
        return self.height * self.width**3 / 12

    @property
    def J_t(self) -> Any:
        """Torsion constant in m4, with the longer side a and the shorter side b:

        J_t = a b^3 (1/3 - 64 / pi^5 (b / a) sum of tanh(n pi a / 2 b) / n^5 over odd n)

        (Timoshenko, Goodier, Theory of Elasticity, section 109). The sum of 1 / n^5 is exact; of 1 - tanh, three terms
        are exact to 1e-13.
        """
        w, h = self.width, self.height
        apart = np.sqrt((w - h) * (w - h))
        a, b = (w + h + apart) / 2, (w + h - apart) / 2
        total = ODD_FIFTH - sum((1 - np.tanh(n * pi / 2 * a / b)) / n**5 for n in (1, 3, 5))
        return a * b**3 * (1 / 3 - 64 / pi**5 * (b / a) * total)

    def shear_factor(self, nu: Any) -> Any:
        """Shear factor 5/6."""
        return 5 / 6
