"""PID: pID controller: k (1 + 1 / (Ti s) + Td s / (Td s / Nd + 1))."""

from __future__ import annotations

from acausal import Scalar, der, parameter, variable
from components.blocks.siso import SISO


class PID(SISO):
    """PID controller: k (1 + 1 / (Ti s) + Td s / (Td s / Nd + 1))."""

    k: Scalar = parameter("gain", default=1)
    Ti: Scalar = parameter("time constant of the integrator", unit="s", default=0.5, positive=True)
    Td: Scalar = parameter("time constant of the derivative", unit="s", default=0.1, positive=True)
    Nd: Scalar = parameter("ratio of Td to the lag of the derivative", default=10, positive=True)
    xi_start: Scalar = parameter("initial integral", default=0)
    xd_start: Scalar = parameter("initial state of the derivative", default=0)
    xi: Scalar = variable("integral of the input over Ti")
    xd: Scalar = variable("input through the lag")

    def equations(self):
        lag = self.Td / self.Nd
        yield der(self.xi) == self.u / self.Ti
        yield der(self.xd) == (self.u - self.xd) / lag
        yield self.y == self.k * (self.u + self.xi + self.Td / lag * (self.u - self.xd))

    def initial_equations(self):
        yield self.xi == self.xi_start
        yield self.xd == self.xd_start
