"""Readers of optional packages, with their failures reported as errors of the file."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from acausal import DeclarationError
from acausal.result import shown_name
from components.fe.formats.text import file_error

Read = TypeVar("Read")


def require_module(name: str, extra: str, what: str) -> None:
    """Raise an error unless a module is installed.

    Parameters
    ----------
    name : str
        Module.
    extra : str
        Optional dependencies of acausal that include the module.
    what : str
        Task that needs the module, for the message.

    Raises
    ------
    DeclarationError
        If the module is missing; the message has the command that installs it.
    """
    try:
        found = find_spec(name) is not None
    except ImportError:
        found = False
    if not found:
        raise DeclarationError(
            f"{what} needs the module {name}, which is not installed: python -m pip install 'acausal[{extra}]'."
        )


def optional_module(name: str, extra: str, what: str) -> Any:
    """Return a module of an optional package, or raise the error of `require_module`.

    The print options of numpy are restored because importing pyyeti, and already finding its submodules, changes them.
    """
    with np.printoptions():
        require_module(name, extra, what)
        return import_module(name)


def existing_file(path: str | Path, what: str) -> Path:
    """Return the path of a file with `~` expanded; raise DeclarationError if there is no such file."""
    found = Path(path).expanduser()
    if not found.is_file():
        why = "it is a directory" if found.is_dir() else "there is no such file"
        raise DeclarationError(f"cannot read {what} {shown_name(path)}: {why}.")
    return found


def call_reader(read: Callable[[], Read], path: str | Path, what: str) -> Read:
    """Call a reader of another package and report its failure as an error of the file.

    For invalid files such readers raise any exception or exit the process, and for truncated files some only warn.

    Parameters
    ----------
    read : function
        Without arguments.
    path : str or Path
        The file, for messages.
    what : str
        Expected kind of file.

    Raises
    ------
    DeclarationError
        If the reader raises an exception, exits or warns.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            warnings.simplefilter("error", RuntimeWarning)
            return read()
    except (Exception, SystemExit) as error:
        text = (str(error).strip().splitlines() or [""])[0].rstrip(". ")[:200]
        why = f"{type(error).__name__}: {text}" if text else type(error).__name__
        raise file_error(path, f"this is not {what}, or is truncated ({why})") from None
