"""Sampler: samples of the input, held in between."""

from __future__ import annotations

from acausal import Scalar, discrete, reinit
from components.blocks.periodic_block import PeriodicBlock


class Sampler(PeriodicBlock):
    """Samples of the input, held in between; a sample is the value just before its instant."""

    held: Scalar = discrete("last sample", start=0)

    def equations(self):
        yield self.sampled(reinit(self.held, self.u))
        yield self.y == self.held
