"""Flattening of a model into one list of equations."""

from acausal.flatten.flat_model import FlatModel, Initial
from acausal.flatten.flatten import flatten

__all__ = ["FlatModel", "Initial", "flatten"]
