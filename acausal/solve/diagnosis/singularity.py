"""Singular equations: which depend on each other at a point, and which unknowns they leave undetermined.

Newton steps of least norm converge for dependent equations too, whose Jacobian round-off makes regular. The pivots of a
scaled sparse LU factorization reveal it whatever the units and stiffness: in the scenes, also with beams a million times as
stiff, no pivot is below 1e-5 of its terms.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.core_equations import core_square
from acausal.compiler.memo import memoized
from acausal.compiler.report import algebraic_loops
from acausal.policy import POLICY
from acausal.solve.diagnosis.pivot_scaling import scaled_to_pivots
from acausal.solve.diagnosis.probe import ROUNDING, Probe, decisive_zeros, is_round_off, perturbed, zeros_text
from acausal.solve.diagnosis.start_values import another_guess
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.solve.sparse_blocks import Block, block_of

CAUSES = POLICY.causes
ANOTHER = "Replace one of them by an independent equation."
NO_INERTIA = (
    " Or its coefficient is 0 in one direction, as the moment of inertia of a thin rod about its own axis: give it another "
    "value."
)
PARALLEL = (
    "The load that parallel rigid parts share is statically indeterminate: remove one of them, or make one elastic."
)
UNIT_GAIN = "A loop of signals with the gain 1 has no solution, or many: change a gain, or delay a signal of the loop."


def dependent_equations(problem: Problem, at: Point, flag: float = 0.0) -> str:
    """Return the message on linearly dependent equations at a point and the unknowns they leave open; "" if none are.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Where.
    flag : float
        1 while the initial system holds.
    """
    probe = Probe.of(problem, at, flag)
    left, right = _null_vectors(probe)
    if not len(right):
        return ""
    rows, names = probe.whole.rows, probe.whole.names
    origins = dict.fromkeys(str(rows[k].origin) for k in _participants(left) if rows[k].origin.where)
    open_ = [f"`{names[probe.whole.solved[k]]}`" for k in _participants(right) if names[probe.whole.solved[k]]]
    inside = [rows[k] for k in _participants(left)]
    zeros = decisive_zeros(
        problem, inside, lambda places: not len(_null_vectors(probe.with_parameters(places, 1.0))[1])
    )
    what = ", ".join(open_[: CAUSES.shown]) + (f" and {more} more" if (more := len(open_) - CAUSES.shown) > 0 else "")
    lines = "\n".join(f"  {origin}" for origin in list(origins)[: CAUSES.shown])
    if zeros:
        return f"{zeros_text(zeros)}\nThe value 0 leaves {what} undetermined. The equations:\n{lines}"
    rates = [name.startswith("`der(") for name in open_]
    inertia = NO_INERTIA if any(rates) else ""
    if len(inside) > 1 and _dependent_around(probe):
        statics = PARALLEL if len({row.origin.path for row in inside}) > 1 else ANOTHER
        signals = {f"`{name}`" for loop in algebraic_loops(problem.compiled.reduced) for name in loop}
        remedy = UNIT_GAIN if signals >= set(open_) else ANOTHER + inertia if all(rates) else statics
        return f"these equations are dependent and leave {what} undetermined:\n{lines}\n{remedy}"
    if len(inside) > 1:
        return (
            f"these equations are dependent near these values and leave {what} undetermined:\n{lines}\n"
            "Give other guesses; if none helps, they are dependent or contradictory everywhere: replace one of them."
            + inertia
        )
    k = int(probe.whole.solved[_participants(right)[0]])
    here = f"cannot be solved for {what} near {names[k]} = {probe.unknowns[k]:.4g}, because its slope there is 0"
    remedy = f"{another_guess(problem, k)}; if none helps, the equation may have no solution.{inertia}"
    return f"this equation {here}:\n{lines}\n{remedy}"


def _dependent_around(probe: Probe) -> bool:
    """Return whether dependent equations hold at the point and are dependent around it: not only in a singular configuration."""
    left, _ = _null_vectors(probe)
    if not len(left):
        return False
    J = probe.whole.sensitivities(*probe.arguments)
    size = abs(J) @ (np.abs(probe.unknowns) + 1.0)
    hold = np.abs(probe.whole.values(*probe.arguments)[0][: len(size)]) <= POLICY.newton.consistent * size
    move = POLICY.ranks.motion * np.random.default_rng(0).standard_normal((2, len(probe.unknowns)))
    moved = replace(probe, unknowns=probe.unknowns * (1.0 + move[0]) + move[1])
    return bool(np.all(hold[_participants(left)])) and len(_null_vectors(moved)[1]) >= len(left)


def _null_vectors(probe: Probe) -> tuple[np.ndarray, np.ndarray]:
    """Left and right null vectors of the Jacobian: shapes (k, equations), (k, unknowns)."""
    solved = probe.whole.solved
    none = np.zeros((0, 0)), np.zeros((0, 0))
    if not 0 < len(solved) <= CAUSES.largest:
        return none
    J = probe.jacobian()
    if J.shape[0] != J.shape[1] or not np.all(np.isfinite(J)):
        return none
    for _ in range(CAUSES.balancing):
        J = J / _lengths(J, 1)
        J = J / _lengths(J, 0)
    U, s, V = np.linalg.svd(J)
    k = int(np.sum(s <= CAUSES.rank * s[0]))
    return (U.T[-k:], V[-k:]) if k else none


def _lengths(J: np.ndarray, axis: int) -> np.ndarray:
    size = np.linalg.norm(J, axis=axis, keepdims=True)
    return np.where(size > 0, size, 1.0)


def _participants(vectors: np.ndarray) -> list[int]:
    """Entries with a share in null vectors, by descending weight; equal weights, up to round-off, in their own order."""
    weight = np.linalg.norm(vectors, axis=0)
    weight = np.round(weight / np.max(weight), CAUSES.digits)
    return [int(k) for k in np.argsort(-weight, kind="stable") if weight[k] > CAUSES.weight]


def undetermined(problem: Problem, at: Point) -> str:
    """Return the message on equations that are dependent at and around a point; "" if the unknowns are determined."""
    if _regular_in_core(problem, at) or _pivots_hold(_without_round_off(problem, at)):
        return ""
    return dependent_equations(problem, at) if _dependent_around(Probe.of(problem, at, 0.0)) else ""


def _regular_in_core(problem: Problem, at: Point) -> bool:
    """Return whether the core has factors with pivots well above round-off: ten times cheaper than factors of SciPy."""
    least = problem.least_pivot(at)
    if least <= POLICY.ranks.rank:
        return False
    square = core_square(problem.compiled, tuple(range(problem.nz)))
    p = np.array([problem.p, perturbed(problem.p)])
    values = square.tape.rows(p, at.constants.vector, at.x, at.z, np.array([at.time]))
    return not np.any(is_round_off(*values[:, problem.nz :]))


def _without_round_off(problem: Problem, at: Point) -> scipy.sparse.csc_matrix:
    """Jacobian of the algebraic equations; entries at round-off level are 0."""
    inner, changed = _algebraic_block(problem.compiled), replace(problem, p=perturbed(problem.p))
    J, other = (inner.sparse(own.local(at).entries) for own in (problem, changed))
    J.data[is_round_off(J.data, other.data)] = 0.0
    return J


def _pivots_hold(J: scipy.sparse.csc_matrix) -> bool:
    """Return whether all pivots exceed the round-off of their terms; equations that are not finite pass."""
    if not (J.shape[0] and np.all(np.isfinite(J.data))):
        return True
    scaled = scaled_to_pivots(J)
    if scaled is None:
        return False
    try:
        factors = scipy.sparse.linalg.splu(scaled, permc_spec="NATURAL")
    except RuntimeError:
        return False
    terms = np.asarray(abs(factors.L).multiply(abs(factors.U).T).sum(axis=1)).ravel()
    return bool(np.all(np.abs(factors.U.diagonal()) > ROUNDING * terms))


@memoized
def _algebraic_block(compiled: CompiledModel) -> Block:
    unknowns = np.arange(compiled.nx, compiled.nx + compiled.nz)
    return block_of(compiled.pattern, unknowns, unknowns)
