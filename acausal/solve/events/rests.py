"""Where laws of time act for a short time, after a rest or in a case of their own: long steps could pass over that."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.core_equations import laws_of_time
from acausal.compiler.memo import memoized_latest
from acausal.policy import POLICY
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.integrate.methods import METHODS
from acausal.solve.point import Point
from acausal.solve.problem import Problem

RESTS = POLICY.rests


def ends_of_rests(integrator: Integrator, at: Point, end: float, outputs: np.ndarray) -> list[float]:
    """Return times in a segment at which laws of time end a rest for a short time, or begin or end a short case, ascending.

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
    compiled, span, run = integrator.compiled, end - at.time, float(outputs[-1] - outputs[0])
    if not compiled.nx:
        return []
    rests, short = _after_rests(integrator, at, end, run), _short_cases(integrator.problem, at, end, run)
    if not (rests or short.size):
        return []
    found = np.union1d(rests, short)
    near = outputs[np.clip(np.searchsorted(outputs, found - span * RESTS.near), 0, len(outputs) - 1)]
    return np.where(np.abs(near - found) <= span * RESTS.near, near, found).tolist()


def _after_rests(integrator: Integrator, at: Point, end: float, run: float) -> tuple[float, ...]:
    """None for the multistep method, whose steps grow slowly."""
    way, problem = integrator.way, integrator.problem
    if METHODS[way.method].multistep:
        return ()
    parts = int(np.ceil(RESTS.parts * (end - at.time) / run))
    if parts <= RESTS.least:
        return ()
    numbers = np.concatenate([[at.time, end], problem.p, at.constants.vector])
    return _found(problem.compiled, way.moves, parts, numbers.tobytes())


def _short_cases(problem: Problem, at: Point, end: float, run: float) -> np.ndarray:
    """Instants around the short cases of laws that are declared smooth."""
    instants, apart = problem.compiled.guards.smooth(problem.p, at.constants.vector)[0], RESTS.near * (end - at.time)
    if not instants.size:
        return instants
    inside = np.unique(instants[(instants > at.time + apart) & (instants < end - apart)])
    short = np.diff([at.time, *inside, np.inf]) <= RESTS.short * run
    return inside[short[:-1] | short[1:]]


@memoized_latest(8)  # segments of a run
def _found(compiled: CompiledModel, moves: bool, parts: int, numbers: bytes) -> tuple[float, ...]:
    """Return the same for ends of a segment in so many parts, parameters and constants, given as bytes."""
    laws = laws_of_time(compiled, moves)
    if laws is None:
        return ()
    given, n = np.frombuffer(numbers), compiled.reduced.p.numel()
    times, p, constants = np.linspace(given[0], given[1], parts + 1), given[2 : 2 + n], given[2 + n :]
    values = laws.rows(np.zeros(compiled.nx), np.zeros(compiled.nz), times[:, None], p, constants)
    return tuple(times[_ends(values)].tolist())


def _ends(laws: np.ndarray) -> list[int]:
    """Places at which laws, one a column, end a rest, to return to rest before long."""
    moves = np.abs(laws[1:] - laws[:-1]) > RESTS.still * (np.max(laws, axis=0) - np.min(laws, axis=0))
    parts = np.arange(len(moves))[:, None]
    rests = parts + np.zeros_like(moves, dtype=int)
    # Where the last move before each part ends.
    rests[1:] -= np.maximum.accumulate(np.where(moves, parts + 1, 0), axis=0)[:-1]
    found = set[int]()
    for k, law in np.argwhere(moves & (rests >= RESTS.least)).tolist():
        end = k + int(np.argmin(np.append(moves[k:, law], False)))
        way = laws[k : end + 1, law]
        if end - k <= RESTS.growth * rests[k, law] and abs(way[-1] - way[0]) <= RESTS.left * np.ptp(way):
            found.add(k)
    return sorted(found)
