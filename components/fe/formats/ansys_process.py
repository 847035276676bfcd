"""Read Ansys files in a separate process with arguments FULL BESIDE OUT, and write the arrays to OUT, a .npz file.

The package that reads them crashes the process at truncated or damaged files. This module imports no other module of
the project.
"""

import sys
from typing import Any

import numpy as np

WORD = 4  # bytes, the unit of lengths in Ansys files
# VTK types of solid elements; results have the linear types for quadratic elements.
SOLIDS = (10, 12, 13, 24, 25, 26)


def read_complete(reader: Any, path: str) -> Any:
    """Read a binary file and check its length against its header."""
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
    equations, *found = read_complete(reader, path).load_km(sort=False)
    if any(matrix is None for matrix in found):
        raise EOFError("the mass or stiffness matrix is missing; the file of a modal analysis has both")
    content = {"equations": equations}
    for name, matrix in zip("KM", found, strict=True):
        entries = matrix.tocoo()
        content |= {f"{name} values": entries.data, f"{name} index": np.stack([entries.row, entries.col])}
    return content


def mesh(reader: Any, path: str) -> dict[str, np.ndarray]:
    """Return numbers, positions and axes of the nodes, and solid elements by their number of nodes."""
    archive = path.lower().endswith(".cdb")
    source = reader.Archive(path, verbose=False) if archive else read_complete(reader, path)
    found = source if archive else source.mesh
    content = {name: np.asarray(getattr(found, name)) for name in ("nnum", "nodes", "node_angles")}
    if source.grid is None:  # nodes alone
        return content
    names = np.asarray(source.grid.point_data["ansys_node_num"])
    cells = [names[members] for kind, members in source.grid.cells_dict.items() if kind in SOLIDS]
    return content | {f"cells {members.shape[1]}": members for members in cells}


def main(full: str, beside: str, out: str) -> int:
    """Write the arrays; on failure print the file to stdout and the reason to stderr."""
    from ansys.mapdl import reader  # pyright: ignore[reportMissingImports]

    content = {}
    for path, read in ((full, matrices), (beside, mesh)):
        print(path, flush=True)  # names the file if the process crashes
        try:
            content |= read(reader, path)
        except Exception as error:
            print(type(error).__name__, *str(error).splitlines()[:1], file=sys.stderr)
            return 1
    np.savez(out, **content)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
