"""Whether the equations determine the algebraic unknowns at a point.

Newton's steps of least norm find a solution of equations that say the same as well, and rounding makes these regular. A
sparse factorisation tells, whatever the units and however stiff parts are: in the scenes, with beams a million times as
stiff too, no pivot is less than 1e-5 of its terms.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.core_equations import core_square
from acausal.compiler.once import once
from acausal.policy import POLICY
from acausal.solve.diagnosis.pivot_scaling import scaled_to_pivots
from acausal.solve.diagnosis.probe import ROUNDING, beside, is_rounding
from acausal.solve.diagnosis.singularity import said_twice
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.solve.sparse_blocks import Part, part_of


def undetermined(problem: Problem, at: Point) -> str:
    """Say which equations say the same at a point and beside it, and what they leave open; "" if none do."""
    sure = _sure(problem, at) or _pivots_hold(_without_rounding(problem, at))
    return "" if sure else said_twice(problem, at)


def _sure(problem: Problem, at: Point) -> bool:
    """Whether the core has factors whose pivots are far from rounding, which is known in a tenth of the time."""
    least = problem.least_pivot(at)
    if least <= POLICY.ranks.rank:
        return False
    square = core_square(problem.compiled, tuple(range(problem.nz)))
    p = np.array([problem.p, beside(problem.p)])
    values = square.tape.rows(p, at.constants.vector, at.x, at.z, np.array([at.time]))
    return not np.any(is_rounding(*values[:, problem.nz :]))


def _without_rounding(problem: Problem, at: Point) -> scipy.sparse.csc_matrix:
    """Jacobian of the algebraic equations; entries that are rounding are 0."""
    inner, changed = _inner(problem.compiled), replace(problem, p=beside(problem.p))
    J, other = (inner.sparse(own.local(at).entries) for own in (problem, changed))
    J.data[is_rounding(J.data, other.data)] = 0.0
    return J


def _pivots_hold(J: scipy.sparse.csc_matrix) -> bool:
    """Whether no pivot is the rounding of its terms; equations without a value are not looked at."""
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


@once
def _inner(compiled: CompiledModel) -> Part:
    unknowns = np.arange(compiled.nx, compiled.nx + compiled.nz)
    return part_of(compiled.pattern, unknowns, unknowns)
