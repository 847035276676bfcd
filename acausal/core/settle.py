"""Algebraic unknowns that satisfy their equations, at many places in one call of the core."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import pointer
from dataclasses import dataclass
from functools import cached_property

import casadi as ca
import numpy as np

from acausal.core.library import Pool, SquareData, address, loaded
from acausal.core.tape import Tape, make_tape
from acausal.instructions import READABLE
from acausal.symbols import dense


@dataclass(frozen=True, eq=False)
class Square:
    """As many equations as unknowns.

    Attributes
    ----------
    tape : Tape
        Residuals and entries of their Jacobian.
    early : int
        Arguments at the front that change rarely.
    start, row : arrays of int
        Sparsity of the Jacobian in columns.
    unknowns : array of int
        Places of the unknowns among the arguments, which stand one after the other.
    """

    tape: Tape
    early: int
    start: np.ndarray
    row: np.ndarray
    unknowns: np.ndarray

    @cached_property
    def data(self) -> SquareData:
        """What the library takes; it holds addresses of the arrays of these equations."""
        arrays = (array.ctypes.data for array in (self.start, self.row, self.unknowns))
        return SquareData(len(self.unknowns), pointer(self.tape.data), *arrays)

    def hold(self, *arguments: np.ndarray, sizes: np.ndarray, tolerance: float) -> np.ndarray:
        """Whether the residuals at n places are no more than a part of the sizes of their terms in the unknowns, shape (n,).

        Parameters
        ----------
        *arguments : arrays
            As of `Settler`.
        sizes : array, shape (n, unknowns)
            Of the unknowns.
        tolerance : float
            That part.
        """
        found, n = self.tape.rows(*arguments), len(self.unknowns)
        parts, terms = np.abs(found[:, n:]) * sizes[:, self._columns], np.zeros((len(found), n))
        np.add.at(terms.T, self.row, parts.T)
        return np.all(np.abs(found[:, :n]) <= tolerance * terms, axis=1)

    @cached_property
    def _columns(self) -> np.ndarray:
        """The unknown of each entry, counted from the first."""
        return np.repeat(np.arange(len(self.unknowns)), np.diff(self.start))

    @cached_property
    def pool(self) -> Pool:
        """Memory for solving them."""
        return Pool("settler", self.data)


def make_square(arguments: Sequence[ca.SX], early: int, residuals: ca.SX, argument: int, places: np.ndarray) -> Square:
    """Return equations for some entries of an argument.

    Parameters
    ----------
    arguments : sequence of casadi.SX
        What the residuals may hold.
    early : int
        Arguments at the front that change rarely.
    residuals : casadi.SX
        n expressions that have to be 0.
    argument : int
        Which of the arguments holds the unknowns.
    places : array, shape (n,)
        Places of the unknowns in it.
    """
    J = ca.jacobian(residuals, arguments[argument][places.tolist()])
    function = ca.Function("square", list(arguments), [ca.vertcat(dense(residuals), J.nz[:])], READABLE)
    start, row = (np.array(part, dtype=np.int32) for part in (J.sparsity().colind(), J.sparsity().row()))
    before = sum(a.numel() for a in arguments[:argument])
    return Square(make_tape(function, early=range(early)), early, start, row, (before + places).astype(np.int32))


class Settler:
    """Solves equations by Newton's method, with memory of its own, for one thread at a time.

    Parameters
    ----------
    square : Square
        The equations.

    Attributes
    ----------
    evaluations : int
        Evaluations of residuals and Jacobian so far.
    """

    def __init__(self, square: Square) -> None:
        self._library, self.square, self.evaluations = loaded(), square, 0
        self._memory = square.pool.take()

    def __del__(self) -> None:
        if getattr(self, "_memory", None):
            self.square.pool.give(self._memory)

    def __call__(self, *arguments: np.ndarray, size: np.ndarray, enough: float) -> tuple[np.ndarray, np.ndarray]:
        """Return the unknowns at n places, shape (n, unknowns), and whether they are those of the equations.

        Parameters
        ----------
        *arguments : arrays
            Arguments of the equations, the unknowns nearly right: of shape (n, size), or (size,) where they are the same
            everywhere.
        size : array
            Of each unknown.
        enough : float
            Change over the size in a step after which the next one would change rounding only.
        """
        given, n, parts = self.square.tape.parts(*arguments)
        size = np.ascontiguousarray(size, dtype=float)
        found, settled = np.empty((n, len(self.square.unknowns))), np.empty(n, dtype=np.int32)
        lengths, strides, addresses = parts
        self.evaluations += self._library.ac_settle_rows(
            *(self._memory, n, len(given), self.square.early, lengths, strides, addresses),
            *(address(size), enough, address(found), address(settled)),
        )
        return found, settled > 0

    @property
    def least(self) -> float:
        """The least pivot at the last place, over the terms that it is the sum of: where it is rounding, so are solutions."""
        return self._library.ac_settler_least(self._memory)
