"""Reduction: a plan of the structural stage applied to the symbols."""

from acausal.reduce.dependence import Dependence
from acausal.reduce.reduce import plan_of, reduce
from acausal.reduce.reduced_model import ReducedModel

__all__ = ["Dependence", "ReducedModel", "plan_of", "reduce"]
