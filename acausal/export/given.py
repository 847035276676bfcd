"""Parameters, start values, inputs and slopes of inputs of an exported model."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.export.beginning import Beginning
from acausal.export.local_columns import local_columns
from acausal.flatten.model_inputs import inputs_of
from acausal.language.functions import time
from acausal.language.table import Table
from acausal.symbols import scalars, stacked


class Role(IntEnum):
    """Kind of an entry, which determines when it can be set; the numbers are part of the file format."""

    TUNABLE = 0
    FIXED = 1
    INPUT = 2
    START = 3
    INNER = 4


@dataclass(frozen=True)
class Given:
    """Entries of the vector of parameters of an exported model.

    Attributes
    ----------
    symbols : casadi.SX
        Parameters and inputs of the model, start values of states, slopes of inputs, and their reference time.
    values : array
        Values of the entries.
    roles : tuple of Role
        Kind of each entry.
    starts : dict of int to int
        Entry of the start value, by state.
    inputs : tuple of (int, int)
        Entries of each input and its slope.
    columns : tuple of arrays
        Columns of tables; entries of tables hold the number of their first one.
    """

    symbols: ca.SX
    values: np.ndarray
    roles: tuple[Role, ...]
    starts: dict[int, int]
    inputs: tuple[tuple[int, int], ...]
    columns: tuple[np.ndarray, ...]

    def sloped(self, expression: ca.SX) -> ca.SX:
        """Return an expression with inputs extrapolated linearly in time by their slopes."""
        if not self.inputs:
            return expression
        entries = scalars(self.symbols)
        inputs = [entries[k] for k, _ in self.inputs]
        varied = [entries[k] + entries[slope] * (time.sx - entries[-1]) for k, slope in self.inputs]
        return ca.substitute([expression], [stacked(inputs)], [stacked(varied)])[0]


def given(compiled: CompiledModel, p: np.ndarray, beginning: Beginning) -> Given:
    """Return the entries of the vector of parameters of an exported model.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    p : array
        Values of its free parameters.
    beginning : Beginning
        Its initial values and their equations.
    """
    r, flat = compiled.reduced, compiled.reduced.flat
    own, known = scalars(r.p), inputs_of(compiled.tree)
    inputs = [k for k, s in enumerate(own) if s.element_hash() in known]
    fixed = _fixed(compiled)
    inner = {k for k, name in enumerate(flat.parameters.names) if name in flat.parameters.weighing}
    tables = getattr(p, "tables", flat.parameters.tables)
    numbers, columns = local_columns({k: own for k, own in tables.items() if isinstance(own, Table)})
    roles = [
        Role.INPUT
        if k in set(inputs)
        else Role.INNER
        if k in inner or k in numbers
        else Role.FIXED
        if s.element_hash() in fixed
        else Role.TUNABLE
        for k, s in enumerate(own)
    ]
    starts = {state: len(own) + k for k, state in enumerate(beginning.starts)}
    first = len(own) + len(starts)
    slopes = [ca.SX.sym(f"slope{k}") for k in inputs]
    since = [ca.SX.sym("since")] if inputs else []
    x = beginning.at.x
    own_values = [numbers.get(k, value) for k, value in enumerate(p.tolist())]
    values = [*own_values, *(float(x[state]) for state in starts), *(0.0 for _ in [*slopes, *since])]
    return Given(
        stacked([r.p, *beginning.starts.values(), *slopes, *since]),
        np.array(values),
        (*roles, *(Role.START for _ in starts), *(Role.INNER for _ in [*slopes, *since])),
        starts,
        tuple((k, first + j) for j, k in enumerate(inputs)),
        columns,
    )


def _fixed(compiled: CompiledModel) -> set[int]:
    """Return the parameters on which initial conditions, or the lengths of closed loops, depend."""
    r = compiled.reduced
    discretes = [start for _, start in r.flat.discontinuities.discretes]
    needed = [compiled.conditions, r.running.constraints, r.resolve(stacked(discretes))]
    return {s.element_hash() for s in ca.symvar(ca.veccat(*needed))}
