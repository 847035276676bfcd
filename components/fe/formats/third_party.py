"""Files that other packages read: found, read, and their errors told as those of a file."""

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
from components.fe.formats.text import wrong

Read = TypeVar("Read")


def installed(name: str, extra: str, what: str) -> None:
    """Refuse what needs a package that is not installed.

    Parameters
    ----------
    name : str
        A module.
    extra : str
        Optional dependencies of acausal that hold it.
    what : str
        What needs it, for the message.

    Raises
    ------
    DeclarationError
        With what installs it.
    """
    try:
        found = find_spec(name) is not None
    except ImportError:
        found = False
    if not found:
        raise DeclarationError(
            f"{what} needs the module {name}, which is not installed: python -m pip install 'acausal[{extra}]'."
        )


def package(name: str, extra: str, what: str) -> Any:
    """Return a module of a package that is not always installed, or refuse as `installed` does.

    How numpy prints stays as the user has it: pyyeti changes it for all, already where its packages are looked through.
    """
    with np.printoptions():
        installed(name, extra, what)
        return import_module(name)


def existing(path: str | Path, what: str) -> Path:
    """Return a file that exists, or refuse it."""
    found = Path(path).expanduser()
    if not found.is_file():
        why = "it is a directory" if found.is_dir() else "there is no such file"
        raise DeclarationError(f"cannot read {what} {shown_name(path)}: {why}.")
    return found


def read_by(read: Callable[[], Read], path: str | Path, what: str) -> Read:
    """Return what a function of another package reads.

    Such functions raise anything at files that are not what they expect, end the process, and warn of files that end
    early; all of it means that the file is wrong.

    Parameters
    ----------
    read : function
        Without arguments.
    path : str or Path
        The file, for messages.
    what : str
        What it is expected to be.

    Raises
    ------
    DeclarationError
        If it does not return.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            warnings.simplefilter("error", RuntimeWarning)
            return read()
    except (Exception, SystemExit) as error:
        text = (str(error).strip().splitlines() or [""])[0].rstrip(". ")[:200]
        why = f"{type(error).__name__}: {text}" if text else type(error).__name__
        raise wrong(path, f"this is not {what}, or not whole ({why})") from None
