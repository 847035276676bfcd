"""What the equations of a body take from its modes, once in a process."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from components.fe.reduction.reduced_body import ReducedBody

# Of the size of a body, the root mean square of the distance of its mass from its centre: how far it may deflect.
DEFLECTION = 0.1


@lru_cache(maxsize=64)
def with_modes(body: ReducedBody, modes: int) -> ReducedBody:
    """Return the body with its first modes: the same object whenever it is asked for."""
    return body.first(modes)


@lru_cache(maxsize=64)
def nominal(body: ReducedBody) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Typical sizes of q in m and of its rates in m/s: a linear body deflects by less than a tenth of its size.

    All modes with the same elastic force, so that an error of any of them counts for what it does: they go with the
    frequency to the power of -2 and -1. With one size for all, fe-pendulum has 13 times the error at 1e-8 in as many steps.
    """
    rates = np.sqrt(np.maximum(np.diag(body.K) / np.diag(body.M), 0))
    slowest = np.min(rates[rates > 0], initial=np.inf)
    rates = np.where(rates > 0, rates, slowest) if np.isfinite(slowest) else np.ones(body.n)
    about = np.trace(body.second_moment) - body.first_moment @ body.first_moment / body.mass
    sizes = DEFLECTION * np.sqrt(about / np.diag(body.M)) * (rates.min(initial=np.inf) / rates) ** 2
    return tuple(sizes), tuple(sizes * rates)


@lru_cache(maxsize=64)
def critical_damping(body: ReducedBody) -> np.ndarray:
    """Damping matrix in N.s/m, shape (n, n), with which every mode of a held reference frame is critically damped."""
    import scipy.linalg

    if not body.n:
        return np.zeros((0, 0))
    squares, V = scipy.linalg.eigh(body.K, body.M)
    rates = np.sqrt(np.maximum(squares, 0))
    D = body.M @ V @ np.diag(2 * rates) @ V.T @ body.M
    largest = np.sqrt(np.outer(np.diag(D), np.diag(D)))
    return np.where(np.abs(D) > 1e-12 * largest, D, 0)  # what is rounding would couple orthogonal modes
