"""Files: atomic writing, reading of text and JSON, and messages about what fails."""

from __future__ import annotations

import json
import os
import shutil
import uuid
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any, NoReturn

from acausal.errors import AcausalError, DeclarationError, ExportError

SHOWN = 60  # characters shown of a long file name, from its beginning
DIGITS = 300  # longest integer in a JSON document: longer ones exceed the range of a double


def check_writable(path: str | Path) -> None:
    """Check that a file can be written, before any work is done.

    Raises
    ------
    ExportError
        If it cannot, with the reason.
    """
    with _reasons("write", path):
        target = _target(path)
        if _is_device(target):
            return
        temporary = _beside(target)
        temporary.touch(exist_ok=False)
        temporary.unlink()


@contextmanager
def whole(path: str | Path, mode: str = "w") -> Iterator[IO[Any]]:
    """Open a file for writing that replaces an old one only if the block succeeds.

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
    # The text may contain a file name that is not valid UTF-8.
    text: dict[str, Any] = {} if "b" in mode else {"encoding": "utf-8", "newline": "", "errors": "backslashreplace"}
    with _reasons("write", path):
        target = _target(path)
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


def read_text(path: str | Path, what: str = "", encoding: str = "utf-8-sig") -> str:
    """Return the content of a text file.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    what : str
        What the file is, for messages.
    encoding : str
        Encoding of the text.

    Raises
    ------
    DeclarationError
        If it cannot be read, with the reason.
    """
    verb = f"read {what}".rstrip()
    with _reasons(verb, path):
        source = _named(verb, path)
        if source.is_dir():
            _refuse(verb, path, "it is a directory; append a file name")
        if source.is_char_device() or source.is_block_device():
            _refuse(verb, path, "it is a device, not a file")
        try:
            return source.read_text(encoding=encoding)
        except UnicodeDecodeError:
            _refuse(verb, path, "it is not a text in UTF-8")


def document(text: str) -> Any:
    """Parse a JSON document strictly.

    Parameters
    ----------
    text : str
        The document.

    Raises
    ------
    ValueError
        If it is not valid JSON, repeats a name, or contains NaN or an infinity.
    """
    try:
        return json.loads(text, object_pairs_hook=_once, parse_constant=_no_number, parse_int=_integer)
    except RecursionError:
        raise ValueError("its brackets are nested too deeply") from None
    except json.JSONDecodeError as error:
        if not text.strip():
            raise ValueError("it is empty") from None
        raise ValueError(
            f"line {error.lineno}, column {error.colno}: {error.msg.lower().removesuffix(' starting at')}"
        ) from None


def same_file(one: str | Path, other: str | Path) -> bool:
    """Return whether two names refer to the same file, which need not exist; devices are never the same file."""
    with suppress(OSError, RuntimeError, ValueError):
        first, second = (Path(path).expanduser().resolve() for path in (one, other))
        return first == second and not _is_device(first)
    return False


def shown_name(path: object) -> str:
    """Return the name of a file for a message, shortened if it is long."""
    text = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in str(path))
    return text if len(text) <= 2 * SHOWN else f"{text[:SHOWN]}...{text[-SHOWN // 2 :]}"


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        raise ValueError(f"has `{next(name for name in found if names.count(name) > 1)}` more than once")
    return found


def _no_number(text: str) -> NoReturn:
    raise ValueError(f"{text} is not a number in JSON")


def _integer(text: str) -> int:
    if len(text) > DIGITS:
        raise ValueError(f"has a number of {len(text)} digits")
    return int(text)


def _named(verb: str, path: str | Path) -> Path:
    """Return the file of a name, with links resolved; refuse invalid names."""
    if not isinstance(path, str | os.PathLike):
        _refuse(verb, repr(path), "a file is given by its name, such as 'out.csv'")
    if not str(path).strip():
        _refuse(verb, "", "the name of the file is empty; give one, such as out.csv")
    try:
        plain = Path(path).expanduser()
        target = plain.resolve()
    except FileNotFoundError:
        _refuse(verb, path, "the current directory no longer exists; change to another one")
    except RuntimeError:
        home = str(path).startswith("~")
        _refuse(verb, path, "there is no such user, or no home directory" if home else "its links form a loop")
    except ValueError:
        _refuse(verb, path, "the name contains the character of code 0")
    # If /dev/stdout is a pipe, it resolves to a name that does not exist.
    return plain if plain.exists() and not target.exists() else target


def _target(path: str | Path) -> Path:
    """Return the file to write, with links resolved; raise ExportError if it cannot be written."""
    target = _named("write", path)
    if not target.is_dir() and os.path.basename(path) in ("", ".", ".."):  # a Path forgets the slash at the end
        _refuse("write", path, "that is the name of a directory; append a file name")
    if target.is_dir():
        _refuse("write", path, "it is a directory; append a file name")
    if target.name == "-":
        _refuse("write", path, "only --json takes - for standard output; give the name of a file, or /dev/stdout")
    if not target.parent.is_dir():
        _refuse("write", path, f"there is no directory {target.parent}; create it first")
    if target.exists() and not os.access(target, os.W_OK):
        _refuse("write", path, "the file is write-protected")
    return target


def _is_device(target: Path) -> bool:
    # Replacing /dev/stdout or a pipe by a file would destroy it.
    return target.exists() and not target.is_file()


def _beside(target: Path) -> Path:
    return target.with_name(f".{uuid.uuid4().hex}.part")


@contextmanager
def _reasons(verb: str, path: str | Path) -> Iterator[None]:
    """Turn an OSError into the message why a file cannot be written or read."""
    try:
        yield
    except BrokenPipeError:
        raise  # the reader has closed the pipe; that is not an error of the file
    except OSError as error:
        _refuse(verb, path, str(error.strerror or error))


def _refuse(verb: str, path: object, why: str) -> NoReturn:
    kind: type[AcausalError] = ExportError if verb.startswith("write") else DeclarationError
    raise kind(f"cannot {verb}{' ' if str(path) else ''}{shown_name(path)}: {why}.") from None
