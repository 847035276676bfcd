"""Messages for errors of Python, numpy and CasADi in methods of components."""

from __future__ import annotations

import re
import traceback
from types import FunctionType, MethodType, NoneType

import casadi as ca

from acausal.errors import PACKAGE
from acausal.language.component import Component
from acausal.language.expression import Expr
from acausal.language.fields import Family, Part
from acausal.language.symbolic import FUNCTIONS
from acausal.nearest import most_similar

PARTS = {NoneType: "None", list: "a list", FunctionType: "a method", MethodType: "a method"}
REMEDIES = {
    NoneType: "It is a part or port that does not exist here, or the value of a method without `return`: use it only if "
    "it is not None.",
    list: "Select an entry by its index, self.links[0], or loop over all entries.",
    FunctionType: "Call it, self.law(), or mark it @part if it returns a part.",
    MethodType: "Call it, self.law(), or mark it @part if it returns a part.",
}
RAW = (
    (
        r"setting an array element with a sequence",
        "a numpy array contains numbers only. Write a vector with variables as a tuple, (self.x, 0, 0).",
    ),
    (
        r"'Expr' object is not callable",
        "a variable or `time` is called like a function: write x, not x(t).",
    ),
    (
        r"does not support the context manager protocol",
        "a statement such as when(...) is yielded, `yield when(condition, reinit(...))`, and not used in `with`.",
    ),
    (
        r"list index out of range",
        "a list of parts or values has no entry of this number; the first is [0], the last is [-1].",
    ),
)


def python_error_message(error: Exception) -> str:
    """Return the message for an error, with the remedy where it is known.

    Parameters
    ----------
    error : Exception
        Raised by Python, numpy or CasADi in a method of the user.
    """
    if isinstance(error, AttributeError) and isinstance(error.obj, Component) and error.name not in error.obj.fields:
        return _unknown(error.obj, error.name or "")
    if isinstance(error, AttributeError) and isinstance(error.obj, Component):
        return _read_in_connections(error)
    if isinstance(error, AttributeError) and isinstance(error.obj, Expr):
        return (
            f"{error.obj!r} is an expression and has no `{error.name}`: use operators and functions, such as dot(a, b)."
        )
    if isinstance(error, AttributeError) and type(error.obj) in PARTS:
        return f"{PARTS[type(error.obj)]} has no `{error.name}`. {REMEDIES[type(error.obj)]}"
    if isinstance(error, NotImplementedError) and len(error.args) != 1:
        return _not_implemented(error)
    if isinstance(error, AssertionError):
        last = traceback.extract_tb(error.__traceback__)[-1]
        return f"`{last.line}` does not hold{f': {error}' if str(error) else '.'}"
    for pattern, remedy in RAW:
        if re.search(pattern, str(error)):
            return remedy
    overloaded = re.search(r"arguments for overloaded function '(\w+)'", str(error))
    if overloaded:
        return _of_casadi(overloaded[1], error)
    return f"{type(error).__name__}: {(str(error).splitlines() or [''])[0]}"


def _unknown(owner: Component, name: str) -> str:
    """Return the message for an unknown member of a component."""
    what = f"{type(owner).__name__} has no `{name}`"
    names = [known for known in (*owner.fields, *dir(owner)) if not known.startswith("_")]
    if near := most_similar(name, names):
        return f"{what}; did you mean `{near}`?"
    families = [known for known, field in owner.fields.items() if isinstance(field, Family)]
    if families:
        return f"{what}; the ports of `{families[0]}` exist in connections() and equations()."
    ports = [known for known, field in owner.fields.items() if isinstance(field, Part) and field.family]
    return f"{what}; its ports are {', '.join(ports)}." if ports else f"{what}."


def _read_in_connections(error: AttributeError) -> str:
    """Return the message for a variable that is read in connections(), most likely in an equation."""
    ours = [frame for frame in traceback.extract_tb(error.__traceback__) if not frame.filename.startswith(PACKAGE)]
    if ours and ours[-1].name == "connections" and re.search(r"yield\b.*==", ours[-1].line or ""):
        return "connections() yields an equation, which belongs to equations(): write it there."
    return str(error)


def _of_casadi(name: str, error: Exception) -> str:
    """Return the message for a CasADi function that was called with expressions of this package."""
    plain = name.strip("_")
    if plain in FUNCTIONS:
        return f"`{plain}` is CasADi's; use acausal's: from acausal import {plain}."
    if name != "Function_call":
        return (
            f"`{plain}` is CasADi's and cannot take an expression of acausal; use sin, sqrt, abs, piecewise, ... of it."
        )
    called = [frame.f_locals.get("self") for frame, _ in traceback.walk_tb(error.__traceback__)]
    if any(isinstance(f, ca.Function) and (f.is_a("SXFunction") or f.is_a("MXFunction")) for f in called):
        return (
            "a function of CasADi takes symbols of CasADi, not an expression of acausal: Expr(function(self.x.sx)), "
            "with Expr from acausal."
        )
    return "CasADi's table cannot take an expression of acausal. Write it as table(x, Table([x0, x1], [y0, y1]))."


def _not_implemented(error: NotImplementedError) -> str:
    """Return the message for an abstract method that a class does not define."""
    frames = list(traceback.walk_tb(error.__traceback__))
    frame = frames[-1][0]
    owner = frame.f_locals.get("self")
    name = frame.f_code.co_name
    if not isinstance(owner, Component):
        return f"`{name}` is not written yet."
    if len(error.args) == 2:  # purpose of the method, and code of its body
        return f"{type(owner).__name__} needs a method that {error.args[0]}: def {name}(self): {error.args[1]}"
    return f"{type(owner).__name__} lacks the method `{name}`: def {name}(self): ..."
