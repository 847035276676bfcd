"""Simulation and linearisation of models: settings, accuracy control, fixed-step methods, results of other methods."""

from acausal.simulation.compiled_step import CompiledStep
from acausal.simulation.fixed_step import March, march
from acausal.simulation.linearize import Linearization, linearize
from acausal.simulation.result_of import result_of
from acausal.simulation.simulate import simulate
from acausal.solve.initialization.initial_point import forget

__all__ = ["CompiledStep", "Linearization", "March", "forget", "linearize", "march", "result_of", "simulate"]
