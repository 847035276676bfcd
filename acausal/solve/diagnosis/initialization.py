"""Messages on the initial system: missing, contradictory or unsatisfied conditions, and unstable equilibria."""

from __future__ import annotations

import re
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.flatten.component_tree import walk
from acausal.language.component import Component, Connector
from acausal.language.fields import InitialValue

LISTED = 10  # conditions in a message


def missing_text(compiled: CompiledModel, free: list[int]) -> str:
    """Return the message that lists undetermined states and the argument that fixes each."""
    names = [compiled.states[k] for k in free]
    lines = [
        f"{len(free)} start value{'s are' if len(free) > 1 else ' is'} missing (the model itself is complete). "
        "Fix for instance:",
    ]
    lines += [f"  {line}" for line in list(dict.fromkeys(_line(compiled, name) for name in names))[:LISTED]]
    lines.append('or start from the guesses: simulate(..., initial="guesses"), on the command line --initial guesses.')
    return "\n".join(lines)


def _line(compiled: CompiledModel, name: str) -> str:
    """Return the constructor argument that fixes a state; a part with the field fixes the state of a connector."""
    path = re.sub(r"\[[\d,]+\]$", "", name.removeprefix("der(").removesuffix(")"))
    owner, rest = compiled.tree, path.split(".")
    while len(rest) > 1 and not isinstance(owner, Connector):
        owner = _member(owner, rest.pop(0))
    variable = ".".join(rest)
    words = type(owner).start_words.get(variable, f"{variable}=fixed(...)")
    part = (
        _part_with_field(compiled, owner, variable, words.partition("=")[0]) if isinstance(owner, Connector) else owner
    )
    if part is None:
        where = f"{type(compiled.tree).__name__}.initial_equations()"
        shape = getattr(_value(owner, variable), "shape", ())
        return f"{where}: yield self.{path} == {'(...)' if shape else '...'}"
    if _is_fixed(part, words):  # but by a quantity that leaves the state open
        others = [
            w for w in type(owner).start_words.values() if w.partition("=")[0] in part.fields and not _is_fixed(part, w)
        ]
        words = others[0] if others else words
    return f"{part._path or 'the model'}: {type(part).__name__}({words})"


def _is_fixed(part: Component, words: str) -> bool:
    """Return whether an argument of a part fixes a start value already."""
    value = part._values.get(words.partition("=")[0])
    return value is True or (isinstance(value, InitialValue) and value.fixed)


def _part_with_field(compiled: CompiledModel, port: Connector, variable: str, field: str) -> Component | None:
    """Return the owner of a port, or of one connected with it, that has a field; None if there is none."""
    if field in port._owner.fields:
        return port._owner
    parts = [part for part in walk(compiled.tree) if field in part.fields]
    ports = [(part, other) for part in parts for other in part._ports if type(other) is type(port)]
    wanted = _resolved(compiled, port, variable)
    found = ((part, _resolved(compiled, other, variable)) for part, other in ports)
    return next(
        (part for part, own in found if own is not None and wanted is not None and ca.is_equal(own, wanted, 2)), None
    )


def _resolved(compiled: CompiledModel, port: Connector, variable: str) -> ca.SX | None:
    """Return a variable of a port in states and algebraic unknowns; None if undefined, as quaternions of frames but roots."""
    try:
        return compiled.reduced.resolve(ca.vec(_value(port, variable).sx))
    except AttributeError:
        return None


def _value(owner: Any, path: str) -> Any:
    for name in path.split("."):
        owner = _member(owner, name)
    return owner


def _member(owner: Component, text: str) -> Any:
    name, _, index = text.partition("[")
    value = getattr(owner, name)
    return value[int(index.removesuffix("]"))] if index else value


def contradiction_text(compiled: CompiledModel, value: np.ndarray, wrong: list[int], others: list[int]) -> str:
    """Return the message on violated conditions and those they contradict; the equations if `others` is empty."""
    conditions, nz = compiled.reduced.flat.equations.initial, compiled.nz
    lines = [f"the initial conditions contradict {'each other' if others else 'the equations of the model'}:"]
    for k in wrong[:LISTED]:
        condition = conditions[k - nz]
        lines.append(f"  {condition.text}: off by {value[k]:.4g} ({condition.origin})")
    if others:
        lines.append("if these hold:")
        lines += [f"  {c.text} ({c.origin})" for c in (conditions[k - nz] for k in others[:LISTED])]
    which = "one of them" if others or len(wrong) > 1 else "it"
    lines.append(
        f"Remove {which}, or turn a fixed value into a guess: guess(...) in place of fixed(...), or without fixed=True."
    )
    return "\n".join(lines)


def no_convergence_text(
    compiled: CompiledModel, value: np.ndarray, rows: np.ndarray, surplus: np.ndarray, time: float
) -> str:
    """Return the message on an initial system without a solution: its equations with the largest residuals."""
    flat, nz = compiled.reduced.flat, compiled.nz
    lines = [
        f"no consistent initial values were found at t = {time:g} s; the worst equations of the initial system are:",
        *worst_lines(compiled, value, rows),
    ]
    if surplus.size:
        lines.append("More values are fixed than there are degrees of freedom; these must follow from the others:")
        lines += [f"  {c.text} ({c.origin})" for c in (flat.equations.initial[row - nz] for row in surplus[:5])]
    lines.append("Give better guesses for the variables in them (guess(...)), or check lengths and start values.")
    return "\n".join(lines)


def worst_lines(compiled: CompiledModel, value: np.ndarray, rows: np.ndarray) -> list[str]:
    """Return the equations of the initial system with the largest residuals, the worst first."""
    flat, nz, lines = compiled.reduced.flat, compiled.nz, list[str]()
    order = np.argsort(-np.abs(np.nan_to_num(value, nan=np.inf)))
    for k in order[:5]:
        row = rows[k]
        if row < 0:
            lines.append(f"  der({compiled.states[row]}) = 0: off by {value[k]:.4g}")
        elif row < nz:
            lines.append(f"  {equation_text(compiled, int(row))}: off by {value[k]:.4g}")
        else:
            condition = flat.equations.initial[row - nz]
            lines.append(f"  {condition.text}: off by {value[k]:.4g} ({condition.origin})")
    return lines


def unstable_text(compiled: CompiledModel, time: float, rate: float, singular: bool) -> str:
    """Return the warning of an unstable equilibrium; in a singular configuration round-off hides the rate."""
    where = f"the equilibrium of {type(compiled.tree).__name__} at t = {time:g} s is"
    if singular:
        return (
            f"{where} a singular configuration of its closed loops; rigid-body equations do not decide its stability."
        )
    return (
        f"{where} unstable: a disturbance grows e-fold in {1 / rate:.3g} s. Give guesses closer to a stable one, such as "
        "guess(...) of joints or angles_start of bodies."
    )


def equation_text(compiled: CompiledModel, row: int) -> str:
    """Return where an algebraic equation of the integrated system is stated."""
    flat, plan = compiled.reduced.flat, compiled.reduced.plan
    equation = plan.residuals[row]
    written, differentiated = len(flat.equations.origins), len(plan.differentiated)
    while written <= equation < written + differentiated:
        equation = plan.differentiated[equation - written]
    if equation < written:
        return str(flat.equations.origins[equation])
    projection = plan.constrained.projections[(equation - written - differentiated) // 2]
    return f"projection of `{compiled.reduced.names[projection.coordinate]}` on the constraints"
