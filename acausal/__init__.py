"""Acausal modelling of machines with rigid and flexible parts.

Compose a model from connected components; the engine flattens it, reduces its index, sorts and tears the equations and
integrates them.
"""

from acausal.compiler import CompiledModel, compile
from acausal.errors import (
    AcausalError,
    ConnectError,
    DeclarationError,
    ExportError,
    InitializationError,
    SimulationError,
    StructurallySingularError,
    UnbalancedModelError,
    UnitsError,
)
from acausal.language import *  # noqa: F403
from acausal.language import __all__ as _language
from acausal.result import Result
from acausal.solve import Linearization, linearize, simulate

__all__ = [
    *_language,
    "AcausalError",
    "CompiledModel",
    "ConnectError",
    "DeclarationError",
    "ExportError",
    "InitializationError",
    "Linearization",
    "Result",
    "SimulationError",
    "StructurallySingularError",
    "UnbalancedModelError",
    "UnitsError",
    "compile",
    "linearize",
    "simulate",
]
