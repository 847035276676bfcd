"""Modelling language: classes, fields, statements and functions of expressions."""

import copyreg

from acausal.language import pickling
from acausal.language.component import Component, Connector, Model, Path, Record
from acausal.language.condition import Condition
from acausal.language.connection import (
    branch,
    chain,
    connect,
    connected,
    in_loop,
    is_root,
    potential_root,
    root,
    rooted,
)
from acausal.language.declare import (
    discrete,
    effect,
    flow,
    input,
    observed,
    outer,
    output,
    parameter,
    part,
    parts,
    port,
    ports,
    structural,
    variable,
)
from acausal.language.expression import Equation, Expr, as_expr
from acausal.language.external import External, external
from acausal.language.fields import ALWAYS, AVOID, DEFAULT, NEVER, PREFER
from acausal.language.functions import (
    acos,
    asin,
    atan2,
    cos,
    cross,
    der,
    dot,
    exp,
    feedback,
    initial,
    log,
    piecewise,
    quantity,
    sign,
    sin,
    sqrt,
    tan,
    tanh,
    time,
)
from acausal.language.initial_values import fixed, guess
from acausal.language.lookup import table
from acausal.language.numpy_functions import numpy_functions
from acausal.language.set_valued_statement import SetValued, set_valued
from acausal.language.soft import Soft, soft
from acausal.language.sources import pulse, ramp, sine, step, time_table, trapezoid
from acausal.language.steps import clip, floor, maximum, minimum, mod
from acausal.language.symbolic import NUMPY_FUNCTIONS
from acausal.language.table import Table
from acausal.language.types import Matrix33, Scalar, Vector3
from acausal.language.validity_statements import Expectation, Requirement, Separation, apart, expect, require
from acausal.language.when_statements import Call, When, call, reinit, when

# Registered here because these modules import the class of expressions.
copyreg.pickle(Expr, pickling.reduce_expression)
NUMPY_FUNCTIONS.update(numpy_functions())

__all__ = [
    "ALWAYS",
    "AVOID",
    "DEFAULT",
    "NEVER",
    "PREFER",
    "Call",
    "Component",
    "Condition",
    "Connector",
    "Equation",
    "Expectation",
    "Expr",
    "External",
    "Matrix33",
    "Model",
    "Path",
    "Record",
    "Requirement",
    "Scalar",
    "Separation",
    "SetValued",
    "Soft",
    "Table",
    "Vector3",
    "When",
    "acos",
    "apart",
    "as_expr",
    "asin",
    "atan2",
    "branch",
    "call",
    "chain",
    "clip",
    "connect",
    "connected",
    "cos",
    "cross",
    "der",
    "discrete",
    "dot",
    "effect",
    "exp",
    "expect",
    "external",
    "feedback",
    "fixed",
    "floor",
    "flow",
    "guess",
    "in_loop",
    "initial",
    "input",
    "is_root",
    "log",
    "maximum",
    "minimum",
    "mod",
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
    "root",
    "rooted",
    "set_valued",
    "sign",
    "sin",
    "sine",
    "soft",
    "sqrt",
    "step",
    "structural",
    "table",
    "tan",
    "tanh",
    "time",
    "time_table",
    "trapezoid",
    "variable",
    "when",
]
