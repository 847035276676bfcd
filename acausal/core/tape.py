"""Tapes: lists of scalar operations, in runs of one kind, that the core evaluates."""

from __future__ import annotations

import ctypes
from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import copysign
from typing import Any, TypeAlias

import casadi as ca
import numpy as np

from acausal.core.columns import COLUMNS
from acausal.core.library import ArrangedData, OperationsData, TapeData, address, loaded
from acausal.garbage import uncollected
from acausal.instructions import CONSTANT, FIND, INPUT, LOAD, PUT, VALUE, Instructions, read_instructions

Int32s: TypeAlias = "ctypes.Array[ctypes.c_int32]"

# In the order of `core.h`: the numbers are part of file formats.
KINDS = (
    *(ca.OP_ADD, ca.OP_SUB, ca.OP_MUL, ca.OP_DIV, ca.OP_NEG, ca.OP_SQ, ca.OP_TWICE, ca.OP_INV, ca.OP_SQRT, ca.OP_SIN),
    *(ca.OP_COS, ca.OP_TAN, ca.OP_ASIN, ca.OP_ACOS, ca.OP_ATAN, ca.OP_ATAN2, ca.OP_EXP, ca.OP_LOG, ca.OP_POW),
    *(ca.OP_SINH, ca.OP_COSH, ca.OP_TANH, ca.OP_ASINH, ca.OP_ACOSH, ca.OP_ATANH, ca.OP_FABS, ca.OP_SIGN, ca.OP_FLOOR),
    *(ca.OP_CEIL, ca.OP_FMOD, ca.OP_REMAINDER, ca.OP_COPYSIGN, ca.OP_FMIN, ca.OP_FMAX, ca.OP_HYPOT, ca.OP_LOG1P),
    *(ca.OP_EXPM1, ca.OP_ERF, ca.OP_LT, ca.OP_LE, ca.OP_EQ, ca.OP_NE, ca.OP_NOT, ca.OP_AND, ca.OP_OR),
    *(ca.OP_IF_ELSE_ZERO, ca.OP_ASSIGN, FIND, LOAD, PUT, VALUE),
)
KIND = {op: kind for kind, op in enumerate(KINDS)} | {ca.OP_CONSTPOW: KINDS.index(ca.OP_POW)}
# What the library takes as the kinds of a function's operations, and of its leaves.
_KINDS = KIND | {INPUT: -1, CONSTANT: -1}


@dataclass(frozen=True, eq=False)
class Tape:
    """Operations on one array of numbers: constants, inputs, results.

    Attributes
    ----------
    constants : array of float
    sizes : tuple of int
        Numbers of each argument of the function; all of them stand in the inputs, one argument after the other.
    kinds, lengths : arrays of int
        Runs of one kind of operation.
    first, second : arrays of int
        Arguments of each result; twice the same where there is one.
    early : int
        Runs at the front whose results do not change while some arguments stay what they are.
    outputs : tuple of arrays of int
        Where the nonzeros of each result of the function stand.
    """

    constants: np.ndarray
    sizes: tuple[int, ...]
    kinds: np.ndarray
    lengths: np.ndarray
    first: np.ndarray
    second: np.ndarray
    early: int
    outputs: tuple[np.ndarray, ...]

    def __post_init__(self) -> None:
        for array in (self.constants, self.kinds, self.lengths, self.first, self.second, *self.outputs):
            array.setflags(write=False)

    @property
    def size(self) -> int:
        """Length of the array of numbers."""
        return len(self.constants) + sum(self.sizes) + len(self.first)

    @cached_property
    def data(self) -> TapeData:
        """What the library takes; it holds addresses of the arrays of this tape."""
        return TapeData(*self.counts, *(array.ctypes.data for array in self.arrays), COLUMNS.address)

    @property
    def counts(self) -> tuple[int, ...]:
        """Constants, inputs, results, runs, early ones and outputs, as the library counts them."""
        return len(self.constants), sum(self.sizes), len(self.first), len(self.kinds), self.early, len(self.output)

    @property
    def arrays(self) -> tuple[np.ndarray, ...]:
        """Constants, runs, arguments and places of the outputs, in the order of the library."""
        return self.constants, self.kinds, self.lengths, self.first, self.second, self.output

    @cached_property
    def output(self) -> np.ndarray:
        """Where the nonzeros of all results stand."""
        return np.concatenate([np.zeros(0, dtype=np.int32), *self.outputs])

    def rows(self, *arguments: np.ndarray) -> np.ndarray:
        """Evaluate at many places; return all nonzeros of all results, shape (n, ...).

        Parameters
        ----------
        *arguments : arrays
            Arguments of the function: of shape (n, size), or (size,) where they are the same everywhere.
        """
        given, n, (lengths, strides, addresses) = self.parts(*arguments)
        found, work = np.empty((n, len(self.output))), np.empty(self.size)
        call = loaded().ac_tape_rows
        call(self.data, address(work), n, len(given), lengths, strides, addresses, address(found))
        return found

    def parts(
        self, *arguments: np.ndarray
    ) -> tuple[list[np.ndarray], int, tuple[Int32s, Int32s, ctypes.Array[ctypes.c_void_p]]]:
        """Return arguments at many places as the library takes them: arrays, their number of places, and lengths, strides,
        addresses of the arrays, which have to be kept meanwhile.

        Raises
        ------
        ValueError
            If they do not fit.
        """
        given = [np.ascontiguousarray(a, dtype=float) for a in arguments]
        counts = {len(a) for a in given if a.ndim == 2}
        if len(counts) > 1 or tuple([a.shape[-1] for a in given]) != self.sizes:
            raise ValueError(
                f"arguments of {self.sizes} numbers are expected, not of shapes {[a.shape for a in given]}"
            )
        strides = self._numbers(
            *[a.shape[1] if used and a.ndim == 2 else 0 for a, used in zip(given, self._used, strict=True)]
        )
        addresses = self._addresses(*map(address, given))
        return given, counts.pop() if counts else 1, (self._lengths, strides, addresses)

    @cached_property
    def _used(self) -> list[bool]:
        """Which arguments the operations and results take: the others need not be copied for each place."""
        taken = np.zeros(self.size, dtype=bool)
        taken[self.first] = taken[self.second] = taken[self.output] = True
        starts = len(self.constants) + np.cumsum([0, *self.sizes])
        return [bool(taken[first:last].any()) for first, last in pairwise(starts)]

    @cached_property
    def _addresses(self) -> type[ctypes.Array[ctypes.c_void_p]]:
        return ctypes.c_void_p * len(self.sizes)

    @cached_property
    def _numbers(self) -> type[ctypes.Array[ctypes.c_int32]]:
        return ctypes.c_int32 * len(self.sizes)

    @cached_property
    def _lengths(self) -> ctypes.Array[ctypes.c_int32]:
        return self._numbers(*self.sizes)


def make_tape(function: ca.Function, early: Collection[int] = ()) -> Tape:
    """Return the operations of a function, grouped by kind.

    Parameters
    ----------
    function : casadi.Function
        Made from SX, with dense arguments.
    early : collection of int
        Arguments that change rarely: what follows from them alone stands in front.
    """
    with uncollected():
        return _made(read_instructions(function), function, set(early))


def _made(read: Instructions, function: ca.Function, early: set[int]) -> Tape:
    kinds, first, second, late = _operations(read, early)
    same, order, run_kind, run_length = found = tuple(np.empty(len(kinds), dtype=np.int32) for _ in range(4))
    arranged = ArrangedData(0, 0, 0, *map(address, found))
    if loaded(runs=False).ac_arrange(OperationsData(len(kinds), *map(address, (kinds, first, second, late))), arranged):
        raise MemoryError
    order, runs = order[: arranged.results], arranged.runs

    sizes = tuple(function.nnz_in(k) for k in range(function.n_in()))
    starts = np.cumsum([0, *sizes])
    constants = [node for node in read.constant if same[node] == node]
    seats = np.full(len(kinds), -1, dtype=np.int32)
    seats[constants] = np.arange(len(constants))
    for node, (argument, element) in read.place.items():
        seats[node] = len(constants) + starts[argument] + element
    seats[order] = len(constants) + starts[-1] + np.arange(len(order))
    seats = seats[same]
    return Tape(
        np.array([read.constant[node] for node in constants], dtype=float),
        sizes,
        run_kind[:runs].copy(),
        run_length[:runs].copy(),
        seats[first[order]],
        seats[second[order]],
        arranged.early,
        tuple(seats[nodes] for nodes in read.results),
    )


def _operations(read: Instructions, early: set[int]) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Kind, arguments, and whether it changes often, of each operation and leaf, as `core.h` has them."""
    if unknown := set(read.op) - set(_KINDS):
        raise ValueError(f"the core does not know CasADi's operations {unknown}")
    kinds = np.array([_KINDS[op] for op in read.op], dtype=np.int32)
    first, second = (np.array([some[k] if some else 0 for some in read.arguments], dtype=np.int32) for k in (0, -1))
    late, leaves = np.zeros(len(kinds), dtype=np.int32), dict[Any, int]()
    for node, place in read.place.items():
        first[node], late[node] = leaves.setdefault(place, node), place[0] not in early
    for node, value in read.constant.items():  # zeros of both signs are equal
        first[node] = leaves.setdefault((copysign(1.0, value), value, None), node)
    return kinds, first, second, late
