"""Selection of the reader of a file by its name and its neighbours."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from acausal import DeclarationError
from acausal.result import shown_name
from components.fe.formats.abaqus import is_abaqus, read_abaqus
from components.fe.formats.ansys import read_ansys
from components.fe.formats.calculix import SUFFIXES, read_calculix
from components.fe.formats.matrix_market import is_matrix_market, read_matrix_market
from components.fe.formats.nastran import read_nastran
from components.fe.formats.npz import read_npz

Reader = Callable[..., tuple[Any, Any, Any]]
BY_SUFFIX: dict[str, Reader] = {
    ".npz": read_npz,
    ".full": read_ansys,
    ".rst": read_ansys,
    ".op4": read_nastran,
    ".sti": read_calculix,
    ".mas": read_calculix,
    ".dof": read_calculix,
}
SID = (".sid", ".sid_fem")
KINDS = (
    "matrices (.npz, Matrix Market .mtx, CalculiX .sti, Abaqus .mtx, Ansys .full, Nastran .op4), a SID (.sid) or a mesh"
)


def reader_of(path: str | Path) -> Reader | None:
    """Return the reader of the matrices in a file or in its folder; None for files without matrices.

    Parameters
    ----------
    path : str or Path
        A file; for Matrix Market also the common part of the names of three files, or their folder.

    Raises
    ------
    DeclarationError
        If there is no such file.
    """
    file = Path(path).expanduser()
    kind = file.suffix.lower()
    if kind in BY_SUFFIX:
        return BY_SUFFIX[kind]
    if kind == ".inp" and is_abaqus(file):
        return read_abaqus
    if kind == ".inp" and file.with_suffix(SUFFIXES[1]).is_file():
        return read_calculix
    if kind == ".cdb" and file.with_suffix(".full").is_file():
        return read_ansys
    if kind == ".mtx" and is_abaqus(file) and not is_matrix_market(file):
        return read_abaqus
    if kind in (".mtx", ".gz") or file.is_dir():
        return read_matrix_market
    if not file.is_file():
        if list(file.parent.glob(f"{file.name}*M.mtx*")):
            return read_matrix_market
        raise DeclarationError(f"there is no file {shown_name(path)}; reduce accepts {KINDS}.")
    return None
