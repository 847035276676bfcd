"""LineForceWithTwoMasses: line force defined by one-dimensional translational parts, with two point masses."""

from __future__ import annotations

from typing import Any

from acausal import Expr, Scalar, der, dot, outer, parameter, port
from components.line_force import LineForce
from components.translational.flange import TranslationalFlange
from components.world import World


class LineForceWithTwoMasses(LineForce):
    """Force of the parts between flange_a and flange_b along the line from frame_a to frame_b, which carries two masses.

    Notes
    -----
    The masses have constant distances from the ends, like those of a cylinder and its piston rod. The position of flange_a
    is 0, that of flange_b the length of the line; connect both.
    """

    m_a: Scalar = parameter("mass near frame_a", unit="kg", default=0, minimum=0)
    m_b: Scalar = parameter("mass near frame_b", unit="kg", default=0, minimum=0)
    L_a: Scalar = parameter("distance of m_a from frame_a, towards frame_b", unit="m", default=0)
    L_b: Scalar = parameter(
        "distance of m_b from frame_b, towards frame_a", unit="m", default=lambda s: s.L_a, doc="L_a if not given."
    )
    world: World = outer(World)
    flange_a: TranslationalFlange = port(TranslationalFlange, "at frame_a")
    flange_b: TranslationalFlange = port(TranslationalFlange, "at frame_b")

    def law(self):
        """Flange positions from the line, and the force."""
        yield self.flange_a.s == 0
        yield self.flange_b.s == self.s
        yield self.f == self.flange_a.f

    def pulls(self) -> tuple[Any, Any]:
        """Flange forces."""
        return self.f, -self.flange_b.f

    def inertia_loads(self, e_0: Any) -> tuple[Any, Any]:
        """Inertia loads of the masses; their moments about the ends are balanced by transverse end forces."""
        force_a, force_b = (m * (der(der(r)) - self.world.acceleration(r)) for m, r in self._masses(e_0))
        turning = force_a * (self.L_a / self.s) - force_b * (self.L_b / self.s)
        turning = turning - dot(turning, e_0) * e_0
        return force_a - turning, force_b + turning

    def stored_energy(self):
        """Kinetic and potential energy of the masses."""
        energy = 0.0
        for m, r in self._masses((self.frame_b.r_0 - self.frame_a.r_0) / self.s):
            v = der(r)
            energy = energy + m * (dot(v, v) / 2 + self.world.gravity_potential(r))
        return energy

    def supplied_power(self):
        """Power of gravity without a potential."""
        masses = self._masses((self.frame_b.r_0 - self.frame_a.r_0) / self.s)
        return sum(self.world.power(m, r, der(r)) for m, r in masses)

    def _masses(self, e_0: Any) -> tuple[tuple[Expr, Expr], tuple[Expr, Expr]]:
        """Masses and their positions, resolved in the world."""
        return (self.m_a, self.frame_a.r_0 + e_0 * self.L_a), (self.m_b, self.frame_b.r_0 - e_0 * self.L_b)
