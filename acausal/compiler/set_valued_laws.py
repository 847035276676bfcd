"""Set-valued laws of a model as numerical functions: speeds, rates, limits, and sensitivities of the rates to the shares."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np
import scipy

from acausal.compiler.call import Call
from acausal.flatten.discontinuities import Law
from acausal.flatten.origin import Origin
from acausal.reduce import ReducedModel
from acausal.symbols import stacked

MODE, OFFSET, SHARED, SHARE, SLIP = range(5)


@dataclass(frozen=True, eq=False)
class LawValues:
    """Values of n set-valued laws at one point.

    Attributes
    ----------
    speed, rate, limit : arrays, shape (n,)
        Speed, its rate, and the limit of each law.
    size : array, shape (n,)
        Change of each speed under nominal changes of the unknowns.
    by_share : array, shape (n, n)
        Derivatives of the rates by the shares with the algebraic unknowns constant.
    by_unknown, equations : sparse matrices, shapes (n, nz), (nz, n)
        Derivatives of the rates by the algebraic unknowns, and of the algebraic equations by the shares.
    """

    speed: np.ndarray
    rate: np.ndarray
    limit: np.ndarray
    size: np.ndarray
    by_share: np.ndarray
    by_unknown: scipy.sparse.csc_matrix
    equations: scipy.sparse.csc_matrix


class SetValuedLaws:
    """The set-valued laws of a model.

    Parameters
    ----------
    reduced : ReducedModel
        The model.
    arguments : list of casadi.SX
        x, z, parameters, time and constants.

    Attributes
    ----------
    places : array of int, shape (n, 5)
        Positions of `mode`, `offset`, `shared`, `share` and `slip` among the discrete variables.
    """

    def __init__(self, reduced: ReducedModel, arguments: list[ca.SX]) -> None:
        self._reduced, self._arguments = reduced, arguments
        self._laws: tuple[Law, ...] = reduced.flat.discontinuities.laws
        self.places = np.array([law.places for law in self._laws], dtype=int).reshape(-1, 5)

    def __len__(self) -> int:
        return len(self._laws)

    @property
    def origins(self) -> list[Origin]:
        """Origin of each law."""
        return [law.origin for law in self._laws]

    def __call__(self, nominal: np.ndarray, *arguments: Any) -> LawValues:
        """Evaluate at nominal changes of the unknowns, x, z, parameters, time and constants."""
        speed, rate, limit, size, by_share, *slopes = (value.copy() for value in self._call(*arguments, nominal))
        matrices = []
        for k, entries in enumerate(slopes, 5):
            pattern = self._call.function.sparsity_out(k)
            matrices.append(scipy.sparse.csc_matrix((entries, pattern.row(), pattern.colind()), shape=pattern.shape))
        return LawValues(speed, rate, limit, size, by_share.reshape(len(self), -1, order="F"), *matrices)

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
        """Return the values as a column, sparse entries last, and both Jacobians with a column for each law.

        The algebraic equations are in the given order.
        """
        *dense, by_unknown, equations = self._call.function(*self._arguments, nominal)
        slopes = by_unknown.T, equations[order, :]
        entries = [stacked(J.nz[:].elements()) for J in slopes if J.nnz()]
        return ca.vertcat(*(ca.vec(value) for value in dense), *entries), *slopes

    @cached_property
    def _call(self) -> Call:
        r = self._reduced
        columns = [ca.vertcat(*[getattr(law, name) for law in self._laws]) for name in ("speed", "rate", "limit")]
        speed, rate, limit = (r.running.resolve(column) for column in columns)
        unknowns, nominal = ca.vertcat(r.x, r.z), ca.SX.sym("nominal", r.x.numel() + r.z.numel())
        shares = r.constants[(self._first + self.places[:, SHARE]).tolist()]
        size = ca.fabs(ca.jacobian(speed, unknowns)) @ nominal
        dense = [ca.densify(e) for e in (speed, rate, limit, size, ca.jacobian(rate, shares))]
        slopes = [ca.jacobian(rate, r.z), ca.jacobian(r.running.alg, shares)]
        return Call(ca.Function("laws", [*self._arguments, nominal], [*dense, *slopes]))
