"""RelativeStates: selects the relative motion as states."""

from __future__ import annotations

from acausal import ALWAYS, Scalar, der, variable
from components.translational.flange import TwoFlanges


class RelativeStates(TwoFlanges):
    """Selects the relative position and speed of two rod ends as states, without force."""

    s_rel: Scalar = variable("position of flange_b relative to flange_a", unit="m", select=ALWAYS)
    v_rel: Scalar = variable("der(s_rel)", unit="m/s", select=ALWAYS)
    a_rel: Scalar = variable("der(v_rel)", unit="m/s2")

    def equations(self):
        yield self.s_rel == self.flange_b.s - self.flange_a.s
        yield self.v_rel == der(self.s_rel)
        yield self.a_rel == der(self.v_rel)
        yield self.flange_a.f == 0
        yield self.flange_b.f == 0
