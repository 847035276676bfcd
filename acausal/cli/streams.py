"""Standard output and standard error, with handling of streams that are full, closed or no longer read."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from typing import IO, Any

import typer

from acausal.errors import ExportError
from acausal.result.tables import WIDTH, wrapped

WRONG, UNREAD = 2, 141


def tell(text: str) -> None:
    """Print a line on standard error; do nothing if it is closed."""
    with suppress(OSError, ValueError):
        typer.echo(fitted(text, sys.stderr), err=True)


def fitted(text: str, stream: Any, indent: int = 2) -> str:
    """Return text with lines broken and indented to fit a terminal; unchanged for files and pipes.

    Parameters
    ----------
    text : str
        The lines.
    stream : text stream or None
        Where the text will be written.
    indent : int
        Indent of the rest of a broken line.
    """
    if stream is None or not stream.isatty():
        return text
    width = min(shutil.get_terminal_size().columns, WIDTH)
    return wrapped(text.splitlines(), width, indent)


def escape_unencodable() -> None:
    """Escape characters that a terminal cannot show, instead of failing."""
    for stream in (sys.stdout, sys.stderr):
        change: Any = getattr(stream, "reconfigure", None)
        if change is not None:
            change(errors="backslashreplace")


@contextmanager
def reserved_output(wanted: bool) -> Iterator[IO[str]]:
    """Reserve standard output for a document: all other output, of libraries too, goes to standard error.

    Parameters
    ----------
    wanted : bool
        If False, standard output stays as it is.
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
    """Duplicate the descriptor of standard output, and redirect the original to standard error.

    Streams without a descriptor are yielded as they are.
    """
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


def flushed(status: str | int | None) -> str | int | None:
    """Flush standard output and standard error, and return the exit status."""
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError as error:
        status = report_unwritten(error)
    try:
        if sys.stderr is not None:
            sys.stderr.flush()
    except OSError:  # no stream is left for a message
        _give_up(sys.stderr)
    return status


def report_unwritten(error: OSError) -> int:
    """Report why standard output cannot be written, discard the rest, and return the exit status."""
    _give_up(sys.stdout)
    if isinstance(error, BrokenPipeError):
        return UNREAD  # the reader, such as `head`, has closed the pipe: not an error
    tell(f"Error: cannot write standard output: {error.strerror or error}.")
    return WRONG


def _give_up(stream: Any) -> None:
    """Discard the buffer of a stream: Python would flush it again at exit, and change the exit status."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
