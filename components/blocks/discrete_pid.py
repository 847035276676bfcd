"""DiscretePID: sampled PID controller."""

from __future__ import annotations

from acausal import Scalar, discrete, parameter, reinit
from components.blocks.periodic_block import PeriodicBlock


class DiscretePID(PeriodicBlock):
    """Sampled PID controller: backward differences of PID, its output held."""

    k: Scalar = parameter("gain", default=1)
    Ti: Scalar = parameter("time constant of the integrator", unit="s", default=0.5, positive=True)
    Td: Scalar = parameter("time constant of the derivative", unit="s", default=0.1, minimum=0)
    total: Scalar = discrete("sum of the inputs", start=0)
    before: Scalar = discrete("input at the last sample", start=0)
    out: Scalar = discrete("output", start=0)

    def equations(self):
        T, total = self.sample_period, self.total + self.u
        action = self.k * (self.u + T / self.Ti * total + self.Td / T * (self.u - self.before))
        yield self.sampled(reinit(self.total, total), reinit(self.before, self.u), reinit(self.out, action))
        yield self.y == self.out
