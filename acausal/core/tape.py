"""Tapes: lists of scalar operations, in runs of one kind, that the core evaluates."""

from __future__ import annotations

import ctypes
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import copysign
from typing import Any, TypeAlias

import casadi as ca
import numpy as np

from acausal.core.library import TapeData, address, loaded
from acausal.garbage import uncollected
from acausal.instructions import Instructions, read_instructions

Int32s: TypeAlias = "ctypes.Array[ctypes.c_int32]"

# In the order of `core.h`: the numbers are part of file formats.
KINDS = (
    *(ca.OP_ADD, ca.OP_SUB, ca.OP_MUL, ca.OP_DIV, ca.OP_NEG, ca.OP_SQ, ca.OP_TWICE, ca.OP_INV, ca.OP_SQRT, ca.OP_SIN),
    *(ca.OP_COS, ca.OP_TAN, ca.OP_ASIN, ca.OP_ACOS, ca.OP_ATAN, ca.OP_ATAN2, ca.OP_EXP, ca.OP_LOG, ca.OP_POW),
    *(ca.OP_SINH, ca.OP_COSH, ca.OP_TANH, ca.OP_ASINH, ca.OP_ACOSH, ca.OP_ATANH, ca.OP_FABS, ca.OP_SIGN, ca.OP_FLOOR),
    *(ca.OP_CEIL, ca.OP_FMOD, ca.OP_REMAINDER, ca.OP_COPYSIGN, ca.OP_FMIN, ca.OP_FMAX, ca.OP_HYPOT, ca.OP_LOG1P),
    *(ca.OP_EXPM1, ca.OP_ERF, ca.OP_LT, ca.OP_LE, ca.OP_EQ, ca.OP_NE, ca.OP_NOT, ca.OP_AND, ca.OP_OR),
    *(ca.OP_IF_ELSE_ZERO, ca.OP_ASSIGN),
)
KIND = {op: kind for kind, op in enumerate(KINDS)} | {ca.OP_CONSTPOW: KINDS.index(ca.OP_POW)}


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
        return TapeData(*self.counts, *(array.ctypes.data for array in self.arrays))

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
        return _made(_merged(read_instructions(function)), function, set(early))


def _made(read: Instructions, function: ca.Function, early: set[int]) -> Tape:
    sizes = tuple(function.nnz_in(k) for k in range(function.n_in()))
    starts = np.cumsum([0, *sizes])
    constants = list(read.constant)
    seats = np.full(len(read.op), -1, dtype=np.int32)
    seats[constants] = np.arange(len(constants))
    for node, (argument, element) in read.place.items():
        seats[node] = len(constants) + starts[argument] + element
    order, kinds, lengths, early_runs = _grouped(read, early)
    seats[order] = len(constants) + starts[-1] + np.arange(len(order))
    first, second = (seats[[read.arguments[node][k] for node in order]] for k in (0, -1))
    return Tape(
        np.array(list(read.constant.values()), dtype=float),
        sizes,
        np.array(kinds, dtype=np.int32),
        np.array(lengths, dtype=np.int32),
        first,
        second,
        early_runs,
        tuple(seats[nodes] for nodes in read.results),
    )


def _merged(read: Instructions) -> Instructions:
    """Return the operations without those that do the same to the same (value numbering)."""
    place: list[int] = []
    known: dict[Any, int] = {}
    found = Instructions([], [], {}, {}, [])
    for node, (op, arguments) in enumerate(zip(read.op, read.arguments, strict=True)):
        if arguments:
            own = [place[k] for k in arguments]
            key = op, own[0], own[-1]
        elif node in read.place:
            own, key = (), read.place[node]
        else:  # zeros of both signs are equal
            own, key = (), (op, copysign(1.0, read.constant[node]), read.constant[node])
        here = known.get(key)
        if here is None:
            known[key] = here = len(found.op)
            found.op.append(op)
            found.arguments.append(own)
            if node in read.place:
                found.place[here] = read.place[node]
            elif not own:
                found.constant[here] = read.constant[node]
        place.append(here)
    return replace(found, results=[[place[node] for node in nodes] for nodes in read.results])


def _grouped(read: Instructions, early: set[int]) -> tuple[list[int], list[int], list[int], int]:
    """Order of the operations, kind and length of each run, and the number of runs that need early arguments alone."""
    late, users, waits = list[bool](), list[list[int]](), list[int]()
    for node, arguments in enumerate(read.arguments):
        users.append([])
        waits.append(len(arguments))
        for argument in arguments:
            users[argument].append(node)
        if arguments:
            late.append(late[arguments[0]] or late[arguments[-1]])
        else:
            late.append(node in read.place and read.place[node][0] not in early)
    kinds = [KIND.get(op, -1) for op in read.op]
    order: list[int] = []
    runs: list[tuple[int, int]] = []
    ready: tuple[dict[int, list[int]], dict[int, list[int]]] = ({}, {})

    def go(nodes: Iterable[int]) -> None:
        """Let follow what waited for these alone; what becomes ready meanwhile may be among them."""
        for node in nodes:
            for user in users[node]:
                waits[user] -= 1
                if not waits[user]:
                    ready[late[user]].setdefault(kinds[user], []).append(user)

    go(node for node, arguments in enumerate(read.arguments) if not arguments)
    ends = []
    for stage in ready:
        while any(stage.values()):
            kind = max(stage, key=lambda kind: len(stage[kind]))
            go(stage[kind])
            runs.append((kind, len(stage[kind])))
            order += stage[kind]
            stage[kind] = []
        ends.append(len(runs))
    return order, [kind for kind, _ in runs], [length for _, length in runs], ends[0]
