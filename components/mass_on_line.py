"""MassOnLine: base of line forces with a point mass on the line."""

from __future__ import annotations

from typing import Any

from acausal import Expr, Scalar, dot, outer, parameter
from components.line_force import LineForce
from components.orientation import resolve1
from components.world import World


class MassOnLine(LineForce):
    """Base of line forces with a point mass at a fraction of the line from frame_a to frame_b.

    Notes
    -----
    The inertia load m (a - g) of the mass at the fraction h acts with the weight 1 - h at frame_a and h at frame_b.
    """

    m: Scalar = parameter("mass of the point mass on the line", unit="kg", default=0, minimum=0)
    length_fraction: Scalar = parameter(
        "position of the mass as a fraction of the line, from frame_a", unit="1", default=0.5, minimum=0
    )
    world: World = outer(World)

    def inertia_loads(self, e_0: Any) -> tuple[Any, Any]:
        """Inertia load of the mass, divided between the ends."""
        a, b, h = self.frame_a, self.frame_b, self.length_fraction
        acceleration = (1 - h) * resolve1(a.R, a.a) + h * resolve1(b.R, b.a)
        force = self.m * (acceleration - self.world.acceleration(self._position()))
        return (1 - h) * force, h * force

    def stored_energy(self):
        """Kinetic and potential energy of the mass."""
        v = self._velocity()
        return self.m * (dot(v, v) / 2 + self.world.gravity_potential(self._position()))

    def supplied_power(self):
        """Power of gravity without a potential."""
        return self.world.power(self.m, self._position(), self._velocity())

    def _position(self) -> Expr:
        return self.frame_a.r_0 + self.length_fraction * (self.frame_b.r_0 - self.frame_a.r_0)

    def _velocity(self) -> Expr:
        a, b, h = self.frame_a, self.frame_b, self.length_fraction
        return (1 - h) * resolve1(a.R, a.v) + h * resolve1(b.R, b.v)
