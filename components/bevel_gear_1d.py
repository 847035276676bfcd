"""BevelGear1D: gear between two shafts of arbitrary direction on a moving body."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, parameter, port, structural
from components.flange import TwoFlanges
from components.frame import Frame
from components.orientation import unit_vector
from components.world import require_direction


class BevelGear1D(TwoFlanges):
    """Massless gear between two shafts of arbitrary direction, with its bearing fixed to frame_a."""

    ratio: Scalar = parameter("transmission ratio, flange_a.phi / flange_b.phi", unit="1")
    n_a: Any = structural(
        "axis of flange_a, resolved in frame_a", default=(1, 0, 0), shape=(3,), doc="Any nonzero length."
    )
    n_b: Any = structural(
        "axis of flange_b, resolved in frame_a", default=(1, 0, 0), shape=(3,), doc="Any nonzero length."
    )
    frame_a: Frame = port(Frame, "bearing")

    def check(self) -> None:
        """Reject axes of length 0."""
        require_direction(self, self.n_a, "n_a")
        require_direction(self, self.n_b, "n_b")

    def equations(self):
        a, b = self.flange_a, self.flange_b
        yield a.phi == self.ratio * b.phi
        yield self.ratio * a.tau + b.tau == 0
        yield self.frame_a.f == (0, 0, 0)
        yield self.frame_a.t == -unit_vector(self.n_a) * a.tau - unit_vector(self.n_b) * b.tau
