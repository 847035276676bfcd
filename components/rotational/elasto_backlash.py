"""ElastoBacklash: a torsional spring and damper with backlash."""

from __future__ import annotations

from acausal import Expr, Scalar, parameter, piecewise
from components.rotational.compliant import Compliant
from components.thermal.heat_loss import HeatLoss

# Backlash in rad below which there is none: else both ends of it would be passed at one instant (as in Modelica).
B_EPS = 1e-10


class ElastoBacklash(HeatLoss, Compliant):
    """Torsional spring and damper that act beyond the backlash, b / 2 to either side of phi_rel0.

    Notes
    -----
    The torque of the damper is limited to that of the spring, so that the sum pushes only and is continuous.
    """

    c: Scalar = parameter("spring constant", unit="N.m/rad", minimum=0)
    d: Scalar = parameter("damping constant", unit="N.m.s/rad", default=0, minimum=0)
    b: Scalar = parameter("total backlash", unit="rad", default=0, minimum=0)
    phi_rel0: Scalar = parameter(
        "relative angle in the middle of the backlash", unit="rad", default=0, doc="There it bears no torque."
    )

    def law(self):
        """Spring and limited damper beyond the backlash, else nothing."""
        phi, w = self.phi_rel - self.phi_rel0, self.w_rel
        yield self.tau == piecewise(
            (self.c * phi + self.d * w, self.b <= B_EPS),
            (self.push(phi - self.b / 2, w), phi > self.b / 2),
            (-self.push(-phi - self.b / 2, -w), phi < -self.b / 2),
            0,
        )

    def push(self, depth: Expr, rate: Expr) -> Expr:
        """Torque at a depth > 0 beyond the backlash that changes at this rate."""
        spring, damper = self.c * depth, self.d * rate
        return piecewise((0, damper < -spring), (2 * spring, damper > spring), spring + damper)

    def spring(self) -> Expr:
        """Torque of the spring."""
        phi, half = self.phi_rel - self.phi_rel0, self.b / 2
        return piecewise((self.c * (phi - half), phi > half), (self.c * (phi + half), phi < -half), 0)

    def stored_energy(self):
        """Elastic energy."""
        return self.spring() ** 2 / (2 * self.c)

    def loss(self):
        """Power of the damper."""
        return (self.tau - self.spring()) * self.w_rel
