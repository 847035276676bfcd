"""Nodal results after a run: motion, stresses and ParaView files, from the modal coordinates q of a result."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from acausal import DeclarationError, Result
from acausal.result import check_writable, shown_name
from acausal.result.files import whole
from components.fe.elements.material import Material
from components.fe.elements.stress import COMPONENTS, operator, to_nodes
from components.fe.reduction.nodal_field import NodalField
from components.fe.reduction.reduced_body import ReducedBody, alike

AXES = ("world", "body")


class NodalResult:
    """Motion and stresses at the nodes of an FEBody during a run.

    Parameters
    ----------
    result : Result
        Of a run.
    body : str
        Path of the FEBody in the model, such as "rod".
    reduced : ReducedBody, str or Path
        The body of the model, with nodes, or the file to which it was saved.

    Attributes
    ----------
    time : array, shape (times,)
        In s.

    Raises
    ------
    DeclarationError
        If the result has no such FEBody, or the reduced body is another one or has no nodes.

    Examples
    --------
    >>> nodes = NodalResult(result, "rod", "rod.npz")
    >>> nodes.velocity([53])[:, 0, 2]  # along z of the world
    >>> nodes.stress(E=2.1e11, nu=0.3, at="nodes")[-1].max(axis=0)
    >>> nodes.write_vtu("rod.vtu", E=2.1e11, nu=0.3)  # rod.pvd for ParaView
    """

    def __init__(self, result: Result, body: str, reduced: ReducedBody | str | Path) -> None:
        found = reduced if isinstance(reduced, ReducedBody) else ReducedBody.load(reduced)
        if found.nodal is None:
            raise DeclarationError(
                "this reduced body has no nodes; save(path, nodal=True) keeps them, pickling does not"
            )
        if f"{body}.q" not in result:
            raise DeclarationError(f"the result has no FEBody `{shown_name(body)}`: {shown_name(body)}.q is missing")
        self.time = result.time
        n = result[f"{body}.q"].reshape(self.time.size, -1).shape[1]
        frames = [f"{body}.{name}" for name in ("ref", *(i.name for i in _held(found.first(min(n, found.n)))))]
        frame = next((name for name in frames if f"{name}.r_0" in result), None)
        if n > found.n or frame is None:
            raise DeclarationError(
                f"`{shown_name(body)}` differs from the reduced body: it has {n} modes, the reduced body {found.n}"
            )
        if _is_another(found.first(n), result.tree, body):
            raise DeclarationError(f"`{shown_name(body)}` differs from the reduced body in mass, frames or stiffness")
        self._q, self._qd, self._qdd = (
            result[f"{body}.{name}"].reshape(self.time.size, n) for name in ("q", "qd", "qdd")
        )
        # Stresses scale with the parameter `stiffness` of the FEBody.
        stiffness = f"{body}.stiffness"
        self._stiff_q = self._q * (result[stiffness][:, None] if stiffness in result else 1.0)
        self._r_0, self._v, self._a, self._z = (result[f"{frame}.{name}"] for name in ("r_0", "v", "a", "z"))
        self._T, self._w = result[f"{frame}.R.T"], result[f"{frame}.R.w"]
        self._nodal: NodalField = found.nodal.first(n)

    @cached_property
    def cells(self) -> dict[str, np.ndarray]:
        """Elements by meshio's names of their types, as rows of the nodes."""
        return {kind: np.asarray(cells) for kind, cells in self._nodal.cells.items()}

    def displacement(self, nodes: Sequence[int] | None = None, axes: str = "body") -> np.ndarray:
        """Return displacements relative to the undeformed body in the reference frame.

        Parameters
        ----------
        nodes : sequence of int, optional
            Rows of nodes, counted from 0; all if not given.
        axes : "body" or "world"
            Axes in which the displacements are resolved.

        Returns
        -------
        array, shape (times, nodes, 3)
            In m.
        """
        return self._resolved(self._moved(self._q, nodes), axes)

    def position(self, nodes: Sequence[int] | None = None, axes: str = "world") -> np.ndarray:
        """Return positions in m relative to the origin of the world or of the reference frame; see `displacement`."""
        place = self._places(nodes)
        if axes == "body":
            return place
        return self._r_0[:, None] + self._resolved(place, axes)

    def velocity(self, nodes: Sequence[int] | None = None, axes: str = "world") -> np.ndarray:
        """Return absolute velocities v + w x r + u' in m/s; see `displacement`."""
        w, rate = self._w[:, None], self._moved(self._qd, nodes)
        return self._resolved(self._v[:, None] + np.cross(w, self._places(nodes)) + rate, axes)

    def acceleration(self, nodes: Sequence[int] | None = None, axes: str = "world") -> np.ndarray:
        """Return absolute accelerations a + z x r + w x (w x r) + 2 w x u' + u'' in m/s2; see `displacement`."""
        w, r = self._w[:, None], self._places(nodes)
        rate, second = self._moved(self._qd, nodes), self._moved(self._qdd, nodes)
        spin = np.cross(self._z[:, None], r) + np.cross(w, np.cross(w, r))
        return self._resolved(self._a[:, None] + spin + 2 * np.cross(w, rate) + second, axes)

    def stress(self, *, E: float, nu: float, at: str = "points") -> Any:
        """Return stresses of the elements in the axes of the body; near loaded frames they need a Craig-Bampton basis.

        Parameters
        ----------
        E, nu : float
            Young's modulus in Pa and Poisson's ratio of the matrices; the factor `stiffness` of the FEBody is applied.
        at : "points", "elements" or "nodes"
            At the Barlow points of each element, where they are most accurate; the element means; or at the nodes,
            extrapolated linearly from the points and averaged over adjacent elements.

        Returns
        -------
        dict from str to array, shape (times, elements, points, 6) or (times, elements, 6), or array, shape (times,
        nodes, 6)
            In Pa: xx, yy, zz, xy, yz, zx.

        Raises
        ------
        DeclarationError
            If the body has no elements, as when reduced from matrices only, or stresses of an element type are not
            implemented.
        """
        if at not in ("points", "elements", "nodes"):
            raise DeclarationError(f'at must be "points", "elements" or "nodes", not {at!r}')
        modal = self._modal_stress(E, nu)
        if at == "points":
            return {kind: np.einsum("epsb,tb->teps", m, self._stiff_q, optimize=True) for kind, m in modal.items()}
        if at == "elements":
            means = {kind: m.mean(axis=1) for kind, m in modal.items()}
            return {kind: np.einsum("esb,tb->tes", m, self._stiff_q, optimize=True) for kind, m in means.items()}
        return np.einsum("ksb,tb->tks", self._at_nodes(modal), self._stiff_q, optimize=True)

    def write_vtu(
        self,
        path: str | Path,
        *,
        every: int = 1,
        scale: float = 1.0,
        E: float | None = None,
        nu: float | None = None,
    ) -> list[Path]:
        """Write the motion for ParaView: a file NAME-0000.vtu, ... for each time, and NAME.pvd with the times.

        Points are the node positions in the world. Point data are the displacement relative to the reference frame and
        the velocity, resolved in the world, and with E and nu the stress, resolved in the body, and the von Mises
        stress.

        Parameters
        ----------
        path : str or Path
            NAME.vtu.
        every : int
            Write every k-th time only.
        scale : float
            Magnification of the displacements.
        E, nu : float, optional
            Young's modulus in Pa and Poisson's ratio, for stresses.

        Returns
        -------
        list of Path
            The files, NAME.pvd first.

        Raises
        ------
        DeclarationError
            If meshio is not installed (`pip install 'acausal[fe]'`), or stresses are not available.
        ExportError
            If a file cannot be written.
        """
        if every < 1 or (E is None) != (nu is None):
            raise DeclarationError("write_vtu needs a positive integer every=, and both or neither of E and nu")
        target = Path(path).with_suffix(".pvd")
        check_writable(target)
        steps = range(0, self.time.size, every)
        files = [target.with_name(f"{target.stem}-{k:04d}.vtu") for k in range(len(steps))]
        stresses = None if E is None or nu is None else self._at_nodes(self._modal_stress(E, nu))
        for file, step in zip(files, steps, strict=True):
            _write(file, self._picture(step, scale, stresses))
        entries = "".join(
            f'    <DataSet timestep="{self.time[step]:.17g}" file="{file.name}"/>\n'
            for file, step in zip(files, steps, strict=True)
        )
        with whole(target) as out:
            out.write(
                f'<VTKFile type="Collection" version="0.1">\n  <Collection>\n{entries}  </Collection>\n</VTKFile>\n'
            )
        return [target, *files]

    def _picture(self, step: int, scale: float, stresses: np.ndarray | None) -> tuple[Any, ...]:
        """Return points, elements and point data at one time."""
        T, field = self._T[step], self._nodal
        u, rate = field.modes @ self._q[step], field.modes @ self._qd[step]
        velocity = self._v[step] + np.cross(self._w[step], field.nodes + u) + rate
        data = {"displacement": u @ T, "velocity": velocity @ T}
        if stresses is not None:
            data["stress"] = stresses @ self._stiff_q[step]
            data["von Mises"] = von_mises(data["stress"])
        return self._r_0[step] + (field.nodes + scale * u) @ T, self.cells, data

    def _moved(self, q: np.ndarray, nodes: Sequence[int] | None) -> np.ndarray:
        return np.einsum("kib,tb->tki", self._nodal.modes[self._rows(nodes)], q, optimize=True)

    def _places(self, nodes: Sequence[int] | None) -> np.ndarray:
        return self._nodal.nodes[self._rows(nodes)] + self._moved(self._q, nodes)

    def _rows(self, nodes: Sequence[int] | None) -> Any:
        if nodes is None:
            return slice(None)
        rows, count = np.atleast_1d(np.asarray(nodes)), len(self._nodal.nodes)
        if not np.issubdtype(rows.dtype, np.integer) or ((rows < 0) | (rows >= count)).any():
            raise DeclarationError(f"nodes must be rows from 0 to {count - 1}, not {nodes!r}")
        return rows

    def _resolved(self, vectors: np.ndarray, axes: str) -> np.ndarray:
        if axes not in AXES:
            raise DeclarationError(f'axes must be "world" or "body", not {axes!r}')
        return vectors if axes == "body" else np.einsum("tij,tki->tkj", self._T, vectors)

    def _modal_stress(self, E: float, nu: float) -> dict[str, np.ndarray]:
        """Return the modal stresses at the points of the elements, shape (elements, points, 6, modes)."""
        field = self._nodal
        if not self.cells:
            raise DeclarationError(
                "this body has no elements, as it was reduced from matrices only; stresses need a mesh, a box or an input deck"
            )
        found = {}
        for kind, cells in self.cells.items():
            stresses = operator(kind, np.asarray(field.nodes), cells, Material(E, nu, 1.0))
            found[kind] = np.einsum("epsic,eicb->epsb", stresses, field.modes[cells], optimize=True)
        return found

    def _at_nodes(self, modal: dict[str, np.ndarray]) -> np.ndarray:
        """Return the modal stresses at the nodes, shape (nodes, 6, modes)."""
        count, (*_, n) = len(self._nodal.nodes), self._nodal.modes.shape
        total, times = np.zeros((count, len(COMPONENTS), n)), np.zeros(count)
        for kind, stresses in modal.items():
            np.add.at(total, self.cells[kind], np.einsum("kp,epsb->eksb", to_nodes(kind), stresses))
            np.add.at(times, self.cells[kind], 1.0)
        return total / np.maximum(times, 1.0)[:, None, None]


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Return the von Mises stress in Pa of stresses xx, yy, zz, xy, yz, zx, shape (..., 6)."""
    x, y, z, *shear = np.moveaxis(stress, -1, 0)
    return np.sqrt(((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) / 2 + 3 * sum(s**2 for s in shear))


def _held(reduced: ReducedBody) -> list[Any]:
    return [i for i in reduced.interfaces if i.still and not i.turned]


def _is_another(reduced: ReducedBody, tree: Any, path: str) -> bool:
    """Return whether the model has another body at the path; False if the result came from another process."""
    part = tree
    for name in re.findall(r"\w+", path):
        part = part[int(name)] if isinstance(part, list) else getattr(part, name, None)
    own = getattr(part, "reduced", None)
    return isinstance(own, ReducedBody) and not alike(own.first(reduced.n), reduced)


def _write(path: Path, picture: tuple[Any, ...]) -> None:
    """Write a .vtu file atomically."""
    try:
        import meshio
    except ImportError:
        raise DeclarationError(
            "writing .vtu files needs meshio. Do this: python -m pip install 'acausal[fe]'."
        ) from None
    points, cells, data = picture
    cells = cells or {"vertex": np.arange(len(points))[:, None]}
    with TemporaryDirectory() as folder, whole(path, "wb") as out:
        made = Path(folder, "picture.vtu")
        meshio.Mesh(points, list(cells.items()), point_data=data).write(made)
        out.write(made.read_bytes())
