"""Acausal modelling of machines with rigid and flexible parts.

Compose a model from connected components; the engine flattens it, reduces its index, sorts and tears the equations and
integrates them.
"""

# ruff: noqa: E402 - the rest takes a second to load, and may be interrupted meanwhile
from acausal.interrupts import heed

heed()

from typing import TYPE_CHECKING, Any

from acausal.animation import geometry
from acausal.compiler import CompiledModel, compile
from acausal.errors import (
    AcausalError,
    AcausalWarning,
    ConnectError,
    DeclarationError,
    ExportError,
    InitializationError,
    SimulationError,
    StructurallySingularError,
    UnbalancedModelError,
    UnitsError,
    caution,
)
from acausal.language import (
    ALWAYS,
    AVOID,
    DEFAULT,
    NEVER,
    PREFER,
    Component,
    Condition,
    Connector,
    Equation,
    Expr,
    Matrix33,
    Model,
    Path,
    Record,
    Scalar,
    Vector3,
    acos,
    apart,
    as_expr,
    asin,
    atan2,
    branch,
    chain,
    connect,
    connected,
    cos,
    cross,
    der,
    discrete,
    dot,
    effect,
    exp,
    expect,
    feedback,
    fixed,
    flow,
    guess,
    in_loop,
    initial,
    input,
    is_root,
    log,
    observed,
    outer,
    output,
    parameter,
    part,
    parts,
    piecewise,
    port,
    ports,
    potential_root,
    pulse,
    quantity,
    ramp,
    reinit,
    require,
    root,
    rooted,
    set_valued,
    sign,
    sin,
    sine,
    soft,
    sqrt,
    step,
    structural,
    tan,
    tanh,
    time,
    time_table,
    trapezoid,
    variable,
    when,
)
from acausal.result import Result
from acausal.shadowed import shadowed
from acausal.simulation import CompiledStep, Linearization, March, linearize, march, result_of, simulate
from acausal.study import Effects, Formulation, Study, effects, study, with_and_without
from acausal.tracebacks import install

__all__ = [
    "ALWAYS",
    "AVOID",
    "DEFAULT",
    "NEVER",
    "PREFER",
    "AcausalError",
    "AcausalWarning",
    "CompiledModel",
    "CompiledStep",
    "Component",
    "Condition",
    "ConnectError",
    "Connector",
    "DeclarationError",
    "Effects",
    "Equation",
    "ExportError",
    "Expr",
    "Formulation",
    "InitializationError",
    "Linearization",
    "March",
    "Matrix33",
    "Model",
    "Path",
    "Record",
    "Result",
    "Scalar",
    "SimulationError",
    "StructurallySingularError",
    "Study",
    "UnbalancedModelError",
    "UnitsError",
    "Vector3",
    "acos",
    "animate",
    "apart",
    "as_expr",
    "asin",
    "atan2",
    "branch",
    "chain",
    "compile",
    "connect",
    "connected",
    "cos",
    "cross",
    "der",
    "discrete",
    "dot",
    "effect",
    "effects",
    "exp",
    "expect",
    "export_dae",
    "export_fmu",
    "feedback",
    "fixed",
    "flow",
    "geometry",
    "guess",
    "in_loop",
    "initial",
    "input",
    "is_root",
    "linearize",
    "load_dae",
    "log",
    "march",
    "observed",
    "outer",
    "output",
    "parameter",
    "part",
    "parts",
    "piecewise",
    "port",
    "ports",
    "potential_root",
    "pulse",
    "quantity",
    "ramp",
    "reinit",
    "require",
    "result_of",
    "root",
    "rooted",
    "set_valued",
    "sign",
    "simulate",
    "sin",
    "sine",
    "soft",
    "sqrt",
    "step",
    "structural",
    "study",
    "tan",
    "tanh",
    "time",
    "time_table",
    "trapezoid",
    "variable",
    "when",
    "with_and_without",
]

if TYPE_CHECKING:
    from acausal.export import export_dae, export_fmu, load_dae
    from acausal.result.several import animate

install()
if _hidden := shadowed():
    caution(_hidden)

# What few runs need: loading it takes as long as a small simulation.
_LATER = {
    **dict.fromkeys(("export_dae", "export_fmu", "load_dae"), "acausal.export"),
    "animate": "acausal.result.several",
}


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_LATER[name]), name)
