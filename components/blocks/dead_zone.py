"""DeadZone: input beyond a dead zone: 0 within it."""

from __future__ import annotations

from acausal import Scalar, parameter, piecewise
from components.blocks.siso import SISO


class DeadZone(SISO):
    """Input beyond a dead zone: 0 within it."""

    u_max: Scalar = parameter("upper limit of the dead zone", default=1)
    u_min: Scalar = parameter("lower limit of the dead zone", default=lambda s: -s.u_max)

    def equations(self):
        above, below = self.u - self.u_max, self.u - self.u_min
        yield self.y == piecewise((above, self.u > self.u_max), (below, self.u < self.u_min), 0)
