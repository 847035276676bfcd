"""The archive of an open DAE: members, checksums, and checks on reading."""

from __future__ import annotations

import hashlib
import json
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NoReturn

from acausal.errors import DeclarationError
from acausal.export.archive import write_archive
from acausal.result import document, shown_name

FORMAT, VERSION = "acausal open DAE", 4
FIRST = "dae.json"
ARRAYS = ("constants", "operations", "places")
MEMBERS = ("model.json", "model.mo", *ARRAYS)
MOST = 1 << 28  # limit of the bytes of all members: ten times those of models with a hundred thousand equations


def write(path: str | Path, first: Mapping[str, Any], members: Mapping[str, bytes]) -> None:
    """Write an archive atomically.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    first : mapping
        Content of dae.json, besides format, version and checksums.
    members : mapping of str to bytes
        The other members.
    """
    head = {
        "format": FORMAT,
        "version": VERSION,
        "sha256": {name: hashlib.sha256(content).hexdigest() for name, content in members.items()},
    }
    files = {FIRST: as_json({**head, "sha256_of_this": "", **first}), **members}
    files[FIRST] = as_json({**head, "sha256_of_this": _own(files[FIRST]), **first})
    write_archive(path, files)


def read(path: str | Path) -> tuple[dict[str, Any], dict[str, bytes]]:
    """Return the content of dae.json, and the other members.

    Raises
    ------
    DeclarationError
        If the file cannot be read, is not an open DAE, has another version, or is truncated or damaged.
    """
    try:
        with zipfile.ZipFile(Path(path).expanduser()) as archive:
            return _members(path, archive)
    except zipfile.BadZipFile:
        refuse(path, "it is not an open DAE, or it is truncated or damaged")
    except (zlib.error, EOFError, NotImplementedError, RuntimeError):
        refuse(path, "it is damaged")
    except (TypeError, ValueError):
        refuse(path, "its name is invalid")
    except OSError as error:
        refuse(path, str(error.strerror or error))


def refuse(path: str | Path, why: str) -> NoReturn:
    """Raise DeclarationError with the reason why a file is not read."""
    raise DeclarationError(f"cannot read {shown_name(path)}: {why}.") from None


def as_json(value: Any) -> bytes:
    """Return JSON in a canonical form: equal values give equal bytes."""
    return json.dumps(value, indent=None, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()


def _members(path: str | Path, archive: zipfile.ZipFile) -> tuple[dict[str, Any], dict[str, bytes]]:
    entries = archive.infolist()
    names = [entry.filename for entry in entries]
    if FIRST not in names:
        refuse(path, f"it is an archive, but not an open DAE: it has no {FIRST}")
    if sum(entry.file_size for entry in entries) > MOST:
        refuse(path, f"its content has more than {MOST >> 20} MB")
    text = archive.read(FIRST)
    try:
        first = document(text.decode())
    except ValueError as error:
        refuse(path, f"{FIRST} is damaged: {error}")
    if not isinstance(first, dict) or first.get("format") != FORMAT:
        refuse(path, f"it is an archive, but not an open DAE: {FIRST} does not name the format")
    if first.get("version") != VERSION:
        refuse(path, f"its format has version {first.get('version')!r}; this acausal reads version {VERSION}")
    if first.get("sha256_of_this") != _own(as_json({**first, "sha256_of_this": ""})):
        refuse(path, f"{FIRST} is damaged")
    if sorted(names) != sorted((FIRST, *MEMBERS)):
        refuse(path, f"it should hold {', '.join((FIRST, *MEMBERS))}, each once")
    content = {name: archive.read(name) for name in MEMBERS}
    for name in MEMBERS:
        if first["sha256"].get(name) != _own(content[name]):
            refuse(path, f"{name} is damaged")
    return first, content


def _own(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
