"""Constraints between differentiated variables that sums of equations contain, such as those of a cut set of inductors.

The currents of three inductors that feed a rectifier sum up to zero, but each equation of a node contains currents of diodes as
well: the pattern of the equations does not show the constraint. Elimination of the other variables from the equations with
coefficients 1 and -1, in integers, does.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca

from acausal.flatten import FlatModel
from acausal.reduce.flat_incidence import Incidence
from acausal.symbols import scalars, stacked


@dataclass
class _Row:
    """A sum of equations: coefficients of variables to eliminate, of the others, and of the equations."""

    inner: dict[int, int]
    outer: dict[int, int]
    sums: dict[int, int]

    def subtract(self, times: int, other: _Row) -> None:
        """Subtract a multiple of another row."""
        for own, its in ((self.inner, other.inner), (self.outer, other.outer), (self.sums, other.sums)):
            for k, c in its.items():
                own[k] = own.get(k, 0) - times * c
                if not own[k]:
                    del own[k]


def with_hidden_constraints(flat: FlatModel, linear: Incidence) -> FlatModel:
    """Return the model with equations replaced by sums of them that constrain differentiated variables.

    Parameters
    ----------
    flat : FlatModel
        The model.
    linear : Incidence
        Jacobian of its residuals.
    """
    found = _sums(flat, linear)
    if not found:
        return flat
    residuals, unknowns = scalars(flat.equations.residuals), flat.unknowns.symbols
    changed = list(residuals)
    for row, own in found.items():
        rest = [c * ca.substitute(residuals[k], unknowns, ca.SX.zeros(unknowns.numel())) for k, c in own.sums.items()]
        changed[row] = sum([*(c * unknowns[k] for k, c in own.outer.items()), *rest], ca.SX(0))
    return replace(flat, equations=replace(flat.equations, residuals=stacked(changed)))


def _sums(flat: FlatModel, linear: Incidence) -> dict[int, _Row]:
    """Return the sums that replace equations."""
    differentiated = {k for k, d in enumerate(flat.unknowns.derivative) if d >= 0}
    closing = {closure.row for closure in flat.loops.closures}
    pivots, found = dict[int, _Row](), dict[int, _Row]()
    for row, columns in enumerate(linear.rows):
        if row in closing or flat.equations.defines[row] >= 0 or not columns or differentiated.issuperset(columns):
            continue
        signs = {k: _sign(linear.explicit.get((row, k))) for k in columns}
        if not all(signs.values()):
            continue
        own = _Row(
            {k: c for k, c in signs.items() if k not in differentiated},
            {k: c for k, c in signs.items() if k in differentiated},
            {row: 1},
        )
        while (known := next((k for k in own.inner if k in pivots), -1)) >= 0:
            pivot = pivots[known]
            own.subtract(own.inner[known] * pivot.inner[known], pivot)
        place = next((k for k, c in own.inner.items() if abs(c) == 1), -1)
        if place >= 0:
            pivots[place] = own
        elif not own.inner and own.outer:
            found[row] = own
    return found


def _sign(coefficient: ca.SX | None) -> int:
    """Return 1 or -1 for these coefficients, 0 for others."""
    if coefficient is None:
        return 0
    return 1 if coefficient.is_one() else -1 if coefficient.is_minus_one() else 0
