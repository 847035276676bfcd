"""RoundSection: base of sections between two concentric circles."""

from __future__ import annotations

from math import pi
from typing import Any

from components.beams.sections.solid import SolidSection


class RoundSection(SolidSection):
    """Section between the diameters d_o and d_i in m."""

    d_o: Any
    d_i: Any

    @property
    def half_axes(self) -> tuple[Any, Any]:
        """Half-axes of the drawn profile along y and z in m."""
        return self.d_o / 2, self.d_o / 2

    @property
    def A(self) -> Any:
        """Area in m2."""
        return pi / 4 * (self.d_o**2 - self.d_i**2)

    @property
    def J_y(self) -> Any:
        """Second moment of area about y in m4."""
        return pi / 64 * (self.d_o**4 - self.d_i**4)

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
        m = (self.d_i / self.d_o) ** 2
        whole = (1 + m) * (1 + m)
        return 6 * (1 + nu) * whole / ((7 + 6 * nu) * whole + (20 + 12 * nu) * m)
