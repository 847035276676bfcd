"""Order limit of the multistep method: fast, lightly damped oscillations make high orders unstable.

BDF of order k is stable outside a wedge around the negative real axis of half angle 90, 90, 86.03, 73.35, 51.84
degrees for k = 1...5 (Hairer & Wanner II, V.2.7). Oscillations that the steps resolve do no harm; those much faster than
the motion must lie inside the wedge.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from acausal.policy import POLICY
from acausal.solve.initialization.tangent_space import of_states, tangent
from acausal.solve.point import Point
from acausal.solve.problem import Problem

ORDER = POLICY.order


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Eigenvalues of a model at a point, found when they are first asked for: many runs do without."""

    problem: Problem
    at: Point

    @cached_property
    def values(self) -> np.ndarray:
        """As `eigenvalues_of`."""
        return eigenvalues_of(self.problem, self.at)

    @property
    def fastest(self) -> float:
        """Size of the largest; 0 where there is none."""
        return float(np.max(np.abs(self.values), initial=0.0))

    @property
    def vibration(self) -> float:
        """Size of the largest that oscillates; 0 where there is none."""
        return float(np.max(np.abs(self.values[np.imag(self.values) != 0]), initial=0.0))


@np.errstate(all="ignore")
def eigenvalues_of(problem: Problem, at: Point) -> np.ndarray:
    """Return eigenvalues of the linearised system: all of a small one, the slowest and the fastest pair of a large one.

    Where the equations are singular, or a slope is infinite, there are none.
    """
    try:
        return _eigenvalues(problem, at)
    except (RuntimeError, np.linalg.LinAlgError):
        return np.zeros(0, complex)


def _eigenvalues(problem: Problem, at: Point) -> np.ndarray:
    nx, nz = problem.nx, problem.nz
    local = problem.local(at)
    if not np.all(np.isfinite(local.entries[local.pattern.indices < nx + nz])):
        return np.zeros(0, complex)
    if nx <= (ORDER.looped if problem.compiled.constraints.size else ORDER.dense):
        N, independent = tangent(problem, at)
        return np.linalg.eigvals((of_states(problem.compiled).matrix(local.entries) @ N)[independent])
    J = local.jacobian[: nx + nz]
    inner = scipy.sparse.linalg.splu(J[nx:, nx:].tocsc(), permc_spec="NATURAL").solve if nz else None
    to_z, from_z, own = J[nx:, :nx], J[:nx, nx:], J[:nx, :nx]

    def rate(v: np.ndarray) -> np.ndarray:
        return own @ v - (from_z @ inner(to_z @ v) if inner else 0)

    fast = _dominant(rate, nx)
    shift = ORDER.shift * float(np.max(np.abs(fast), initial=problem.feedback))
    ends = np.minimum(np.arange(nx + nz + 1), nx)
    diagonal = scipy.sparse.csc_matrix((np.full(nx, shift), np.arange(nx), ends), shape=J.shape)
    outer = scipy.sparse.linalg.splu((J - diagonal).tocsc()).solve

    def inverse(v: np.ndarray) -> np.ndarray:
        return outer(np.r_[v, np.zeros(nz)])[:nx]

    slow = _dominant(inverse, nx)
    return np.concatenate([shift + 1 / slow[slow != 0], fast])


def _dominant(apply: Callable[[np.ndarray], np.ndarray], n: int) -> np.ndarray:
    """Largest pair of eigenvalues by power iteration: the quadratic that three successive vectors fit best.

    Nothing where the vectors vanish, as those of bodies that no force holds: all eigenvalues are 0 there.
    """
    v = np.cos(np.arange(n))
    for _ in range(ORDER.powers):
        v = apply(v)
        size = float(np.linalg.norm(v))
        if not 0 < size < np.inf:
            return np.zeros(0, complex)
        v = v / size
    once = apply(v)
    twice = apply(once)
    if not np.all(np.isfinite(twice)):
        return np.zeros(0, complex)
    (c0, c1), *_ = np.linalg.lstsq(np.column_stack([v, once]), twice, rcond=None)
    return np.roots([1.0, -c1, -c0]).astype(complex)


def order_limit(values: np.ndarray, duration: float) -> tuple[int, str]:
    """Choose the highest order that keeps every fast oscillation stable, and say why.

    Parameters
    ----------
    values : array of complex
        Eigenvalues in 1/s.
    duration : float
        Length of the run in s.
    """
    size = np.abs(values)
    slow = np.sort(size)[: ORDER.slow] if size.size > 4 else np.sort(size)[:2]
    moving = slow[slow > ORDER.moving / duration]
    # Where all slow ones rest, the motion is at least one turn of the run.
    motion = moving.min() if moving.size else 2 * np.pi / duration
    fast = values[(size > ORDER.fast * motion) & (np.imag(values) != 0) & (size * duration > ORDER.fast)]
    angle = np.degrees(np.max(np.abs(np.angle(-fast)), initial=0.0))
    order = next((order for order, wedge in ORDER.wedge if angle < wedge), 2)
    if order == ORDER.highest:
        return order, "no oscillation is both fast and lightly damped"
    return order, f"oscillations of up to {np.max(np.abs(fast)):.3g} 1/s, fast against the motion, are lightly damped"
