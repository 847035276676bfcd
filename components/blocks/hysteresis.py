"""Hysteresis: on (1) above an upper threshold, off (0) below a lower one."""

from __future__ import annotations

from acausal import Scalar, discrete, parameter, reinit, when
from components.blocks.siso import SISO


class Hysteresis(SISO):
    """On (1) above an upper threshold, off (0) below a lower one."""

    u_low: Scalar = parameter("threshold at which it switches off", default=0)
    u_high: Scalar = parameter("threshold at which it switches on", default=1)
    pre_y_start: Scalar = parameter("output before the start", default=0)
    on: Scalar = discrete("1: on, 0: off", start=pre_y_start)

    def equations(self):
        yield when(self.u > self.u_high, reinit(self.on, 1), at_start=True)
        yield when(self.u < self.u_low, reinit(self.on, 0), at_start=True)
        yield self.y == self.on
