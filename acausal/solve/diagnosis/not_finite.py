"""Equations that are not finite at a point: the operation that fails, and the parameter or start value that causes it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.call import Call
from acausal.compiler.full_residuals import EQUATION, Row
from acausal.instructions import EXTERNAL
from acausal.policy import POLICY
from acausal.solve.diagnosis.probe import Probe, decisive_zeros, zeros_text
from acausal.solve.diagnosis.singularity import dependent_equations
from acausal.solve.diagnosis.start_values import ELSEWHERE, value_remedy
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.symbols import scalars

CAUSES = POLICY.causes
RANGE = ", which must lie between -1 and 1"
NO_VALUE = "asks {} for a value that it does not have"
BEYOND = "looks up {} in a table that ends before, and refuses to extrapolate"
WORDS = {
    ca.OP_DIV: "divides by {}",
    ca.OP_INV: "divides by {}",
    ca.OP_SQRT: "takes the square root of {}",
    ca.OP_LOG: "takes the logarithm of {}",
    ca.OP_LOG1P: "takes the logarithm of 1 + {}",
    ca.OP_ACOS: f"takes acos of {{}}{RANGE}",
    ca.OP_ASIN: f"takes asin of {{}}{RANGE}",
    ca.OP_ACOSH: "takes acosh of {}, which must be at least 1",
    ca.OP_ATANH: f"takes atanh of {{}}{RANGE}",
    ca.OP_POW: "takes a power of {}",
    ca.OP_CONSTPOW: "takes a power of {}",
    ca.OP_EXP: "takes exp of {}, which is too large a number",
}


def cause(
    problem: Problem, at: Point, flag: float = 0.0, kinds: Iterable[str] = (EQUATION,), remedy: str = ELSEWHERE
) -> str:
    """Return why equations cannot be solved at a point: not finite or singular; "" if neither."""
    if undefined := undefined_equations(problem, at, flag, kinds, remedy):
        return undefined
    singular = dependent_equations(problem, at, flag)
    return f"at t = {at.time:.6g} s {singular}" if singular else ""


def undefined_equations(
    problem: Problem,
    at: Point,
    flag: float = 0.0,
    kinds: Iterable[str] = (EQUATION,),
    remedy: str = ELSEWHERE,
    timed: bool = True,
) -> str:
    """Return the message on equations that are not finite at a point, "" if all are finite.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Where.
    flag : float
        1 while the initial system holds.
    kinds : iterable of str
        Kinds of equations that are examined, see `Row`.
    remedy : str
        Remedy if no parameter is the cause; "" for other guesses or start values.
    timed : bool
        Whether the message begins with the time.
    """
    probe = Probe.of(problem, at, flag)
    rows = [row for row in probe.failing() if row.kind in kinds]
    if not rows:
        return ""
    if broken := _broken(problem, probe) or _refused(problem):
        return broken
    found = [(row, *operation(row, probe)) for row in rows]
    lines = list(dict.fromkeys(_line(row, text) for row, text, _ in found))[: CAUSES.shown]
    what = "these equations have" if len(lines) > 1 else f"this {rows[0].kind} has"
    own = parameter_remedy(problem, probe, rows, found[0][2])
    head = f"at t = {at.time:.6g} s " if timed else ""
    return "\n".join([f"{head}{what} no value:", *lines, own or remedy or value_remedy(problem, found[0][2])])


def infinite_slope(problem: Problem, at: Point) -> str:
    """Return the message on equations with an infinite derivative at a point, as of sqrt(x) at x = 0; "" if none has."""
    probe = Probe.of(problem, at, 0.0)
    J = probe.whole.slopes(*probe.arguments)[0]
    pattern = np.array(probe.whole.slopes.function.sparsity_out(0).row())
    rows = dict.fromkeys(str(probe.whole.rows[k].origin) for k in pattern[~np.isfinite(J)])
    if not rows:
        return ""
    lines = "\n".join(f"  {row}" for row in list(rows)[: CAUSES.shown])
    return (
        f"at t = {at.time:.6g} s the slope of this equation is infinite, as that of sqrt(x) at x = 0:\n{lines}\n"
        "Start elsewhere, or give the law a finite slope there: sqrt(x + 1e-6), or piecewise(...)."
    )


def _broken(problem: Problem, probe: Probe) -> str:
    """Return the requirement of a component at the start that is violated, "" if none is."""
    stated, values, first = problem.compiled.requirements.at_start, probe.whole.required(*probe.arguments)[0], 0
    for requirement, origin in stated:
        own = values[first : (first := first + requirement.sx.numel())]
        if text := requirement.broken(own):
            return f"{origin}: {text}."
    return ""


def _refused(problem: Problem) -> str:
    """Return what functions of other libraries raised, "" if none did."""
    failed = [own for own in problem.compiled.reduced.flat.parameters.externals if own.error]
    return "\n".join(f"{own.path} gives no value: {own.error}" for own in failed)


def parameter_remedy(problem: Problem, probe: Probe, rows: list[Row], operand: Any) -> str:
    """Return which parameter needs another value, "" if variables are the cause."""
    zeros = decisive_zeros(problem, rows, lambda places: not _fails(probe.with_parameters(places, 1.0), rows))
    own = problem.compiled.reduced.flat.parameters
    names = {s.element_hash(): name for name, s in zip(own.names, scalars(own.symbols), strict=True)}
    inside = [s.element_hash() for s in ca.symvar(operand)]
    if zeros or not inside or any(s not in names for s in inside):
        return zeros_text(zeros) if zeros else ""
    return f"Give {' or '.join(f'`{names[s]}`' for s in inside[: CAUSES.shown])} another value."


def _fails(probe: Probe, rows: list[Row]) -> bool:
    failing = {id(row) for row in probe.failing()}
    return any(id(row) in failing for row in rows)


def _line(row: Row, what: str) -> str:
    """Where an equation is stated, and which operation fails in it."""
    return f"  {row.origin}: {'' if row.kind == EQUATION else f'the {row.kind} '}{what}"


def operation(row: Row, probe: Probe) -> tuple[str, Any]:
    """Describe the first operation of an expression that is not finite; return its operand, too."""
    nodes: list[Any] = []
    seen: set[int] = set()
    stack = [(row.expression, False)]
    while stack:
        node, done = stack.pop()
        if done:
            nodes.append(node)
        elif node.element_hash() not in seen and not node.is_constant():
            seen.add(node.element_hash())
            stack += [(node, True), *((part, False) for part in _operands(node))]
    for node in nodes:
        parts = _operands(node)
        function = Call(ca.Function("node", probe.whole.arguments, [ca.densify(ca.vertcat(node, *parts))]))
        value, *inner = function(*probe.arguments)[0].tolist()
        if np.isfinite(value) or not parts or not np.all(np.isfinite(inner)):
            continue
        if node.is_output() and node.dep(0).which_function().name().startswith(EXTERNAL):
            return NO_VALUE.format(node.dep(0).dep(0)), row.expression
        divides = node.op() in (ca.OP_DIV, ca.OP_INV)
        operand = parts[-1 if divides else 0]
        words = BEYOND if node.is_output() else WORDS.get(node.op())
        if words is None or (divides and inner[-1]):
            return "gives a number that is too large", operand
        return words.format(_named(operand, inner[-1 if divides else 0])), operand
    return "holds a number that is not finite, such as 1/0 or sqrt(-1)", row.expression


def _operands(node: Any) -> list[Any]:
    """Return the operands of an operation; of a lookup in a table its argument."""
    if not node.is_output():
        return [node.dep(k) for k in range(node.n_dep())]
    operand = node.dep(0).dep(0)
    return _operands(operand) if operand.is_output() else [operand]


def _named(operand: Any, value: float) -> str:
    """Return the text of an operand, if it is short, and its value."""
    text = str(operand)
    text = text[1:-1] if text.startswith("(") and text.count("(") == 1 else text
    is_short = len(text) <= CAUSES.text and "@" not in text and not operand.is_constant()
    number = f"{value:.4g}"
    if abs(float(number)) == 1 != abs(value):  # rounded to four digits it would lie in its range
        number = f"slightly {'more' if value > 0 else 'less'} than {number}"
    return f"{text} = {number}" if is_short else number
