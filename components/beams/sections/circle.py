"""Circle: solid circular section."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Any

from components.beams.sections.solid import SolidSection


@dataclass(frozen=True)
class Circle(SolidSection):
    """Solid circular section.

    Parameters
    ----------
    d : float
        Diameter in m.
    """

    d: Any
    angle = 0.0

    @property
    def A(self) -> Any:
        """Area in m2."""
        return pi / 4 * self.d**2

    @property
    def J_y(self) -> Any:
        """Second moment of area about y in m4."""
        return pi / 64 * self.d**4

    @property
    def J_z(self) -> Any:
        """Second moment of area about z in m4."""
        return self.J_y

    @property
    def J_t(self) -> Any:
        """Torsion constant in m4, the polar moment."""
        return 2 * self.J_y

    def shear_factor(self, nu: Any) -> Any:
        """Shear factor (Cowper, The shear coefficient in Timoshenko's beam theory, 1966)."""
        return 6 * (1 + nu) / (7 + 6 * nu)
