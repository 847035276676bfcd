"""Checks and identity of a formulation's own integrator, a function in place of `simulate`."""

from __future__ import annotations

import functools
import hashlib
import inspect
import sys
from collections.abc import Iterator, Sequence
from types import CodeType
from typing import Any

import numpy as np

from acausal.errors import DeclarationError
from acausal.language.data import plain
from acausal.language.value_checks import shown
from acausal.study.measuring.model_pickling import pack


def check_steps(name: str, steps: Any) -> None:
    """Raise DeclarationError if steps are not positive finite numbers.

    Parameters
    ----------
    name : str
        Name of the argument.
    steps : sequence of float
        Steps in s.
    """
    if isinstance(steps, str) or not isinstance(steps, Sequence | np.ndarray):
        raise DeclarationError(f"{name} is {shown(steps)}; it must be a list of steps in s, such as (1e-3, 1e-4).")
    for step in steps:
        number = isinstance(step, int | float | np.number) and not isinstance(step, bool)
        if not (number and np.isfinite(step) and step > 0):
            raise DeclarationError(f"{name} has {shown(step)}; a step is a finite number of seconds greater than 0.")


def check_function(name: str, run: Any, control: str) -> None:
    """Raise DeclarationError if a run cannot be called with the arguments of an integrator.

    Parameters
    ----------
    name : str
        Name of the formulation.
    run : callable
        Its integrator.
    control : "dt" or "tolerance"
        The refined argument.
    """
    form = f"run(model, stop_time, times, {control}=...)"
    if not callable(run):
        raise DeclarationError(
            f"formulation `{name}`: run is {shown(run)}; it must be a function, {form}, that returns a Result."
        )
    try:
        inspect.signature(run).bind(None, 0.0, None, **{control: 0.0})
    except TypeError as error:
        raise DeclarationError(f"formulation `{name}`: the run must be called as {form}: {error}.") from None
    except ValueError:
        return  # a function in C has no signature


def check_sendable(name: str, run: Any, home: str) -> None:
    """Raise DeclarationError if a run cannot be sent to workers.

    Parameters
    ----------
    name : str
        Name of the formulation.
    run : callable or None
        Its integrator.
    home : str
        Module of the class of the model.
    """
    try:
        pack(run, home)
    except DeclarationError as error:
        raise DeclarationError(f"formulation `{name}`: the run: {error}") from None


def identity_of(run: Any) -> Any:
    """Return the identity of an integrator as JSON data, the same in every session.

    Parameters
    ----------
    run : callable or None
        The integrator of a formulation.
    """
    if isinstance(run, functools.partial):
        named = sorted(run.keywords.items())
        return [identity_of(run.func), [_held(v) for v in run.args], [[name, _held(v)] for name, v in named]]
    if inspect.ismethod(run):
        return [identity_of(run.__func__), plain(run.__self__)]
    if inspect.isfunction(run):
        held = [cell.cell_contents for cell in run.__closure__ or ()]
        own = [_held(v) for v in (*held, *(run.__defaults__ or ()))]
        return [run.__module__, run.__qualname__, _digest(run.__code__), own, plain(run.__kwdefaults__)]
    return plain(run) if run is None or not hasattr(run, "__qualname__") else f"{run.__module__}.{run.__qualname__}"


def _held(value: Any) -> Any:
    return identity_of(value) if callable(value) else plain(value)


def files_of(run: Any) -> Iterator[str]:
    """Yield the names of the source files of an integrator.

    Parameters
    ----------
    run : callable or None
        The integrator of a formulation.
    """
    while isinstance(run, functools.partial):
        run = run.func
    function = getattr(run, "__func__", run)
    module = getattr(function, "__module__", None) or type(function).__module__
    if run is not None and (name := getattr(sys.modules.get(module), "__file__", None)):
        yield name


def _digest(code: CodeType) -> str:
    """Return a hash of the code of a function, without the values of its globals."""
    inner = [_digest(c) if isinstance(c, CodeType) else repr(c) for c in code.co_consts if not isinstance(c, frozenset)]
    text = repr((code.co_code, code.co_names, code.co_varnames, inner))
    return hashlib.sha256(text.encode()).hexdigest()
