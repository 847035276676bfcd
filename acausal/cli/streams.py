"""Standard output and standard error, also where they are full, closed or no longer read."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from typing import IO, Any

import typer

from acausal.errors import ExportError

WRONG, UNREAD = 2, 141


def tell(text: str) -> None:
    """Print a line on standard error, if anybody can read it."""
    with suppress(OSError, ValueError):
        typer.echo(text, err=True)


def tolerant() -> None:
    """Write what a terminal cannot show as an escape, rather than fail."""
    for stream in (sys.stdout, sys.stderr):
        change: Any = getattr(stream, "reconfigure", None)
        if change is not None:
            change(errors="backslashreplace")


@contextmanager
def aside(wanted: bool) -> Iterator[IO[str]]:
    """Give standard output for a document alone: whatever else is printed, by libraries too, goes to standard error.

    Parameters
    ----------
    wanted : bool
        False leaves standard output for everything.
    """
    if not wanted:
        yield sys.stdout
        return
    if sys.stdout is None:
        raise ExportError("cannot write the JSON document: standard output is closed; give a file, --json FILE.")
    with _own_descriptor() as own, redirect_stdout(sys.stderr):
        yield own


@contextmanager
def _own_descriptor() -> Iterator[IO[str]]:
    """Give standard output under another number, and let its own lead to standard error, where both are of the system."""
    try:
        number, errors = sys.stdout.fileno(), sys.stderr.fileno()
        kept = os.dup(number)
    except (OSError, ValueError, AttributeError):
        yield sys.stdout
        return
    sys.stdout.flush()
    own = os.fdopen(os.dup(number), "w", encoding=sys.stdout.encoding, errors="backslashreplace")
    os.dup2(errors, number)
    try:
        yield own
        own.close()
    finally:
        os.dup2(kept, number)
        os.close(kept)
        with suppress(OSError):
            own.close()


def ended(status: str | int | None) -> str | int | None:
    """Write what is still to be written on standard output and standard error, and return the exit status."""
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError as error:
        status = unwritten(error)
    try:
        if sys.stderr is not None:
            sys.stderr.flush()
    except OSError:  # nobody can be told
        _give_up(sys.stderr)
    return status


def unwritten(error: OSError) -> int:
    """Tell why standard output cannot be written, give the rest up, and return the exit status."""
    _give_up(sys.stdout)
    if isinstance(error, BrokenPipeError):
        return UNREAD  # as `head` leaves it: nothing is wrong
    tell(f"Error: cannot write standard output: {error.strerror or error}.")
    return WRONG


def _give_up(stream: Any) -> None:
    """Lose what is left in the buffer: Python would try it again as it ends, and change the exit status."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
