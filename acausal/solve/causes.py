"""Why equations fail at a point: what has no value there, what says the same twice, and which parameter that is 0 causes it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.call import Call
from acausal.compiler.whole import EQUATION, Row, Whole, whole
from acausal.policy import POLICY
from acausal.solve.guesses import ELSEWHERE, another_guess, mend_of
from acausal.solve.points import Point
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


@dataclass(frozen=True)
class _There:
    """The rows of a model at a point."""

    whole: Whole
    p: np.ndarray
    at: Point
    flag: float
    unknowns: np.ndarray

    @classmethod
    def of(cls, problem: Problem, at: Point, flag: float) -> _There:
        return cls(whole(problem.compiled), problem.p, at, flag, problem.unknowns(at, flag))

    @property
    def arguments(self) -> tuple[Any, ...]:
        """Arguments of the rows; what has no value counts as an ordinary number, so that only its own equation fails."""
        known = np.where(np.isfinite(self.unknowns), self.unknowns, CAUSES.ordinary)
        return known, self.p, self.at.time, self.at.constants.vector, self.flag

    def failing(self) -> list[Row]:
        """Rows that have no value by themselves."""
        wrong = ~np.isfinite(self.whole.values(*self.arguments)[0])
        return [row for row, fails in zip(self.whole.rows, wrong, strict=True) if fails]

    def with_parameter(self, k: int, value: float) -> _There:
        """The same point with another parameter."""
        p = self.p.copy()
        p[k] = value
        return replace(self, p=p)


def cause(
    problem: Problem, at: Point, flag: float = 0.0, kinds: Iterable[str] = (EQUATION,), mend: str = ELSEWHERE
) -> str:
    """Say why equations cannot be solved at a point, "" if nothing in the equations themselves tells."""
    twice = "" if (missing := without_value(problem, at, flag, kinds, mend)) else dependent(problem, at, flag)
    return missing or (f"at t = {at.time:.6g} s {twice}" if twice else "")


def without_value(
    problem: Problem,
    at: Point,
    flag: float = 0.0,
    kinds: Iterable[str] = (EQUATION,),
    mend: str = ELSEWHERE,
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
    mend : str
        What to do where no parameter is the cause; "" for what suits guesses and start values.
    timed : bool
        Whether to begin with the time.
    """
    there = _There.of(problem, at, flag)
    rows = [row for row in there.failing() if row.kind in kinds]
    if not rows:
        return ""
    if broken := _broken(problem, there):
        return broken
    found = [(row, *_operation(row, there)) for row in rows]
    lines = list(dict.fromkeys(_line(row, text) for row, text, _ in found))[: CAUSES.shown]
    what = "these equations have" if len(lines) > 1 else f"this {rows[0].kind} has"
    own = _mend(problem, there, rows, found[0][2])
    head = f"at t = {at.time:.6g} s " if timed else ""
    return "\n".join([f"{head}{what} no value:", *lines, own or mend or mend_of(problem, found[0][2])])


def dependent(problem: Problem, at: Point, flag: float = 0.0) -> str:
    """Say which equations depend on each other at a point, and what they leave open; "" if none do.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Where.
    flag : float
        1 while the initial system holds.
    """
    there = _There.of(problem, at, flag)
    left, right = _null(there)
    if not len(right):
        return ""
    rows, names = there.whole.rows, there.whole.names
    origins = dict.fromkeys(str(rows[k].origin) for k in _heavy(left) if rows[k].origin.where)
    open_ = [f"`{names[there.whole.solved[k]]}`" for k in _heavy(right) if names[there.whole.solved[k]]]
    inside = [rows[k] for k in _heavy(left)]
    zeros = [name for name, k in _zeros(problem, inside) if not len(_null(there.with_parameter(k, 1.0))[1])]
    what = ", ".join(open_[: CAUSES.shown]) + (f" and {more} more" if (more := len(open_) - CAUSES.shown) > 0 else "")
    lines = "\n".join(f"  {origin}" for origin in list(origins)[: CAUSES.shown])
    if zeros:
        return f"{_of_zeros(zeros)}\nNothing determines {what} then. The equations:\n{lines}"
    if len(inside) > 1 and _same(there):
        return (
            f"these equations say the same, so that nothing determines {what}:\n{lines}\n"
            "Replace one of them by an equation that says something new."
        )
    if len(inside) > 1:
        return (
            f"these equations do not determine {what}: near these values they depend on each other:\n{lines}\n"
            "Give other guesses; if none helps, they say the same or contradict each other: replace one of them."
        )
    k = int(there.whole.solved[_heavy(right)[0]])
    here = f"cannot be solved for {what} near {names[k]} = {there.unknowns[k]:.4g}, because its slope there is 0"
    return f"this equation {here}:\n{lines}\n{another_guess(problem, k)}; if none helps, the equation may have no solution."


def _same(there: _There) -> bool:
    """Whether equations that depend on each other at a point hold there, and depend on each other beside it as well."""
    left, _ = _null(there)
    J = there.whole.sensitivities(*there.arguments)
    size = abs(J) @ (np.abs(there.unknowns) + 1.0)
    held = np.abs(there.whole.values(*there.arguments)[0][: len(size)]) <= POLICY.newton.consistent * size
    move = POLICY.ranks.motion * np.random.default_rng(0).standard_normal((2, len(there.unknowns)))
    beside = replace(there, unknowns=there.unknowns * (1.0 + move[0]) + move[1])
    return bool(np.all(held[_heavy(left)])) and len(_null(beside)[1]) >= len(left)


def infinite_slope(problem: Problem, at: Point) -> str:
    """Say which equations change infinitely fast with an unknown at a point, as sqrt(x) at x = 0; "" if none do."""
    there = _There.of(problem, at, 0.0)
    J = there.whole.slopes(*there.arguments)[0]
    pattern = np.array(there.whole.slopes.function.sparsity_out(0).row())
    rows = dict.fromkeys(str(there.whole.rows[k].origin) for k in pattern[~np.isfinite(J)])
    if not rows:
        return ""
    lines = "\n".join(f"  {row}" for row in list(rows)[: CAUSES.shown])
    return (
        f"at t = {at.time:.6g} s the slope of this equation is infinite, as that of sqrt(x) at x = 0:\n{lines}\n"
        "Start beside it, or give the law a finite slope there: sqrt(x + 1e-6), or piecewise(...)."
    )


def _broken(problem: Problem, there: _There) -> str:
    """What a component requires at the start and does not hold."""
    stated, values, first = problem.compiled.requirements.at_start, there.whole.required(*there.arguments)[0], 0
    for requirement, origin in stated:
        own = values[first : (first := first + requirement.sx.numel())]
        if text := requirement.broken(own):
            return f"{origin}: {text}."
    return ""


def _mend(problem: Problem, there: _There, rows: list[Row], operand: Any) -> str:
    """Which parameter needs another value, "" if variables are the cause."""
    zeros = [name for name, k in _zeros(problem, rows) if not _fails(there.with_parameter(k, 1.0), rows)]
    own = problem.compiled.reduced.flat.parameters
    names = {s.element_hash(): name for name, s in zip(own.names, scalars(own.symbols), strict=True)}
    inside = [s.element_hash() for s in ca.symvar(operand)]
    if zeros or not inside or any(s not in names for s in inside):
        return _of_zeros(zeros) if zeros else ""
    return f"Give {' or '.join(f'`{names[s]}`' for s in inside[: CAUSES.shown])} another value."


def _null(there: _There) -> tuple[np.ndarray, np.ndarray]:
    """Combinations of equations, and of unknowns, that vanish: shapes (k, equations), (k, unknowns)."""
    solved = there.whole.solved
    none = np.zeros((0, 0)), np.zeros((0, 0))
    if not 0 < len(solved) <= CAUSES.largest:
        return none
    J = there.whole.jacobian(*there.arguments)
    if J.shape[0] != J.shape[1] or not np.all(np.isfinite(J)):
        return none
    for _ in range(CAUSES.balancing):
        J = J / _sizes(J, 1)
        J = J / _sizes(J, 0)
    U, s, V = np.linalg.svd(J)
    k = int(np.sum(s <= CAUSES.rank * s[0]))
    return (U.T[-k:], V[-k:]) if k else none


def _sizes(J: np.ndarray, axis: int) -> np.ndarray:
    size = np.linalg.norm(J, axis=axis, keepdims=True)
    return np.where(size > 0, size, 1.0)


def _heavy(vectors: np.ndarray) -> list[int]:
    """What takes part in the vectors, what weighs most first; what weighs the same but for rounding, in its own order."""
    weight = np.linalg.norm(vectors, axis=0)
    weight = np.round(weight / np.max(weight), CAUSES.digits)
    return [int(k) for k in np.argsort(-weight, kind="stable") if weight[k] > CAUSES.weight]


def _fails(there: _There, rows: list[Row]) -> bool:
    failing = {id(row) for row in there.failing()}
    return any(id(row) in failing for row in rows)


def _zeros(problem: Problem, rows: list[Row]) -> list[tuple[str, int]]:
    """Parameters in some rows that are 0."""
    own = problem.compiled.reduced.flat.parameters
    inside = {s.element_hash() for row in rows for s in ca.symvar(row.expression)}
    symbols = scalars(own.symbols)
    return [
        (name, k)
        for k, (name, s) in enumerate(zip(own.names, symbols, strict=True))
        if s.element_hash() in inside and problem.p[k] == 0
    ]


def _of_zeros(names: list[str]) -> str:
    shown = " and ".join(f"`{name}`" for name in names[: CAUSES.shown])
    verb = "is" if len(names) == 1 else "are"
    return f"{shown} {verb} 0, which the equations do not allow. Give another value."


def _line(row: Row, what: str) -> str:
    """Where a row is stated, and what fails in it."""
    return f"  {row.origin}: {'' if row.kind == EQUATION else f'the {row.kind} '}{what}"


def _operation(row: Row, there: _There) -> tuple[str, Any]:
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
        function = Call(ca.Function("node", there.whole.arguments, [ca.densify(ca.vertcat(node, *parts))]))
        value, *inner = function(*there.arguments)[0].tolist()
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
