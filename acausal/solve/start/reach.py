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
    these as much as those with declared ones do, else as much as those that change them most; the most that each does around
    the guesses counts, as a crank does nothing at its dead centre.

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
    constants = compiled.layout.begin(compiled.guards.estimate(values, 0.0)[0], 1.0)
    J = np.abs(c.held(x, values, np.zeros(len(x)), constants.vector) * nominal[c.entries[1]])
    found = np.ones(nx)
    for declared, groups in _groups(compiled):
        most = np.array([np.nanmax(J[:, own], initial=0.0) for own in groups])
        to = most[0] if declared and most[0] > 0 else np.max(most)
        for k in range(declared, len(groups)):
            if LOOPS.slight * to < most[k] < np.inf and to < np.inf:
                found[c.entries[1][groups[k]]] = to / most[k]
    return found


@once
def _groups(compiled: CompiledModel) -> list[tuple[bool, list[np.ndarray]]]:
    """Entries of each part whose coordinates have different units: those whose size is known first, if any are."""
    unknown, found = set(compiled.reduced.flat.unknowns.names), []
    known = [declared or unit in unknown for unit, declared in compiled.sizes]
    for part in levels_of(compiled):
        columns = part.columns[part.places[1]].tolist()
        units = np.array(["" if known[k] else f"of {compiled.sizes[k][0]}" for k in columns])
        names = sorted(set(units.tolist()))
        if len(names) > 1:
            found.append((names[0] == "", [part.entries[units == name] for name in names]))
    return found
