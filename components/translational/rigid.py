"""Rigid: base of rigid parts between two rod ends."""

from __future__ import annotations

from acausal import PREFER, Scalar, parameter, variable
from components.translational.flange import TwoFlanges


class Rigid(TwoFlanges):
    """Base of rigid parts of length L; a subclass defines the balance of forces."""

    L: Scalar = parameter("length, from flange_a to flange_b", unit="m", default=0)
    s: Scalar = variable("absolute position of the centre", unit="m", select=PREFER)

    def equations(self):
        yield self.flange_a.s == self.s - self.L / 2
        yield self.flange_b.s == self.s + self.L / 2
