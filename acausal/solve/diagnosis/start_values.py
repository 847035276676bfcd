"""Remedies for start values at which equations fail: another guess, another fixed value, or a law that holds there."""

from __future__ import annotations

from typing import Any

import casadi as ca

from acausal.solve.problem import Problem
from acausal.symbols import scalars

PIECEWISE = "state what holds there: piecewise((value, condition), ..., otherwise)."
ELSEWHERE = f"Start elsewhere, or {PIECEWISE}"


def value_remedy(problem: Problem, operand: Any) -> str:
    """Return the remedy for an expression whose start value an equation does not allow.

    Parameters
    ----------
    problem : Problem
        The model.
    operand : casadi.SX
        The expression, in unknowns of the model.
    """
    r = problem.compiled.reduced
    place = {s.element_hash(): k for k, s in enumerate(scalars(r.unknowns))}
    inside = [place[s.element_hash()] for s in ca.symvar(r.resolve(operand)) if s.element_hash() in place]
    fixed = _fixed(problem)
    free = [k for k in inside if r.unknowns[k].element_hash() not in fixed and r.names[k]]
    if free:
        return f"{another_guess(problem, free[0])}."
    if inside:
        return f"Start {' or '.join(f'`{r.names[k]}`' for k in inside[:3])} elsewhere, or {PIECEWISE}"
    return ELSEWHERE


def another_guess(problem: Problem, unknown: int) -> str:
    """Return the remedy of another guess for an unknown, without the full stop."""
    r = problem.compiled.reduced
    guessed = r.flat.unknowns.guessed
    default = "" if unknown < len(guessed) and guessed[unknown] else " (the default guess is 0)"
    return f"Give another guess of `{r.names[unknown]}`, variable(..., start=1) or guess(...){default}"


def _fixed(problem: Problem) -> set[int]:
    """Hashes of the unknowns whose start values are fixed."""
    conditions = problem.compiled.reduced.flat.equations.initial
    alone = [ca.symvar(c.residual) for c in conditions if c.text != "initial equation"]
    return {symbols[0].element_hash() for symbols in alone if len(symbols) == 1}
