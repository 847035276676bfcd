"""A problem of hand-made functions in place of a compiled model."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import scipy

from acausal.compiler.linearization import PointLinearization
from acausal.solve.point import Point

Function = Callable[[np.ndarray], np.ndarray]


class Made:
    """Equations f(y) with their Jacobian; the first `nx` unknowns are states.

    Attributes
    ----------
    seen : list of array
        Where the Jacobian was asked for: the iterates.
    """

    def __init__(self, f: Function, jacobian: Function, n: int, nx: int = 0) -> None:
        self.f, self.jacobian, self.nx, self.nz = f, jacobian, nx, n - nx
        self.nominal, self.feedback = np.ones(n), 1.0
        self.seen: list[np.ndarray] = []
        equations = SimpleNamespace(origins=[f"equation {k}" for k in range(n)], initial=[])
        plan = SimpleNamespace(residuals=range(n), differentiated=())
        reduced = SimpleNamespace(flat=SimpleNamespace(equations=equations), plan=plan)
        self.compiled = SimpleNamespace(
            nx=nx,
            nz=self.nz,
            reduced=reduced,
            constraints=SimpleNamespace(size=0),
            states=[f"x{k}" for k in range(nx)],
            memo={},
            pattern=scipy.sparse.csc_matrix(np.ones((n, n))),
        )

    def values(self, at: Point, flag: float = 0.0) -> np.ndarray:
        return np.asarray(self.f(at.y), dtype=float)

    def local(self, at: Point, flag: float = 0.0) -> PointLinearization:
        self.seen.append(at.y)
        J = self.compiled.pattern
        columns = np.repeat(np.arange(J.shape[1]), np.diff(J.indptr))
        return PointLinearization(self.values(at), np.asarray(self.jacobian(at.y), dtype=float)[J.indices, columns], J)

    def solved(self, at: Point, most: int) -> None:
        """The core has none of these functions."""

    def at(self, *y: float) -> Point:
        """Return a point."""
        x, z = np.split(np.array(y, dtype=float), [self.nx])
        return Point(0.0, x, z, None)  # type: ignore[arg-type]


def linear(A: np.ndarray, nx: int) -> Made:
    """Return y' = A y, of which the rows beyond the first `nx` are 0 = A y."""
    made = Made(lambda y: A @ y, lambda y: A, len(A), nx)
    made.compiled.pattern = scipy.sparse.csc_matrix(A)
    return made
