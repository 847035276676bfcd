"""Why equations fail at a point: what has no value probe, what says the same, and which parameter that is 0 causes it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.call import Call
from acausal.compiler.whole import EQUATION, Row
from acausal.policy import POLICY
from acausal.solve.diagnosis.probe import Probe, decisive_zeros, zeros_text
from acausal.solve.diagnosis.singularity import dependent_equations
from acausal.solve.diagnosis.start_values import ELSEWHERE, value_remedy
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.symbols import scalars

CAUSES = POLICY.causes
RANGE = ", which must lie between -1 and 1"
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
    """Say why equations cannot be solved at a point, "" if nothing in the equations themselves tells."""
    twice = (
        ""
        if (missing := undefined_equations(problem, at, flag, kinds, remedy))
        else dependent_equations(problem, at, flag)
    )
    return missing or (f"at t = {at.time:.6g} s {twice}" if twice else "")


def undefined_equations(
    problem: Problem,
    at: Point,
    flag: float = 0.0,
    kinds: Iterable[str] = (EQUATION,),
    remedy: str = ELSEWHERE,
    timed: bool = True,
) -> str:
    """Say which equations have no value at a point, "" if all have one.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Where.
    flag : float
        1 while the initial system holds.
    kinds : iterable of str
        Rows that count, see `Row`.
    remedy : str
        What to do where no parameter is the cause; "" for what suits guesses and start values.
    timed : bool
        Whether to begin with the time.
    """
    probe = Probe.of(problem, at, flag)
    rows = [row for row in probe.failing() if row.kind in kinds]
    if not rows:
        return ""
    if broken := _broken(problem, probe):
        return broken
    found = [(row, *operation(row, probe)) for row in rows]
    lines = list(dict.fromkeys(_line(row, text) for row, text, _ in found))[: CAUSES.shown]
    what = "these equations have" if len(lines) > 1 else f"this {rows[0].kind} has"
    own = parameter_remedy(problem, probe, rows, found[0][2])
    head = f"at t = {at.time:.6g} s " if timed else ""
    return "\n".join([f"{head}{what} no value:", *lines, own or remedy or value_remedy(problem, found[0][2])])


def infinite_slope(problem: Problem, at: Point) -> str:
    """Say which equations change infinitely fast with an unknown at a point, as sqrt(x) at x = 0; "" if none do."""
    probe = Probe.of(problem, at, 0.0)
    J = probe.whole.slopes(*probe.arguments)[0]
    pattern = np.array(probe.whole.slopes.function.sparsity_out(0).row())
    rows = dict.fromkeys(str(probe.whole.rows[k].origin) for k in pattern[~np.isfinite(J)])
    if not rows:
        return ""
    lines = "\n".join(f"  {row}" for row in list(rows)[: CAUSES.shown])
    return (
        f"at t = {at.time:.6g} s the slope of this equation is infinite, as that of sqrt(x) at x = 0:\n{lines}\n"
        "Start beside it, or give the law a finite slope probe: sqrt(x + 1e-6), or piecewise(...)."
    )


def _broken(problem: Problem, probe: Probe) -> str:
    """What a component requires at the start and does not hold."""
    stated, values, first = problem.compiled.requirements.at_start, probe.whole.required(*probe.arguments)[0], 0
    for requirement, origin in stated:
        own = values[first : (first := first + requirement.sx.numel())]
        if text := requirement.broken(own):
            return f"{origin}: {text}."
    return ""


def parameter_remedy(problem: Problem, probe: Probe, rows: list[Row], operand: Any) -> str:
    """Which parameter needs another value, "" if variables are the cause."""
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
    """Where a row is stated, and what fails in it."""
    return f"  {row.origin}: {'' if row.kind == EQUATION else f'the {row.kind} '}{what}"


def operation(row: Row, probe: Probe) -> tuple[str, Any]:
    """The first operation in an expression that has no value, in words, and its operand."""
    nodes: list[Any] = []
    seen: set[int] = set()
    stack = [(row.expression, False)]
    while stack:
        node, done = stack.pop()
        if done:
            nodes.append(node)
        elif node.element_hash() not in seen and not node.is_constant():
            seen.add(node.element_hash())
            stack += [(node, True), *((node.dep(k), False) for k in range(node.n_dep()))]
    for node in nodes:
        parts = [node.dep(k) for k in range(node.n_dep())]
        function = Call(ca.Function("node", probe.whole.arguments, [ca.densify(ca.vertcat(node, *parts))]))
        value, *inner = function(*probe.arguments)[0].tolist()
        if np.isfinite(value) or not parts or not np.all(np.isfinite(inner)):
            continue
        divides = node.op() in (ca.OP_DIV, ca.OP_INV)
        operand = parts[-1 if divides else 0]
        words = WORDS.get(node.op())
        if words is None or (divides and inner[-1]):
            return "gives a number that is too large", operand
        return words.format(_named(operand, inner[-1 if divides else 0])), operand
    return "holds a number that is not finite, such as 1/0 or sqrt(-1)", row.expression


def _named(operand: Any, value: float) -> str:
    """The operand as it is computed, where that is short, and its value."""
    text = str(operand)
    text = text[1:-1] if text.startswith("(") and text.count("(") == 1 else text
    is_short = len(text) <= CAUSES.text and "@" not in text and not operand.is_constant()
    number = f"{value:.4g}"
    if abs(float(number)) == 1 != abs(value):  # rounding would take it back into its range
        number = f"a little {'more' if value > 0 else 'less'} than {number}"
    return f"{text} = {number}" if is_short else number
