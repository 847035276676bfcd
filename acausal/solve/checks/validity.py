"""Validity of components: requirements at the start, and effects neglected in a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized
from acausal.compiler.requirements import Stated, refuse, statements
from acausal.compiler.vectorized import Vectorized
from acausal.errors import InitializationError
from acausal.flatten.opaque_calls import refuse_undeclared
from acausal.language.functions import initial, time
from acausal.language.validity_statements import Expectation, Separation
from acausal.policy import POLICY
from acausal.solve.looks import spread
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem
from acausal.solve.results.evaluator import Evaluator
from acausal.symbols import stacked

VALIDITY = POLICY.validity


@dataclass(frozen=True)
class Statements:
    """Validity statements of a compiled model, and the function that evaluates them."""

    stated: list[Any]
    function: Vectorized
    wanted: frozenset[int]


def compiled_statements(compiled: CompiledModel, stated: list[Any], entries: list[ca.SX]) -> Statements:
    """Compile validity statements from their expressions in symbols of the model."""
    r = compiled.reduced
    column = r.running.resolve(stacked(entries))
    arguments = [r.x, r.z, r.p, time.sx, r.constants]
    try:
        function = ca.Function("statements", arguments, [ca.densify(column)])
    except RuntimeError:
        for k, entry in enumerate(entries):
            origin = stated[k * len(stated) // len(entries)][1]
            refuse_undeclared(r.resolve(entry), [*arguments, initial.sx], f"{origin}: ")
        raise
    return Statements(stated, Vectorized(function), frozenset(compiled.dependence.inside(column)))


@memoized
def _validity(compiled: CompiledModel) -> list[Stated]:
    return statements(compiled.tree, "validity", (Expectation, Separation))


@memoized
def separations(compiled: CompiledModel) -> Statements:
    """Points that must not coincide: rate, effect and offset of each pair, in turn."""
    stated = [item for item in _validity(compiled) if isinstance(item[0], Separation)]
    return compiled_statements(compiled, stated, [e.sx for s, _ in stated for e in (s.rate, s.effect, s.offset)])


@memoized
def _expectations(compiled: CompiledModel) -> Statements:
    stated = [item for item in _validity(compiled) if isinstance(item[0], Expectation)]
    return compiled_statements(compiled, stated, [e.sx for s, _ in stated for e in (s.part, s.whole)])


@memoized
def _at_start(compiled: CompiledModel) -> Statements:
    stated = compiled.requirements.at_start
    return compiled_statements(compiled, stated, [r.sx for r, _ in stated])


def check_start(problem: Problem, at: Point) -> None:
    """Raise InitializationError if variables violate a requirement at the start."""
    found = _at_start(problem.compiled)
    if found.stated:
        row = problem.each(found.function, Rows.of(at))[0]
        refuse(found.stated, row, InitializationError)


def validity_warnings(outputs: Evaluator) -> list[str]:
    """Return warnings on neglected effects that were not small; at most VALIDITY.rows of the points are checked.

    Parameters
    ----------
    outputs : Evaluator
        Output points of a run.
    """
    problem = outputs.solver.problem
    seen = _expectations(problem.compiled)
    if not seen.stated:
        return []
    rows = outputs.rows[spread(len(outputs.rows), VALIDITY.dear if seen.wanted else VALIDITY.rows)]
    share = np.array([expectation.share for expectation, _ in seen.stated])
    part, whole = _parts(problem.each(seen.function, rows))
    if seen.wanted:
        # The values of the integrator suffice where all effects are far from their limits.
        near = np.flatnonzero(np.any(part > VALIDITY.nearly * share * np.max(whole, axis=0), axis=1))
        if not near.size:
            return []
        settled = outputs.solver(rows[near], seen.wanted, POLICY.consistent.roughly)[0]
        part[near], whole[near] = _parts(problem.each(seen.function, settled))
    most, so_far = np.max(part, axis=0), np.maximum.accumulate(whole)
    found = []
    for k in np.flatnonzero(most > share * so_far[-1]).tolist():
        expectation, origin = seen.stated[k]
        first = rows.times[part[:, k] > share[k] * so_far[:, k]][0]
        all_of_it = float(so_far[-1, k])
        worst = f"up to {100 * most[k] / all_of_it:.2g} %" if most[k] < all_of_it else "as much as all"
        found.append(f"{origin}: {expectation.text} ({worst} of it, from t = {first:.4g} s on)")
    return found


def _parts(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the magnitudes of part and whole of each expectation, 0 for NaN."""
    sizes = np.abs(values)
    sizes[np.isnan(sizes)] = 0.0
    return sizes[:, ::2], sizes[:, 1::2]
