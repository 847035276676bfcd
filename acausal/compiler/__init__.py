"""Code generation: CasADi functions of a reduced model."""

from acausal.compiler.argument_checks import model_of, values_of
from acausal.compiler.compile import compile, ready
from acausal.compiler.compiled_model import CompiledModel

__all__ = ["CompiledModel", "compile", "model_of", "ready", "values_of"]
