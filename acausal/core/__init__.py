"""The core: a library in C that evaluates and integrates any model, which it takes as data."""

from acausal.core.equations import Equations, make_equations
from acausal.core.laws import laws_of
from acausal.core.library import why_not
from acausal.core.lu import LU
from acausal.core.model_file import StoredModel
from acausal.core.reasons import Doubt, End
from acausal.core.run import Back, Happened, Multistep, Rows, Run, RunState
from acausal.core.settle import Settler, Square, make_square
from acausal.core.sundials import why_no_idas
from acausal.core.tape import Tape, make_tape
from acausal.core.unit import Unit

__all__ = [
    "LU",
    "Back",
    "Doubt",
    "End",
    "Equations",
    "Happened",
    "Multistep",
    "Rows",
    "Run",
    "RunState",
    "Settler",
    "Square",
    "StoredModel",
    "Tape",
    "Unit",
    "laws_of",
    "make_equations",
    "make_square",
    "make_tape",
    "why_no_idas",
    "why_not",
]
