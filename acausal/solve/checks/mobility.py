"""Loops that hardly hold, and lock, what was meant to move: joints whose axes are parallel to a few digits only."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.once import once
from acausal.language.functions import time
from acausal.policy import POLICY
from acausal.solve.diagnosis.loop_directions import nonparallel_directions
from acausal.solve.initialization.redundancy import lowest
from acausal.solve.point import Point
from acausal.solve.problem import Problem

RANKS = POLICY.ranks


def locked(problem: Problem, at: Point, redundant: tuple[int, ...]) -> list[str]:
    """Name loops in which nothing can move, if that hangs on a constraint that nearly follows from the others.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        A position in which the loops are closed.
    redundant : tuple of int
        Constraints that follow from others.
    """
    flat, c = problem.compiled.reduced.flat, problem.compiled.constraints
    if not c.size:
        return []
    held, apart = lowest(problem.compiled)
    found = list[str]()
    for block in apart:
        kept = np.setdiff1d(block.rows, redundant)
        # What time drives moves although nothing is free.
        if not 0 < len(block.columns) <= len(kept) or _driven(problem.compiled)[c.lowest[kept]].any():
            continue
        entries = problem.scaled_gradients(at).data[held.entries]
        rows = block.dense(entries)[np.isin(block.rows, kept)] / problem.residual_scales(at)[c.lowest[kept], None]
        least = float(np.linalg.svd(rows, compute_uv=False)[len(block.columns) - 1])
        own = (flat.loops.closures[k].loop for k, row in enumerate(c.closures) if row in kept and row in c.of_loops)
        loop = next(own, None)
        if RANKS.rank < least <= RANKS.locked and loop is not None:
            cut = flat.loops.cuts[loop]
            through = f" through {', '.join(cut.parts)}" if cut.parts else ""
            found.append(
                f"the loop{through} that {cut.a} and {cut.b} close ({cut.where}) lets nothing move, but only just: one of its "
                f"constraints follows from the others up to {least:.1g}. Give axes that are meant to be parallel, and lengths "
                "that are meant to be equal, with all digits, or compute them from one another."
                + f" {nonparallel_directions(problem.compiled, cut.parts)}".rstrip()
            )
    return found


@once
def _driven(compiled: CompiledModel) -> np.ndarray:
    """Which residuals of the constraints depend on time."""
    return np.array(ca.which_depends(compiled.reduced.running.constraints, time.sx, 1, True), dtype=bool)
