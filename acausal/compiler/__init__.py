"""Code generation: CasADi functions of a reduced model."""

from acausal.compiler.compile import compile, ready
from acausal.compiler.compiled_model import CompiledModel

__all__ = ["CompiledModel", "compile", "ready"]
