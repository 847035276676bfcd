"""The core: a library in C that evaluates and integrates any model, which it takes as data."""

from acausal.core.curve import Curve
from acausal.core.equations import Equations, make_equations, with_powers
from acausal.core.laws import laws_of
from acausal.core.library import why_not
from acausal.core.lu import LU
from acausal.core.model_file import StoredModel
from acausal.core.run import Back, Doubt, Happened, Multistep, Rows, Run, RunState
from acausal.core.settle import Settler, Square, make_square
from acausal.core.stepper import End, Outputs, Stepper
from acausal.core.sundials import idas, why_no_idas
from acausal.core.tape import Tape, make_tape

__all__ = [
    "LU",
    "Back",
    "Curve",
    "Doubt",
    "End",
    "Equations",
    "Happened",
    "Multistep",
    "Outputs",
    "Rows",
    "Run",
    "RunState",
    "Settler",
    "Square",
    "Stepper",
    "StoredModel",
    "Tape",
    "idas",
    "laws_of",
    "make_equations",
    "make_square",
    "make_tape",
    "why_no_idas",
    "why_not",
    "with_powers",
]
