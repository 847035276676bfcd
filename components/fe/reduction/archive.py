"""Named arrays in a .npz file that is written whole or not at all."""

from __future__ import annotations

import zipfile
import zlib
from pathlib import Path

import numpy as np

from acausal import DeclarationError
from acausal.result.files import whole

FORMAT = "acausal reduced body 1"
# What reading a file raises that is no archive, or damaged, or asks for what zipfile cannot do.
WRONG = (OSError, EOFError, ValueError, TypeError, AttributeError, NotImplementedError, zipfile.BadZipFile, zlib.error)


def write(path: Path, content: dict[str, np.ndarray]) -> None:
    """Write a file that takes the place of an old one when it is complete; ExportError where it cannot be written."""
    with whole(path, "wb") as file:
        np.savez_compressed(file, format=np.array(FORMAT), entries=np.array(len(content)), **content)  # pyright: ignore


def read(path: Path) -> dict[str, np.ndarray]:
    """The arrays of a file that `write` made."""
    try:
        with np.load(path, allow_pickle=False) as file:
            if "format" not in file or str(file["format"]) != FORMAT:
                raise DeclarationError(f"{path} is no file of a reduced body: `reduce_body(...).save(path)` writes one")
            content = {name: file[name] for name in file.files if name not in ("format", "entries")}
            if len(content) != int(file["entries"]):
                raise DeclarationError(f"{path} is not whole: {len(content)} of {int(file['entries'])} entries")
            return content
    except FileNotFoundError:
        raise DeclarationError(f"there is no file {path} of a reduced body") from None
    except WRONG as error:
        raise DeclarationError(f"{path} is no file of a reduced body, or not whole{said(error)}") from None


def said(error: Exception) -> str:
    """Write what numpy said of a file, but not that it might be loaded by running what it holds."""
    return "" if "pickle" in str(error) else f": {error}"
