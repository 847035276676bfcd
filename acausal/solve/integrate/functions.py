"""Functions that a run calls at its events: copies of those of the model."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass
from math import prod
from typing import Any, NoReturn

import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import DeclarationError
from acausal.flatten.discontinuities import FunctionCall
from acausal.flatten.origin import Origin
from acausal.solve.integrate.ladder import Failure


@dataclass(frozen=True)
class _Place:
    """Entries of the arguments and of the results that belong to one call."""

    origin: Origin
    arguments: list[tuple[slice, tuple[int, ...]]]
    results: list[tuple[slice, tuple[int, ...]]]


class Functions:
    """Functions of one run.

    Parameters
    ----------
    compiled : CompiledModel
        The model; its own functions are never called, so that every run begins alike.

    Attributes
    ----------
    arguments, results : arrays
        Of all calls, where the core writes and reads them.
    """

    def __init__(self, compiled: CompiledModel) -> None:
        ordered = compiled.guards.calls.ordered
        guards = compiled.guards.guards
        self._places, ends = list[_Place](), (0, 0)
        for k, call in ordered:
            arguments, to = _entries(call.argument_shapes, ends[0])
            results, by = _entries(call.result_shapes, ends[1])
            self._places.append(_Place(guards[k].origin, arguments, results))
            ends = to, by
        self.arguments, self.results = np.zeros(ends[0]), np.zeros(ends[1])
        self._functions = _copied([(guards[k].origin, call) for k, call in ordered])
        self._at = [np.nan] * len(ordered)  # time of the last call
        self._saved: Any = None
        self._failed: tuple[int, float, BaseException] | None = None

    def __len__(self) -> int:
        return len(self._places)

    def __call__(self, number: int, time: float) -> int:
        """Call a function; return whether it fails. An instant that is repeated has the same results, but of pure functions."""
        is_known = time == self._at[number] and not getattr(self._functions[number], "pure", False)
        if is_known or self._failed:
            return self._failed is not None
        place = self._places[number]
        try:
            given = [self.arguments[at].reshape(shape, order="F")[()] for at, shape in place.arguments]
            found = self._functions[number](time, *[np.copy(a) if a.shape else float(a) for a in given])
            self._take(place, found)
        except BaseException as error:  # what ends a run passes the core first
            self._failed = number, time, error
            return 1
        self._at[number] = time
        return 0

    def _take(self, place: _Place, found: Any) -> None:
        many = len(place.results) > 1
        if many and (not isinstance(found, tuple) or len(found) != len(place.results)):
            raise ValueError(f"it must return a tuple of {len(place.results)} values, not {found!r}")
        for (at, shape), value in zip(place.results, found if many else [found], strict=True):
            value = np.asarray(value, dtype=float)
            if value.shape != shape and not (value.size == prod(shape) == 1):
                raise ValueError(f"it must return {_of(shape)}, not {_of(value.shape)}")
            if not np.all(np.isfinite(value)):
                raise ValueError(f"it returns {value}, which is not finite")
            self.results[at] = value.ravel(order="F")

    def save(self) -> None:
        """Save what `restore` goes back to."""
        try:
            self._saved = deepcopy((self._functions, self._at, self.results))
        except Exception:  # what refuses a copy in a run, as an FMU does, was copied before it
            self._saved = None

    def restore(self, time: float) -> None:
        """Go back to what was saved, at a time.

        Raises
        ------
        Failure
            If a function has no copy in a run.
        """
        if self._saved is None:
            raise Failure(
                time,
                "the run goes back to there, to choose other states for its loops, and a function that it calls has no copy. "
                'Take constraints="projection", which chooses none.',
            )
        self._functions, self._at, self.results[:] = deepcopy(self._saved)

    def refuse(self) -> NoReturn:
        """Raise what a function raised, an error of it as a Failure."""
        assert self._failed is not None
        number, time, error = self._failed
        if not isinstance(error, Exception):
            raise error
        what = f"{type(error).__name__}: " * (type(error) is not ValueError)
        raise Failure(time, f"{self._places[number].origin.owner}: its function fails: {what}{error}") from error


def _entries(shapes: tuple[tuple[int, ...], ...], begin: int) -> tuple[list[tuple[slice, tuple[int, ...]]], int]:
    found = []
    for shape in shapes:
        found.append((slice(begin, begin := begin + prod(shape)), shape))
    return found, begin


def _copied(calls: list[tuple[Origin, FunctionCall]]) -> list[Callable[..., Any]]:
    """Return copies of functions, reset; objects that functions share stay shared."""
    memo, found = dict[int, Any](), list[Callable[..., Any]]()
    for origin, call in calls:
        try:
            found.append(deepcopy(call.function, memo))
        except Exception as error:
            raise DeclarationError(
                f"{origin.owner}: its function cannot be copied for a run: {error}. Give its class a method __deepcopy__."
            ) from error
    owners = {id(own): own for own in (getattr(function, "__self__", function) for function in found)}
    for owner in owners.values():
        if callable(reset := getattr(owner, "reset", None)):
            reset()
    return found


def _of(shape: tuple[int, ...]) -> str:
    return f"an array of shape {shape}" if shape else "one number"
