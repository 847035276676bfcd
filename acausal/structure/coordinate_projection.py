"""Equations that must hold at several levels of differentiation, and the coordinates that are projected on them.

An equation that was differentiated, and that ties no variable to the others by a constant coefficient, constrains
states: no fixed choice of dependent ones among them stays regular. All of them are integrated, as X, and what the
equations hold is the projection x = X + D mu with a multiplier mu for each constraint (Eich 1993, coordinate projection,
with the projection inside the system: its index is 1). D, one number for each coordinate and constraint, is chosen
when numbers are known: columns of the constraint Jacobian give the projection along it, unit vectors make some
coordinates follow from the others.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from acausal.structure.blt import block_triangular
from acausal.structure.extension import Extension
from acausal.structure.singularity import StructuralSingularity, Subsystem
from acausal.structure.states import StateSelection, select_states


@dataclass(frozen=True)
class Constraint:
    """One equation at all its levels.

    Parameters
    ----------
    base : int
        The equation of the system.
    rows : tuple of int
        The equation and its derivatives, the highest left out.
    multipliers : tuple of int
        Variable for each of the rows.
    top : int
        The highest derivative.
    """

    base: int
    rows: tuple[int, ...]
    multipliers: tuple[int, ...]
    top: int


@dataclass(frozen=True)
class Projection:
    """A coordinate x = state + D multipliers, with der(state) = rate + feedback (x - state).

    Parameters
    ----------
    coordinate, rate : int
        Variable, and the one that is its time derivative.
    state, state_rate : int
        Integrated variable and its derivative.
    multipliers : tuple of int
        Those of the constraints that hold the coordinate at the lowest level of it.
    """

    coordinate: int
    rate: int
    state: int
    state_rate: int
    multipliers: tuple[int, ...]


@dataclass(frozen=True)
class Constrained:
    """What constrains the states.

    Parameters
    ----------
    constraints : tuple of Constraint
        The equations.
    projections : tuple of Projection
        The coordinates that they hold.
    reached : tuple of int
        Algebraic variables through which the constraints hold coordinates.
    following : tuple of (int, int)
        (variable, equation) that follow explicitly from states alone, in order of evaluation.
    """

    constraints: tuple[Constraint, ...] = ()
    projections: tuple[Projection, ...] = ()
    reached: tuple[int, ...] = ()
    following: tuple[tuple[int, int], ...] = ()


def constrain(extension: Extension) -> Constrained:
    """Find the constraints, and add multipliers, projections and integrated variables.

    Raises
    ------
    StructuralSingularity
        If equations hold none of the states.

    """
    base_of = {e: base for base, levels in enumerate(extension.levels) for e in levels}
    bases = list(extension.closures)
    while True:
        apart = {e for base in bases for e in extension.levels[base][:-1]}
        selection = select_states(extension.system(), extension.lower, apart)
        found = sorted({base_of[e] for e in selection.left if e != extension.levels[base_of[e]][-1]}.difference(bases))
        if not found:
            break
        bases += found
    if selection.left:
        raise StructuralSingularity(
            over=(Subsystem.of(selection.left, (v for e in selection.left for v in extension.rows[e])),)
        )
    constraints, seen = [], set()
    holding: dict[int, list[tuple[int, int]]] = {}
    written = list(extension.rows)
    for base in sorted(bases):
        *rows, top = extension.levels[base]
        multipliers = tuple(extension.add_variable() for _ in rows)
        held = _coordinates(extension, selection, rows)
        for order, row, multiplier, coordinates in zip(range(len(rows), 0, -1), rows, multipliers, held, strict=True):
            seen |= reach(extension.rows[row], written, selection.equation_of)
            extension.rows[row] += (multiplier,)
            extension.forbid(row)
            for x in coordinates:
                holding.setdefault(x, []).append((order, multiplier))
        constraints.append(Constraint(base, tuple(rows), multipliers, top))
    if not constraints:
        return Constrained()
    following = _following(extension, written, selection)
    projections = tuple(_project(extension, x, _lowest(holding[x])) for x in sorted(holding))
    reached = tuple(sorted(v for v in seen if selection.equation_of[v] >= 0))
    return Constrained(tuple(constraints), projections, reached, following)


def _following(
    extension: Extension, rows: list[tuple[int, ...]], selection: StateSelection
) -> tuple[tuple[int, int], ...]:
    known = set(selection.states)
    found = []
    for block in block_triangular(rows, [(v, e) for v, e in enumerate(selection.equation_of) if e >= 0]):
        v, e = block.variables[0], block.equations[0]
        if len(block.variables) == 1 and v in extension.explicit[e] and known.issuperset(u for u in rows[e] if u != v):
            known.add(v)
            found.append((v, e))
    return tuple(found)


def _coordinates(extension: Extension, selection: StateSelection, rows: Iterable[int]) -> list[list[int]]:
    """States that enter at each level, those left out whose derivative enters with them."""
    before: set[int] = set()
    found = []
    for row in rows:
        seen = reach(extension.rows[row], extension.rows, selection.equation_of)
        reached = {v for v in seen if selection.equation_of[v] < 0}
        found.append(sorted(v for v in reached - before if extension.derivative[v] not in reached))
        before |= reached
    return found


def reach(start: Iterable[int], rows: list[tuple[int, ...]], equation_of: list[int]) -> set[int]:
    """Variables on which others depend, through the equations of algebraic ones; themselves included."""
    seen = set(start)
    stack = list(seen)
    while stack:
        equation = equation_of[stack.pop()]
        if equation < 0:
            continue
        for u in rows[equation]:
            if u not in seen:
                seen.add(u)
                stack.append(u)
    return seen


def _lowest(holding: list[tuple[int, int]]) -> list[int]:
    """Multipliers of the rows of the lowest level, those that are differentiated most often up to the top.

    One that holds a coordinate at its own level may depend on it at a higher one of another constraint, as a velocity does that
    is resolved in the axes of a ball, whose place does not depend on how it is turned.
    """
    lowest = max(order for order, _ in holding)
    return [multiplier for order, multiplier in holding if order == lowest]


def _project(extension: Extension, x: int, multipliers: list[int]) -> Projection:
    """Let an integrated variable take the place of the state x."""
    rate = extension.derivative[x]
    state_rate = extension.add_variable()
    state = extension.add_variable(derivative=state_rate, preference=extension.preference[x])
    extension.derivative[x] = -1
    extension.add_equation((x, state, *multipliers), (x, state), (x, state))
    extension.add_equation((state_rate, rate, x, state), (state_rate, rate, x, state), (state_rate, rate))
    return Projection(x, rate, state, state_rate, tuple(multipliers))
