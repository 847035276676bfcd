"""Equations of a model as they are read: in sympy, as written and as reduced."""

from acausal.compiler.equations.equations import collected, equations_of
from acausal.compiler.equations.listing import EquationList

__all__ = ["EquationList", "collected", "equations_of"]
