"""The archive of a Functional Mock-up Unit."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from acausal.core.build.compiling import SOURCE, file_of
from acausal.errors import ExportError
from acausal.export import fmi2, fmi3
from acausal.export.description import Description
from acausal.export.page import page
from acausal.export.platforms import chosen
from acausal.result import check_writable, shown_name
from acausal.result.files import whole

# A fixed time makes files of equal models equal; it is the earliest time of the zip format.
TIME = (1980, 1, 1, 0, 0, 0)
READABLE = 0o644 << 16
UNIX = 3
LICENSED = "The library and its sources; the model has its own author.\n\n"


def source_names() -> tuple[str, ...]:
    """Return the names of the C source files of the library."""
    return tuple(sorted(path.name for path in SOURCE.glob("*.c")))


def check_fmu(path: str | Path, fmi_version: int, platforms: Sequence[str]) -> dict[str, str]:
    """Check the arguments of an export before the model is compiled; return the platform of each folder.

    Raises
    ------
    ExportError
        If the name, the version or a platform is invalid.
    """
    check_writable(path)
    if not str(path).lower().endswith(".fmu"):
        raise ExportError(f"cannot write {shown_name(path)}: importers need a name that ends in .fmu; append it.")
    return chosen(fmi_version, platforms)


def write_fmu(
    path: str | Path, description: Description, model: bytes, fmi_version: int = 3, platforms: Sequence[str] = ("own",)
) -> None:
    """Write an exported model atomically.

    Parameters
    ----------
    path : str or Path
        Name of the file, which ends in .fmu.
    description : Description
        The interface of the model.
    model : bytes
        The model file for the library.
    fmi_version : int
        2 or 3.
    platforms : sequence of str
        Platforms of the included libraries: names, "own" or "all".

    Raises
    ------
    ExportError
        If the file cannot be written, or the description violates FMI.
    """
    libraries = check_fmu(path, fmi_version, platforms)
    files = _contents(description, model, fmi_version, libraries)
    write_archive(path, dict(sorted(files.items())))


def write_archive(path: str | Path, files: Mapping[str, bytes]) -> None:
    """Write an archive of files by their names atomically; equal files give equal archives."""
    with whole(path, "wb") as file, zipfile.ZipFile(file, "w") as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, TIME)
            entry.compress_type, entry.external_attr, entry.create_system = zipfile.ZIP_DEFLATED, READABLE, UNIX
            archive.writestr(entry, content)


def _contents(description: Description, model: bytes, fmi_version: int, libraries: dict[str, str]) -> dict[str, bytes]:
    """Return the files of the archive by name."""
    files = {
        "modelDescription.xml": (fmi2 if fmi_version == 2 else fmi3).describe(description),
        "resources/model.bin": model,
        "documentation/index.html": page(description, fmi_version, list(libraries)),
        "documentation/licenses/license.txt": LICENSED.encode() + (SOURCE / "LICENSE").read_bytes(),
    }
    for folder, name in libraries.items():
        library = file_of(name)
        files[f"binaries/{folder}/{description.identifier}{library.suffix}"] = library.read_bytes()
    if description.sources:
        names = (*description.sources, *(path.name for path in SOURCE.glob("*.h")))
        files |= {f"sources/{name}": (SOURCE / name).read_bytes() for name in names}
        if fmi_version == 3:
            files["sources/buildDescription.xml"] = fmi3.describe_sources(description)
    return files
