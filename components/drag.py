"""Drag: aerodynamic drag of a body."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, Vector3, dot, input, parameter, port, quantity, sqrt, variable
from components.frame import Frame, force_arrow
from components.orientation import resolve1, resolve2

# Added to a squared speed in (m/s)2: below round-off of any relevant speed; it makes the root differentiable at rest.
NOTHING = 1e-30


class Drag(Component):
    """Drag of air or another fluid at the origin of frame_b, proportional to the square of the speed.

    Notes
    -----
    The force on the connected part is -rho c_d A |u| u / 2 with u = v - v_wind, independent of the direction of u.
    """

    ends = ("frame_b", "frame_b")
    frame_b: Frame = port(Frame, "point of application")
    c_d: Scalar = parameter("drag coefficient", unit="1", minimum=0)
    A: Scalar = parameter("cross-section", unit="m2", minimum=0)
    rho: Scalar = parameter(
        "density of the fluid", unit="kg/m3", default=1.2, minimum=0, doc="Default: air at 20 degrees Celsius."
    )
    v_wind: Vector3 = input("velocity of the fluid, resolved in the world", unit="m/s", default=(0, 0, 0))
    f: Vector3 = variable("force on the connected part, resolved in the world", unit="N")

    def equations(self):
        b, u = self.frame_b, self._relative()
        speed = sqrt(dot(u, u) + quantity(NOTHING, "m2/s2"))
        yield self.f == -self.rho * self.c_d * self.A / 2 * speed * u
        yield b.f == -resolve2(b.R, self.f)
        yield b.t == (0, 0, 0)

    def dissipated_power(self):
        """Power dissipated in the fluid."""
        return -dot(self.f, self._relative())

    def supplied_power(self):
        """Power of the wind."""
        return dot(self.f, self.v_wind)

    def shapes(self):
        """The force."""
        yield force_arrow(self.frame_b)

    def _relative(self) -> Any:
        """Velocity relative to the fluid, resolved in the world."""
        return resolve1(self.frame_b.R, self.frame_b.v) - self.v_wind
