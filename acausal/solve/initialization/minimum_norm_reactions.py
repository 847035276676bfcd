"""How constraints of parts that follow from one another share what works on them: as little of it as possible.

Where m works on constraints with the Jacobian J, m and m + u do the same to the motion if u' J = 0. Of all m, the least has
u' m = 0 for each such u, that is P m = 0 with P the projector on them; as many of its rows as there are u tell that.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.compiler.constants import Constants
from acausal.solve.initialization.rank import scaled
from acausal.solve.point import Point
from acausal.solve.problem import Problem


def shared(problem: Problem, at: Point) -> Constants:
    """Return the constants of a point with the shares that suit it."""
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
