"""The core: a library in C that evaluates and integrates any model, which it takes as data."""

from acausal.core.library import library, why_not
from acausal.core.lu import LU
from acausal.core.model_file import StoredModel
from acausal.core.rodas import End, Equations, Outputs, Rodas, make_equations, with_powers
from acausal.core.tape import Tape, make_tape

__all__ = [
    "LU",
    "End",
    "Equations",
    "Outputs",
    "Rodas",
    "StoredModel",
    "Tape",
    "library",
    "make_equations",
    "make_tape",
    "why_not",
    "with_powers",
]
