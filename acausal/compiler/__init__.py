"""Code generation: CasADi functions of a reduced model."""

from acausal.compiler.argument_checks import checked_model, checked_values
from acausal.compiler.compile import compile, ready
from acausal.compiler.compiled_model import CompiledModel

__all__ = ["CompiledModel", "checked_model", "checked_values", "compile", "ready"]
