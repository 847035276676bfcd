"""Symbolic reduction of a flat model by the plan of the structural analysis."""

from acausal.reduce.dependence import Dependence, solution_levels
from acausal.reduce.reduce import plan_of, reduce
from acausal.reduce.reduced_model import ReducedModel
from acausal.structure import Level

__all__ = ["Dependence", "Level", "ReducedModel", "plan_of", "reduce", "solution_levels"]
