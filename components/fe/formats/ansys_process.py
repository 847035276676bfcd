"""Reads files of Ansys in a process of its own: FULL BESIDE OUT.

The package that reads them ends the process at files that are cut off or damaged. This file imports nothing of ours, and
writes arrays to OUT, a .npz file.
"""

import sys
from typing import Any

import numpy as np

WORD = 4  # bytes, in which files of Ansys count
# Numbers of solid elements in VTK; of a result, those without nodes on edges are given for those with them.
SOLIDS = (10, 12, 13, 24, 25, 26)


def whole(reader: Any, path: str) -> Any:
    """Return what the package makes of a binary file, if that is as long as its heading says."""
    found = reader.read_binary(path)
    heading = {**getattr(found, "_header", {}), **getattr(found, "_resultheader", {})}
    words = next((int(np.ravel(heading[name])[0]) for name in ("ptrEND", "ptrend") if name in heading), 0)
    with open(path, "rb") as file:
        size = file.seek(0, 2)
    if size < WORD * words:
        raise EOFError(f"it has {size} of {WORD * words} bytes")
    return found


def matrices(reader: Any, path: str) -> dict[str, np.ndarray]:
    """Return the equations (node, freedom) and the entries of K and M, one triangle of each."""
    equations, *found = whole(reader, path).load_km(sort=False)
    if any(matrix is None for matrix in found):
        raise EOFError("there is no mass or no stiffness matrix in it; the file of a modal analysis has both")
    content = {"equations": equations}
    for name, matrix in zip("KM", found, strict=True):
        entries = matrix.tocoo()
        content |= {f"{name} values": entries.data, f"{name} index": np.stack([entries.row, entries.col])}
    return content


def mesh(reader: Any, path: str) -> dict[str, np.ndarray]:
    """Return numbers, places and axes of the nodes, and solid elements by the number of their nodes."""
    archive = path.lower().endswith(".cdb")
    source = reader.Archive(path, verbose=False) if archive else whole(reader, path)
    found = source if archive else source.mesh
    content = {name: np.asarray(getattr(found, name)) for name in ("nnum", "nodes", "node_angles")}
    if source.grid is None:  # nodes alone
        return content
    names = np.asarray(source.grid.point_data["ansys_node_num"])
    cells = [names[members] for kind, members in source.grid.cells_dict.items() if kind in SOLIDS]
    return content | {f"cells {members.shape[1]}": members for members in cells}


def main(full: str, beside: str, out: str) -> int:
    """Write the arrays, or print what is wrong: the file, a tab, and why."""
    from ansys.mapdl import reader  # pyright: ignore[reportMissingImports]

    content = {}
    for path, read in ((full, matrices), (beside, mesh)):
        print(path, flush=True)  # should the process end here, this is the file
        try:
            content |= read(reader, path)
        except Exception as error:
            print(type(error).__name__, *str(error).splitlines()[:1], file=sys.stderr)
            return 1
    np.savez(out, **content)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
