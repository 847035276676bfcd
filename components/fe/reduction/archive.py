"""The .npz file of a reduced body, written atomically."""

from __future__ import annotations

import zipfile
import zlib
from pathlib import Path

import numpy as np

from acausal import DeclarationError
from acausal.result.files import whole

FORMAT = "acausal reduced body 1"
# Exceptions of np.load for files that are damaged, are not archives, or use unsupported zip features.
UNREADABLE = (
    OSError,
    EOFError,
    ValueError,
    TypeError,
    AttributeError,
    NotImplementedError,
    zipfile.BadZipFile,
    zlib.error,
)


def write(path: Path, content: dict[str, np.ndarray]) -> None:
    """Write the arrays; an existing file is replaced once the new one is complete. ExportError on failure."""
    with whole(path, "wb") as file:
        np.savez_compressed(file, format=np.array(FORMAT), entries=np.array(len(content)), **content)  # pyright: ignore


def read(path: Path) -> dict[str, np.ndarray]:
    """Read the arrays of a file that `write` made."""
    try:
        with np.load(path, allow_pickle=False) as file:
            if "format" not in file or str(file["format"]) != FORMAT:
                raise DeclarationError(
                    f"{path} is not a reduced-body file; create one with reduce_body(...).save(path)"
                )
            content = {name: file[name] for name in file.files if name not in ("format", "entries")}
            if len(content) != int(file["entries"]):
                raise DeclarationError(f"{path} is incomplete: it has {len(content)} of {int(file['entries'])} entries")
            return content
    except FileNotFoundError:
        raise DeclarationError(f"there is no reduced-body file {path}") from None
    except UNREADABLE as error:
        raise DeclarationError(f"{path} is not a reduced-body file, or is damaged{reason(error)}") from None


def reason(error: Exception) -> str:
    """Return the message of np.load, unless it proposes to unpickle the file, which would run its code."""
    return "" if "pickle" in str(error) else f": {error}"
