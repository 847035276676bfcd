"""Sizes of coordinates in closed loops, in any unit of length: in millimetres a slide of 1 is nothing beside a turn of 1 rad."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.once import latest, once
from acausal.policy import POLICY
from acausal.solve.problem import Problem
from acausal.solve.start.parts import Part, parts

LOOPS = POLICY.loops


@once
def levels_of(compiled: CompiledModel) -> list[Part]:
    """Constraints of one level that share coordinates, with the entries of D."""
    c = compiled.constraints
    return parts(c.entries[0], c.entries[1], (c.size, compiled.nx))


def reaches(problem: Problem) -> np.ndarray:
    """Return the sizes of the states where they close loops, shape (nx,): nominal values, or more.

    Coordinates of one unit without a declared nominal value that share constraints have one size, with which they change
    these as much as those with declared ones do, else as much as those that change them most; what each does around the
    guesses counts, as a crank does nothing at its dead centre.

    Parameters
    ----------
    problem : Problem
        The model.
    """
    nominal = problem.nominal[: problem.nx]
    if not _groups(problem.compiled):
        return nominal
    return nominal * _factors(problem.compiled, problem.p.tobytes())


@latest(1)
@np.errstate(all="ignore")
def _factors(compiled: CompiledModel, p: bytes) -> np.ndarray:
    c, nx = compiled.constraints, compiled.nx
    values, nominal = np.frombuffer(p), compiled.nominal[:nx]
    around = LOOPS.around * np.random.default_rng(0).standard_normal((LOOPS.looks, nx))
    x = compiled.start(values, 0.0)[0][:nx] + nominal * around
    constants = compiled.layout.begin(compiled.guards.estimate(values, 0.0, 0.0)[0], 1.0)
    J = np.abs(c.held(x, values, np.zeros(len(x)), constants.vector) * nominal[c.entries[1]])
    J = np.median(np.where(np.isfinite(J), J, 0.0), axis=0)
    found = np.ones(nx)
    for declared, groups in _groups(compiled):
        most = [float(np.max(J[shared])) for _, shared in groups]
        to = most[0] if declared and most[0] > 0 else max(most)
        free = slice(int(declared), None)  # of those that are declared nothing changes
        for (states, _), own in zip(groups[free], most[free], strict=True):
            if own > LOOPS.slight * to:
                found[states] = to / own
    return found


def held_in_sizes(
    problem: Problem, x: np.ndarray, times: np.ndarray, constants: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return Jacobians of the constraints for states in these sizes, at n points, and the sizes.

    Parameters
    ----------
    problem : Problem
        The model.
    x, times : arrays, shapes (n, nx), (n,)
        States, and times in s.
    constants : array
        Those of the segment, or of each point.

    Returns
    -------
    J : array, shape (n, entries)
        As `Constraints.entries` has them.
    sizes : array, shape (entries,)
    """
    c = problem.compiled.constraints
    sizes = reaches(problem)[c.entries[1]]
    return c.held(x, problem.p, times, constants) * sizes, sizes


@once
def _groups(compiled: CompiledModel) -> list[tuple[bool, list[tuple[np.ndarray, np.ndarray]]]]:
    """States of each part by their units, with their entries in equations that several units share.

    First, and told, those whose size is known, if any are.
    """
    c, unknown, found = compiled.constraints, set(compiled.reduced.flat.unknowns.names), []
    known = [declared or unit in unknown for unit, declared in compiled.sizes]
    labels = np.array(["" if known[k] else f"of {unit}" for k, (unit, _) in enumerate(compiled.sizes)])
    for part in levels_of(compiled):
        own, kinds = labels[c.entries[1][part.entries]], c.kinds[c.entries[0][part.entries]]
        shared = np.array([len(set(own[kinds == kind].tolist())) > 1 for kind in kinds], dtype=bool)
        names = sorted(set(own[shared].tolist()))
        if names:
            entries = [part.entries[shared & (own == name)] for name in names]
            states = [part.columns[labels[part.columns] == name] for name in names]
            found.append((names[0] == "", list(zip(states, entries, strict=True))))
    return found
