"""Rotary inertia of the sections of a beam."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from acausal import as_expr, cross, dot
from components.beams.element import beam_matrices


@dataclass(frozen=True)
class Sections:
    """Sections of N elements that rotate with the frame and, about z, with the slope of the axis.

    The angular velocity of a section is w + (0, 0, dv'/dt), resolved in the frame.

    Parameters
    ----------
    elements : int
        N.
    l : Expr
        Length of an element in m.
    I : Expr, shape (3,)
        Moments of inertia of all sections about x, y and z in kg.m2; a zero entry has no effect.
    Ud, Udd : Expr, shape (3 N + 3,)
        Derivatives of the nodal coordinates in m/s and m/s2.
    coriolis : bool
        Whether products of deformation rates and angular velocity are included.
    """

    elements: int
    l: Any
    I: Any
    Ud: Any
    Udd: Any
    coriolis: bool

    @property
    def _per_length(self) -> Any:
        return self.I[2] / (self.elements * self.l)

    def _spin(self, U: Any) -> Any:
        return self._per_length * (U[-2] - U[1])

    def moment(self, z: Any, w: Any) -> Any:
        """Inertia moment in N.m; angular acceleration and angular velocity of the frame are resolved in it."""
        h = self._spin(self.Ud) if self.coriolis else 0.0
        relative = as_expr((w[1] * h, -w[0] * h, self._spin(self.Udd)))
        return self.I * z + cross(w, self.I * w) + relative

    def nodal(self, z: Any) -> Any:
        """Nodal forces of inertia in N, shape (3 N + 3,)."""
        turning = self._per_length / self.l * (beam_matrices(self.elements).G @ self.Udd)
        entries = [turning[k] for k in range(3 * self.elements + 3)]
        entries[1] -= self._per_length * z[2]
        entries[-2] += self._per_length * z[2]
        return as_expr(entries)

    def kinetic_energy(self, w: Any) -> Any:
        """Kinetic energy in J."""
        own = self._per_length / self.l * dot(self.Ud, beam_matrices(self.elements).G @ self.Ud)
        return (dot(w, self.I * w) + 2 * w[2] * self._spin(self.Ud) + own) / 2
