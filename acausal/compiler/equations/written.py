"""Equations as the classes of a model state them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import casadi as ca

from acausal.compiler.equations.listing import EquationList, ReadEquation, listed
from acausal.compiler.equations.sympy_expressions import to_sympy
from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.component_tree import join, walk
from acausal.flatten.variables import entry_names
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.language.expression import Expr
from acausal.language.functions import time
from acausal.symbols import scalars, vec


def written_equations(raw: CollectedStatements, part: str) -> EquationList:
    """Return the equations that a part and the parts in it state, and in a whole model those of its connections.

    Parameters
    ----------
    raw : CollectedStatements
        The model.
    part : str
        Path of the part, "" for the whole model.
    """
    within = {c._path: c for c in walk(raw.build.root)}
    names = {
        s.element_hash(): name for a in raw.arrays for s, name in zip(scalars(vec(a.expr.sx)), a.names, strict=True)
    }
    placed: dict[str, list[int]] = {}
    for k, origin in enumerate(raw.equations.origins):
        if is_within(origin.path, part) and not raw.equations.sides[k][0].is_empty():
            placed.setdefault(origin.path, []).append(k)
    found, shared = [], dict[Any, Any]()
    for path, numbers in placed.items():
        own = names | _own_names(within.get(path))
        sides = [side for k in numbers for side in raw.equations.sides[k]]
        read = iter(_read(sides, own, raw, shared))
        found += [(k, _equation(str(raw.equations.origins[k]), next(read), next(read))) for k in numbers]
    return listed([equation for _, equation in sorted(found, key=lambda pair: pair[0])], shared, part)


def is_within(path: str, part: str) -> bool:
    """Return whether a path is that of a part or of something in it."""
    return not part or path == part or path.startswith((f"{part}.", f"{part}["))


def _own_names(component: Component | None) -> dict[int, str]:
    """Names of the variables of a component and its ports, which connected ports share."""
    found = {}
    for inside in walk(component) if component else ():
        for name, declared in inside.fields.items():
            # A frame has a quaternion only where it is the root.
            if isinstance(declared, f.Variable) and isinstance(expr := vars(inside).get(name), Expr):
                entries = zip(scalars(vec(expr.sx)), entry_names(join(inside._path, name), expr.shape), strict=True)
                found |= {s.element_hash(): entry for s, entry in entries if s.is_symbolic()}
    return found


def _read(sides: list[ca.SX], names: Mapping[int, str], raw: CollectedStatements, shared: dict[Any, Any]) -> list[Any]:
    """Return expressions in sympy, with the names of variables, derivatives and switches."""
    known, constant = {time.sx.element_hash(): "time"} | dict(names), list[ca.SX]()
    for placeholder, expression in raw.pending.derivatives:
        for s, entry in zip(scalars(vec(placeholder)), scalars(vec(expression)), strict=True):
            entry = ca.substitute(entry, ca.vertcat(*constant), ca.SX.zeros(len(constant))) if constant else entry
            if any(symbol.element_hash() in known for symbol in ca.symvar(entry)):
                known[s.element_hash()] = f"der({to_sympy([entry], known)[0]})"
            else:
                constant.append(s)
    known |= {switch.element_hash(): f"({condition})" for switch, condition in raw.pending.switches}
    return to_sympy(ca.substitute(sides, constant, [ca.SX(0)] * len(constant)), known, shared)


def _equation(origin: str, left: Any, right: Any) -> ReadEquation:
    import sympy

    return ReadEquation(origin, sympy.Eq(left, right, evaluate=False))
