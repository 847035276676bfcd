"""ElastoBacklash: torsional spring and damper with backlash."""

from __future__ import annotations

from acausal import Expr, Scalar, parameter, piecewise
from components.rotational.compliant import Compliant
from components.thermal.heat_loss import HeatLoss

# Backlash in rad that counts as 0: the events at its two ends would otherwise coincide (value of the Modelica library).
B_EPS = 1e-10


class ElastoBacklash(HeatLoss, Compliant):
    """Torsional spring and damper in series with a backlash of b / 2 on either side of phi_rel0.

    Notes
    -----
    The damper torque is limited to the spring torque, so that the sum is continuous and never adhesive.

    Between `support` and `axis` of a Revolute it is a stop: the joint is free within b / 2 of phi_rel0.
    """

    c: Scalar = parameter("spring constant", unit="N.m/rad", minimum=0)
    d: Scalar = parameter("damping constant", unit="N.m.s/rad", default=0, minimum=0)
    b: Scalar = parameter("total backlash", unit="rad", default=0, minimum=0)
    phi_rel0: Scalar = parameter(
        "relative angle in the middle of the backlash", unit="rad", default=0, doc="The torque is 0 there."
    )

    def law(self):
        """Spring and limited damper beyond the backlash, 0 within it."""
        phi, w = self.phi_rel - self.phi_rel0, self.w_rel
        yield self.tau == piecewise(
            (self.c * phi + self.d * w, self.b <= B_EPS),
            (self.contact_torque(phi - self.b / 2, w), phi > self.b / 2),
            (-self.contact_torque(-phi - self.b / 2, -w), phi < -self.b / 2),
            0,
        )

    def contact_torque(self, depth: Expr, rate: Expr) -> Expr:
        """Contact torque at the depth > 0 beyond the backlash and its rate."""
        spring, damper = self.c * depth, self.d * rate
        return piecewise((0, damper < -spring), (2 * spring, damper > spring), spring + damper)

    def spring(self) -> Expr:
        """Spring torque."""
        phi, half = self.phi_rel - self.phi_rel0, self.b / 2
        return piecewise((self.c * (phi - half), phi > half), (self.c * (phi + half), phi < -half), 0)

    def stored_energy(self):
        """Elastic energy."""
        return self.spring() ** 2 / (2 * self.c)

    def loss(self):
        """Power of the damper."""
        return (self.tau - self.spring()) * self.w_rel
