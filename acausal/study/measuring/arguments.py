"""What studies ask of their arguments before anything is run."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Executor
from contextlib import AbstractContextManager, nullcontext
from typing import Any

from acausal.errors import DeclarationError
from acausal.language.component import Component
from acausal.simulation.stop_time import check_stop_time, own_stop_time
from acausal.study.measuring.pool import cluster, processes


def executor_of(executor: Executor | str | None, workers: int | None) -> AbstractContextManager[Executor]:
    """Return where points run: processes on this machine, a cluster by its address, or what is given.

    Parameters
    ----------
    executor : Executor, str or None
        Of the kind of concurrent.futures, address of a Dask scheduler or "local", or None for processes.
    workers : int, optional
        Number of local processes; one for each core if not given.
    """
    if executor is None:
        return processes(workers)
    return cluster(executor, workers) if isinstance(executor, str) else nullcontext(executor)


def stop_time_of(model: Component, given: float | None, values: Mapping[str, Any]) -> float:
    """Return the stop time that is given, or that of the model, in s.

    Parameters
    ----------
    model : Component
        Its attribute `stop_time` is its own.
    given : float, optional
        In s.
    values : mapping of str to value
        Values by path that replace those of the model.
    """
    own = own_stop_time(model, values) if given is None else given
    if own is None:
        raise DeclarationError(f"{type(model).__name__} tells no stop_time; give one: stop_time=2.0.")
    return check_stop_time(own)


def check_counts(least: int = 1, **counts: Any) -> None:
    """Refuse what is no whole number, or less than the least.

    Parameters
    ----------
    least : int
        The least value.
    **counts : object
        Values by the name of the argument.
    """
    for name, value in counts.items():
        if isinstance(value, bool) or not isinstance(value, int) or value < least:
            raise DeclarationError(f"{name} is {value!r}; it must be a whole number of at least {least}.")


def check_shares(example: float, **shares: Any) -> None:
    """Refuse what is no number between 0 and 1.

    Parameters
    ----------
    example : float
        What could be given.
    **shares : object
        Values by the name of the argument.
    """
    for name, value in shares.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not 0 < value < 1:
            raise DeclarationError(f"{name} is {value!r}; it must lie between 0 and 1, for instance {example:g}.")


def check_limit(limit: Any) -> None:
    """Refuse a limit of seconds that is none."""
    if isinstance(limit, bool) or not isinstance(limit, int | float) or not limit > 0:
        raise DeclarationError(f"limit is {limit!r}; it must be a number of seconds greater than 0.")
