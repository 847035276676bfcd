"""Acausal modelling of machines with rigid and flexible parts.

Compose a model from connected components; the engine flattens it, reduces its index, sorts and tears the equations and
integrates them.
"""

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

__all__ = [
    *_language,
    "AcausalError",
    "ConnectError",
    "DeclarationError",
    "ExportError",
    "InitializationError",
    "SimulationError",
    "StructurallySingularError",
    "UnbalancedModelError",
    "UnitsError",
]
