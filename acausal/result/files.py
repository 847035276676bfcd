"""Files that are written whole or not at all."""

from __future__ import annotations

import os
import shutil
import uuid
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any

from acausal.errors import ExportError


def check_writable(path: str | Path) -> None:
    """Check before any work is done whether a file can be written.

    Raises
    ------
    ExportError
        With the reason why not.
    """
    target = _target(path)
    if _is_device(target):
        return
    with _reasons(path):
        temporary = _beside(target)
        temporary.touch(exist_ok=False)
        temporary.unlink()


@contextmanager
def whole(path: str | Path, mode: str = "w") -> Iterator[IO[Any]]:
    """Open a file that replaces the old one of its name when the block succeeds, and leaves it otherwise.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    mode : "w" or "wb"
        Text in UTF-8, or bytes.

    Raises
    ------
    ExportError
        If it cannot be written.
    """
    target = _target(path)
    text: dict[str, Any] = {} if "b" in mode else {"encoding": "utf-8", "newline": ""}
    with _reasons(path):
        if _is_device(target):
            with open(target, mode, **text) as file:
                yield file
            return
        temporary = _beside(target)
        try:
            with open(temporary, mode, **text) as file:
                yield file
            if target.exists():
                shutil.copymode(target, temporary)
            os.replace(temporary, target)
        finally:
            with suppress(OSError):
                temporary.unlink()


def _target(path: str | Path) -> Path:
    """Return the intended file, links followed, or raise ExportError where none is possible."""
    if not str(path).strip():
        raise ExportError("cannot write: the name of the file is empty; give one, such as out.csv.")
    target = Path(path).expanduser().resolve()
    if not target.is_dir() and os.path.basename(path) in ("", ".", ".."):  # a Path forgets the slash at the end
        raise ExportError(f"cannot write {path}: that is the name of a directory; append a file name.")
    if target.is_dir():
        raise ExportError(f"cannot write {path}: it is a directory; append a file name.")
    if not target.parent.is_dir():
        raise ExportError(f"cannot write {path}: there is no directory {target.parent}; create it first.")
    if target.exists() and not os.access(target, os.W_OK):
        raise ExportError(f"cannot write {path}: the file is write-protected.")
    return target


def _is_device(target: Path) -> bool:
    # Replacing /dev/stdout or a pipe by a file would destroy it.
    return target.exists() and not target.is_file()


def _beside(target: Path) -> Path:
    return target.with_name(f".{uuid.uuid4().hex}.part")


@contextmanager
def _reasons(path: str | Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise ExportError(f"cannot write {path}: {error.strerror or error}.") from None
