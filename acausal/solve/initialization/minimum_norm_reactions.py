"""Minimum-norm reactions of redundant constraints of components, which are statically indeterminate.

Multipliers m and m + u of constraints with the Jacobian J cause the same motion if u' J = 0. The m of least norm satisfies
u' m = 0 for all such u, that is P m = 0 with P the projector on them, in as many rows of P as there are independent u.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.compiler.constants import Constants
from acausal.solve.initialization.rank import scaled
from acausal.solve.point import Point
from acausal.solve.problem import Problem


def minimum_norm_reactions(problem: Problem, at: Point) -> Constants:
    """Return the constants of a point with the projector P for it."""
    c, loops = problem.compiled.constraints, problem.compiled.reduced.flat.loops
    own = c.lowest[[c.closures[k] for k in loops.of_parts]] if c.closures else np.empty(0, dtype=int)
    spare = int(np.sum(at.constants.closures[loops.of_parts] == 0)) if len(own) else 0
    if not spare:
        return at.constants
    counts = c.counting(at.constants.closures)
    rows = np.union1d(c.lowest[counts[c.lowest]], own)
    J = problem.scaled_gradients(at)[rows].toarray() * problem.nominal[: problem.nx]
    size = np.linalg.norm(J, axis=1)
    left = np.linalg.svd(scaled(J))[0][:, -spare:] / np.where(size > 0, size, 1.0)[:, None]
    basis = np.linalg.qr(left[np.searchsorted(rows, own)])[0]
    return replace(at.constants, shares=basis @ basis.T)
