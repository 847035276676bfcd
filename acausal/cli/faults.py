"""Python errors in the user's file, as short messages with file and line."""

from __future__ import annotations

import os
import re
import sys
import traceback
from pathlib import Path

from acausal.errors import PACKAGE, AcausalError, DeclarationError
from acausal.nearest import most_similar
from acausal.shadowed import NAMES, shadowed

_PACKAGES = tuple(str(Path(PACKAGE).parent / name) + os.sep for name in ("acausal", "components"))
_NO_TEXT: dict[type[BaseException], str] = {MemoryError: "this needs more memory than there is"}
_NOT_THERE = re.compile(r"cannot import name '(.+?)' from '(.+?)'")


def place_in(error: BaseException, path: Path) -> str:
    """Return "file:line" of the innermost line of the user's files in a traceback, "" if there is none.

    Parameters
    ----------
    error : BaseException
        The error.
    path : Path
        The user's file; files beside it count as the user's too.
    """
    if isinstance(error, SyntaxError) and error.filename and _is_users(error.filename, path):
        return f"{error.filename}:{error.lineno}" if error.lineno else error.filename
    lines = [(f.filename, f.lineno) for f in traceback.extract_tb(error.__traceback__) if _is_users(f.filename, path)]
    return f"{lines[-1][0]}:{lines[-1][1]}" if lines else ""


def exit_error(error: SystemExit, path: Path) -> DeclarationError:
    """Return the error for a file that exits when it is loaded."""
    return DeclarationError(
        f"{place_in(error, path) or path}: the file ends the program here (SystemExit: {error.code}), but it should "
        'only define a model. Put code that runs, sys.exit included, under `if __name__ == "__main__":`.'
    )


def brief(error: BaseException) -> str:
    """Return type and first line of an error, and the remedy if known."""
    if isinstance(error, AcausalError):
        return str(error)
    text = error.msg if isinstance(error, SyntaxError) else str(error)
    first = (text.splitlines() or [_NO_TEXT.get(type(error), "")])[0]
    if isinstance(error, ImportError):
        return _not_imported(error, first)
    return f"{type(error).__name__}: {first}" if first else type(error).__name__


def _not_imported(error: ImportError, text: str) -> str:
    if (error.name or "").partition(".")[0] in NAMES and (hidden := shadowed()):
        return f"{type(error).__name__}: {text.partition(' (')[0]}: {hidden}"
    missing = _NOT_THERE.search(text)
    if missing:
        name, module = missing.groups()
        near = most_similar(name, [n for n in dir(sys.modules.get(module)) if n[:1] != "_"])
        remedy = f"; did you mean `{near}`?" if near else "."
        return f"{type(error).__name__}: there is no `{name}` in {module}{remedy}"
    if "relative import" in text:
        return (
            "the file is not in a package: write `import helper`, not `from . import helper`, for the file beside it."
        )
    if isinstance(error, ModuleNotFoundError) and error.name:
        return f"{type(error).__name__}: {text}; install it, or put {error.name}.py beside this file."
    return f"{type(error).__name__}: {text}"


def _is_users(name: str, path: Path) -> bool:
    """Return whether a file is the user's: the given one, or one beside or below it that is not of an installed package."""
    if name == str(path):
        return True
    return name.startswith(f"{path.parent}{os.sep}") and "site-packages" not in name and not name.startswith(_PACKAGES)
