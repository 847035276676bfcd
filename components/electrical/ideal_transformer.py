"""IdealTransformer: ideal transformer."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.electrical.two_port import TwoPort


class IdealTransformer(TwoPort):
    """Ideal transformer: v1 = n v2, i2 = -n i1."""

    n: Scalar = parameter("ratio of the turns, first to second winding", default=1)

    def equations(self):
        yield from super().equations()
        yield self.v1 == self.n * self.v2
        yield self.i2 == -self.n * self.i1
