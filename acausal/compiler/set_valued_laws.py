"""Set-valued laws of a model: speeds, rates, limits, and sensitivities of the rates to the shares."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

from acausal.flatten.discontinuities import Law
from acausal.flatten.origin import Origin
from acausal.reduce import ReducedModel
from acausal.symbols import stacked

MODE, SHARED, SHARE = 0, 2, 3


class SetValuedLaws:
    """The set-valued laws of a model.

    Parameters
    ----------
    reduced : ReducedModel
        The model.

    Attributes
    ----------
    places : array of int, shape (n, 5)
        Positions of `mode`, `offset`, `shared`, `share` and `slip` among the discrete variables.
    """

    def __init__(self, reduced: ReducedModel) -> None:
        self._reduced = reduced
        self._laws: tuple[Law, ...] = reduced.flat.discontinuities.laws
        self.places = np.array([law.places for law in self._laws], dtype=int).reshape(-1, 5)

    def __len__(self) -> int:
        return len(self._laws)

    @property
    def origins(self) -> list[Origin]:
        """Origin of each law."""
        return [law.origin for law in self._laws]

    def release(self, head: Any) -> None:
        """Release laws at rest, in place among switches and discrete variables, until they are decided: they may be redundant."""
        mode, shared = (self._first + self.places[:, [MODE, SHARED]].T).tolist()
        if mode:
            head[shared] = head[mode] == 0

    @property
    def _first(self) -> int:
        """Number of switches, which come before the discrete variables."""
        return len(self._reduced.flat.discontinuities.switches)

    def column(self, nominal: ca.SX, order: list[int]) -> tuple[ca.SX, ca.SX, ca.SX]:
        """Return the values of the laws as a column, and two Jacobians with a column for each law.

        The values are speeds, their rates, limits, changes of the speeds under nominal changes of the unknowns, derivatives of
        the rates by the shares with the algebraic unknowns constant, then the entries of both Jacobians: of the rates by the
        algebraic unknowns, and of the algebraic equations, in the given order, by the shares.
        """
        r = self._reduced
        columns = [ca.vertcat(*[getattr(law, name) for law in self._laws]) for name in ("speed", "rate", "limit")]
        speed, rate, limit = (r.running.resolve(column) for column in columns)
        unknowns = ca.vertcat(r.x, r.z)
        shares = r.constants[(self._first + self.places[:, SHARE]).tolist()]
        size = ca.fabs(ca.jacobian(speed, unknowns)) @ nominal
        dense = [ca.densify(e) for e in (speed, rate, limit, size, ca.jacobian(rate, shares))]
        slopes = ca.jacobian(rate, r.z).T, ca.jacobian(r.running.alg, shares)[order, :]
        entries = [stacked(J.nz[:].elements()) for J in slopes if J.nnz()]
        return ca.vertcat(*(ca.vec(value) for value in dense), *entries), *slopes
