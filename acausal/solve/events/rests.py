"""Where laws of time act for a short time after a rest: steps that have grown meanwhile could pass over all that they do."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.core_equations import laws_of_time
from acausal.compiler.once import latest
from acausal.core import library
from acausal.policy import POLICY
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.methods import METHODS
from acausal.solve.points import Point

RESTS = POLICY.rests


def ends_of_rests(integrator: Integrator, at: Point, end: float, outputs: np.ndarray) -> list[float]:
    """Return times in a segment at which laws of time end a rest for a short time, ascending.

    None for the multistep method, whose steps grow slowly, and without the core.

    Parameters
    ----------
    integrator : Integrator
        With the model, and the way in which it is integrated.
    at : Point
        Where the segment begins.
    end : float
        Where it ends, in s.
    outputs : array
        Output times of the run in s.
    """
    way, problem, span = integrator.way, integrator.problem, end - at.time
    if not library() or METHODS[way.method].multistep or not problem.nx:
        return []
    parts = int(np.ceil(RESTS.parts * span / (outputs[-1] - outputs[0])))
    if parts <= RESTS.least:
        return []
    numbers = np.concatenate([[at.time, end], problem.p, at.constants.vector])
    found = np.array(_found(problem.compiled, way.moves, parts, numbers.tobytes()))
    near = outputs[np.clip(np.searchsorted(outputs, found - span * RESTS.near), 0, len(outputs) - 1)]
    return np.where(np.abs(near - found) <= span * RESTS.near, near, found).tolist()


@latest
def _found(compiled: CompiledModel, moves: bool, parts: int, numbers: bytes) -> tuple[float, ...]:
    """Return the same for ends of a segment in so many parts, parameters and constants, given as bytes."""
    laws = laws_of_time(compiled, moves)
    if laws is None:
        return ()
    (begin, end), p, constants = np.split(np.frombuffer(numbers), [2, 2 + compiled.reduced.p.numel()])
    times = np.linspace(begin, end, parts + 1)
    values = laws.rows(np.zeros(compiled.nx), np.zeros(compiled.nz), times[:, None], p, constants)
    return tuple(times[sorted({k for law in values.T for k in _ends(law)})].tolist())


def _ends(law: np.ndarray) -> list[int]:
    """Places at which a law ends a rest, to return to rest before long."""
    moves = np.flatnonzero(np.abs(np.diff(law)) > RESTS.still * np.ptp(law))
    if not moves.size:
        return []
    first = np.flatnonzero(np.diff(moves, prepend=-2) > 1)
    begins, ends = moves[first], moves[np.append(first[1:], len(moves)) - 1] + 1
    rests = begins - np.append(0, ends[:-1])
    return [
        k
        for k, end, rest in zip(begins.tolist(), ends.tolist(), rests.tolist(), strict=True)
        if rest >= RESTS.least
        and end - k <= RESTS.growth * rest
        and abs(law[end] - law[k]) <= RESTS.left * np.ptp(law[k : end + 1])
    ]
