"""DiscreteStateSpace: sampled linear system."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import discrete, input, output, parameter, reinit, structural
from components.blocks.periodic_block import PeriodicBlock
from components.blocks.state_space import check_matrices


class DiscreteStateSpace(PeriodicBlock):
    """Sampled linear system: at each sample y = C x + D u, then x = A x + B u; the output is held."""

    A: Any = structural("system matrix, shape (n, n)")
    B: Any = structural("input matrix, shape (n, k)")
    C: Any = structural("output matrix, shape (m, n)")
    D: Any = structural("feedthrough, shape (m, k); 0 by default", default=None)
    x_start: Any = parameter("initial state", shape=lambda s: (len(s.A),), default=lambda s: np.zeros(len(s.A)))
    u: Any = input("inputs", shape=lambda s: (np.shape(s.B)[1],))
    y: Any = output("outputs", shape=lambda s: (len(s.C),))
    x: Any = discrete("state", shape=lambda s: (len(s.A),), start=x_start)
    held: Any = discrete("outputs", shape=lambda s: (len(s.C),), start=0)

    def check(self):
        check_matrices(self)

    def equations(self):
        A, B, C = (np.asarray(part, dtype=float) for part in (self.A, self.B, self.C))
        outputs = C @ self.x if self.D is None else C @ self.x + np.asarray(self.D, dtype=float) @ self.u
        yield self.sampled(reinit(self.held, outputs), reinit(self.x, A @ self.x + B @ self.u))
        yield self.y == self.held
