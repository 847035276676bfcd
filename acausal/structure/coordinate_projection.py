"""Constraints that hold at several levels of differentiation, and projection of the coordinates on them.

An equation that was differentiated, and in which no variable has a constant coefficient, constrains states: no fixed
choice of dependent states stays regular. All constrained states are integrated, as X, and the equations hold for the
projection x = X + D mu with a multiplier mu for each constraint (Eich 1993, coordinate projection, with the projection
inside the system, whose index is 1). D, one number for each coordinate and constraint, is chosen numerically: columns
of the constraint Jacobian project orthogonally, unit vectors make some coordinates dependent.
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
    """A constraint at all levels of differentiation.

    Parameters
    ----------
    base : int
        Equation of the original system.
    rows : tuple of int
        The equation and its derivatives except the highest.
    multipliers : tuple of int
        Multiplier of each row.
    top : int
        The highest derivative of the equation.
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
        The projected variable and its time derivative.
    state, state_rate : int
        The integrated variable and its time derivative.
    multipliers : tuple of int
        Multipliers of the rows that constrain the coordinate at its lowest level.
    """

    coordinate: int
    rate: int
    state: int
    state_rate: int
    multipliers: tuple[int, ...]


@dataclass(frozen=True)
class Constrained:
    """Constraints on the states, and the projected coordinates.

    Parameters
    ----------
    constraints : tuple of Constraint
        The constraints.
    projections : tuple of Projection
        The projected coordinates.
    reached : tuple of int
        Algebraic variables on the paths from constraints to coordinates.
    following : tuple of (int, int)
        (variable, equation) of variables that follow explicitly from states, in order of evaluation.
    """

    constraints: tuple[Constraint, ...] = ()
    projections: tuple[Projection, ...] = ()
    reached: tuple[int, ...] = ()
    following: tuple[tuple[int, int], ...] = ()


def constrain(extension: Extension) -> Constrained:
    """Find the constraints; add their multipliers, projections and integrated variables to the system.

    Raises
    ------
    StructuralSingularity
        If a constraint holds no state.

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
    """Return the states that first occur at each level, except those whose derivative occurs there too."""
    before: set[int] = set()
    found = []
    for row in rows:
        seen = reach(extension.rows[row], extension.rows, selection.equation_of)
        reached = {v for v in seen if selection.equation_of[v] < 0}
        found.append(sorted(v for v in reached - before if extension.derivative[v] not in reached))
        before |= reached
    return found


def reach(start: Iterable[int], rows: list[tuple[int, ...]], equation_of: list[int]) -> set[int]:
    """Return the variables on which `start` depends through algebraic equations, `start` included."""
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
    """Return the multipliers of the rows of the lowest level, which are differentiated most often up to the top.

    A coordinate may occur in a higher level of another constraint: the velocity of a ball, resolved in its axes,
    depends on its orientation although its position does not.
    """
    lowest = max(order for order, _ in holding)
    return [multiplier for order, multiplier in holding if order == lowest]


def _project(extension: Extension, x: int, multipliers: list[int]) -> Projection:
    """Replace the state x by an integrated variable."""
    rate = extension.derivative[x]
    state_rate = extension.add_variable()
    state = extension.add_variable(derivative=state_rate, preference=extension.preference[x])
    extension.derivative[x] = -1
    extension.add_equation((x, state, *multipliers), (x, state), (x, state))
    extension.add_equation((state_rate, rate, x, state), (state_rate, rate, x, state), (state_rate, rate))
    return Projection(x, rate, state, state_rate, tuple(multipliers))
