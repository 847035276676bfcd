"""Solution: consistent initial values, integration, linearisation."""

from acausal.solve.linearize import Linearization, linearize
from acausal.solve.simulate import simulate

__all__ = ["Linearization", "linearize", "simulate"]
