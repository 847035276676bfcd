"""RelativeStates: selects the relative motion as states."""

from __future__ import annotations

from acausal import ALWAYS, Scalar, der, variable
from components.flange import TwoFlanges


class RelativeStates(TwoFlanges):
    """Selects the relative angle and speed of two shaft ends as states, without torque."""

    phi_rel: Scalar = variable("angle of flange_b relative to flange_a", unit="rad", select=ALWAYS)
    w_rel: Scalar = variable("der(phi_rel)", unit="rad/s", select=ALWAYS)
    a_rel: Scalar = variable("der(w_rel)", unit="rad/s2")

    def equations(self):
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == der(self.w_rel)
        yield self.flange_a.tau == 0
        yield self.flange_b.tau == 0
