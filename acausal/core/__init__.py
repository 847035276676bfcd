"""The core: a library in C that evaluates and integrates any model, which it takes as data."""

from acausal.core.curve import Curve
from acausal.core.laws import laws_of
from acausal.core.library import library, why_not
from acausal.core.lu import LU
from acausal.core.model_file import StoredModel
from acausal.core.rodas import End, Equations, Outputs, Rodas, make_equations, with_powers
from acausal.core.run import Back, Doubt, Rows, Run, RunState
from acausal.core.settle import Settler, Square, make_square
from acausal.core.tape import Tape, make_tape

__all__ = [
    "LU",
    "Back",
    "Curve",
    "Doubt",
    "End",
    "Equations",
    "Outputs",
    "Rodas",
    "Rows",
    "Run",
    "RunState",
    "Settler",
    "Square",
    "StoredModel",
    "Tape",
    "laws_of",
    "library",
    "make_equations",
    "make_square",
    "make_tape",
    "why_not",
    "with_powers",
]
