"""SolidSection: base of sections of one material."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar

import numpy as np

from acausal import geometry
from components.beams.sections.section import Section


class SolidSection(ABC):
    """A section of one material, with its centroid and its shear centre on the axis of the beam."""

    angle: Any = 0.0
    profile: ClassVar[geometry.Profile] = "ellipse"

    @property
    @abstractmethod
    def A(self) -> Any:
        """Area in m2."""

    @property
    @abstractmethod
    def J_y(self) -> Any:
        """Second moment of area about y in m4."""

    @property
    @abstractmethod
    def J_z(self) -> Any:
        """Second moment of area about z in m4."""

    @property
    @abstractmethod
    def J_t(self) -> Any:
        """Torsion constant in m4."""

    @abstractmethod
    def shear_factor(self, nu: Any) -> Any:
        """Shear factor of Timoshenko's beam at Poisson's ratio nu."""

    @property
    def half_axes(self) -> tuple[Any, Any]:
        """Half-axes of the drawn profile along y and z in m: of the ellipse with the same radii of gyration."""
        return 2 * np.sqrt(self.J_z / self.A), 2 * np.sqrt(self.J_y / self.A)

    def section(self, E: Any, G: Any, rho: Any) -> Section:
        """Return the section of a material with the moduli E and G in Pa and the density rho in kg/m3."""
        kGA = self.shear_factor(E / (2 * G) - 1) * G * self.A
        J_y, J_z = self.J_y, self.J_z
        return Section(
            E * self.A, E * J_y, E * J_z, G * self.J_t, rho * self.A, rho * J_y, rho * J_z, kGA, kGA, angle=self.angle
        )
