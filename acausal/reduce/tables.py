"""Derivatives of tables that the equations of a reduced model hold, and so where they have kinks."""

from __future__ import annotations

import casadi as ca

from acausal.errors import DeclarationError
from acausal.flatten import FlatModel
from acausal.instructions import places_called
from acausal.language.external import External
from acausal.structure import Plan
from acausal.symbols import picked, scalars, stacked

# Continuous derivatives of an interpolant by its kind; of the others one. A delay has a kink where the last step ends.
CONTINUOUS = {"constant": -1, "linear": 0, "delay": 0, "cubic": 2}


def table_kinks(flat: FlatModel, plan: Plan) -> ca.SX:
    """Return the next times, after time, at which the equations have kinks.

    Raises
    ------
    DeclarationError
        If the equations hold the second derivative of a linear table, which is infinite at its points.
    """
    own = flat.parameters
    if not own.tables:
        return ca.SX(0, 1)
    highest = _highest(flat, plan)
    kinds = {place: CONTINUOUS.get(table.kind, 1) for place, table in own.tables.items()}
    _refuse_external(flat, highest)
    for place, (order, row) in highest.items():
        if kinds[place] == 0 and order > 1:
            raise DeclarationError(
                f"{flat.equations.origins[row]}: the second derivative of `{own.names[place]}` is needed, a linear table, "
                'whose slope jumps at its points. Give it kind="akima" or "cubic"; or filter its values, such as by exact=False '
                "in rotational.Position."
            )
    places = {own.symbols[place].element_hash(): place for place in own.tables}
    found = [(places[number.element_hash()], next_time) for number, next_time in flat.discontinuities.kinks]
    return stacked([t for place, t in found if kinds[place] <= max(0, highest.get(place, (0, 0))[0] - 1)])


def bent_tables(flat: FlatModel, plan: Plan) -> list[str]:
    """Return the tables whose second derivative the equations hold, and which has jumps, at the points."""
    own, found = flat.parameters, dict[str, None]()
    for place, (order, _) in (_highest(flat, plan) if own.tables else {}).items():
        if order > 1 and CONTINUOUS.get(own.tables[place].kind, 1) == 1:
            found[own.tables[place].path or own.names[place]] = None
    return list(found)


def _refuse_external(flat: FlatModel, highest: dict[int, tuple[int, int]]) -> None:
    """Raise DeclarationError if the derivative of a value of another library is needed."""
    own = flat.parameters
    for place, (order, row) in highest.items():
        function = own.tables[place]
        if not isinstance(function, External) or order < 1:
            continue
        value = next(iter(places_called(scalars(flat.equations.residuals)[row])))
        raise DeclarationError(
            f"{flat.equations.origins[row]}: the derivative of {function.names[value]} of {own.names[place]} by time is "
            "needed, which it does not have. Let it return a force and take a motion, or filter what it returns, such as by "
            "exact=False in rotational.Position."
        )


def _highest(flat: FlatModel, plan: Plan) -> dict[int, tuple[int, int]]:
    """Return the highest derivative of each table, by its parameter, and the equation that has it."""
    own, equations = flat.parameters, len(flat.equations.origins)
    source, order, most = [*range(equations), *plan.differentiated], [0] * equations, [0] * equations
    root = list(range(equations))
    for k in range(equations, len(source)):
        order.append(order[source[k]] + 1)
        root.append(root[source[k]])
        most[root[k]] = max(most[root[k]], order[k])
    places = list(own.tables)
    pattern = ca.jacobian_sparsity(flat.equations.residuals, picked(own.symbols, places))  # type: ignore[attr-defined]
    found = dict[int, tuple[int, int]]()
    for row, column in zip(*pattern.get_triplet(), strict=True):
        place = places[column]
        now = most[row] + (place in own.raised)
        if now >= found.get(place, (-1, 0))[0]:
            found[place] = now, row
    return found
