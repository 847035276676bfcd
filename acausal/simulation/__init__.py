"""The front door: from a model to a result, with what the model declares about its own simulation and with an accuracy."""

from acausal.simulation.compiled_step import CompiledStep
from acausal.simulation.given import result_of
from acausal.simulation.linearize import Linearization, linearize
from acausal.simulation.march import March, march
from acausal.simulation.simulate import simulate
from acausal.solve.initialization.initial_point import forget

__all__ = ["CompiledStep", "Linearization", "March", "forget", "linearize", "march", "result_of", "simulate"]
