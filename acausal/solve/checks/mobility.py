"""Mobility of loops: joints whose axes are parallel to a few digits only lock a loop that was meant to move."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized
from acausal.language.functions import time
from acausal.policy import POLICY
from acausal.solve.diagnosis.loop_directions import nonparallel_directions
from acausal.solve.initialization.redundancy import lowest
from acausal.solve.point import Point
from acausal.solve.problem import Problem

RANKS = POLICY.ranks


def mobility_warnings(problem: Problem, at: Point, redundant: tuple[int, ...]) -> list[str]:
    """Return warnings on loops without mobility in which a constraint is nearly redundant.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        A point with closed loops.
    redundant : tuple of int
        Redundant constraints.
    """
    flat, c = problem.compiled.reduced.flat, problem.compiled.constraints
    if not c.size:
        return []
    whole, blocks = lowest(problem.compiled)
    found = list[str]()
    for block in blocks:
        independent = np.setdiff1d(block.rows, redundant)
        # Motion prescribed in time needs no mobility.
        if not 0 < len(block.columns) <= len(independent) or _driven(problem.compiled)[c.lowest[independent]].any():
            continue
        entries = problem.scaled_gradients(at).data[whole.entries]
        rows = (
            block.dense(entries)[np.isin(block.rows, independent)]
            / problem.residual_scales(at)[c.lowest[independent], None]
        )
        least = float(np.linalg.svd(rows, compute_uv=False)[len(block.columns) - 1])
        own = (
            flat.loops.closures[k].loop for k, row in enumerate(c.closures) if row in independent and row in c.of_loops
        )
        loop = next(own, None)
        if RANKS.rank < least <= RANKS.locked and loop is not None:
            cut = flat.loops.cuts[loop]
            through = f" through {', '.join(cut.parts)}" if cut.parts else ""
            found.append(
                f"the loop{through} that {cut.a} and {cut.b} close ({cut.where}) has no mobility, but nearly: one of its "
                f"constraints follows from the others up to {least:.1g}. Give axes that shall be parallel, and lengths that "
                "shall be equal, with all digits, or compute them from one another."
                + f" {nonparallel_directions(problem.compiled, cut.parts)}".rstrip()
            )
    return found


@memoized
def _driven(compiled: CompiledModel) -> np.ndarray:
    """Whether each residual of the constraints depends on time."""
    return np.array(ca.which_depends(compiled.reduced.running.constraints, time.sx, 1, True), dtype=bool)
