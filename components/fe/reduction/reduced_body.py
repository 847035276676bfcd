"""A solid body reduced to modes: the data of its equations in a floating frame, independent of the mesh."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array, frozen
from components.fe.reduction import archive
from components.fe.reduction.inertia_invariants import axial
from components.fe.reduction.interface import Interface
from components.fe.reduction.nodal_field import NodalField

# Relative difference of mass and stiffness of equal bodies: far above the round-off of a reduction, far below a design
# change.
ALIKE = 1e-6
MAPS = ("place", "displacement", "rotation", "axes")  # arrays of an interface


@dataclass(frozen=True, eq=False, repr=False)
class ReducedBody:
    """A body with n modes phi_b: in its reference frame, the point at r0 moves to r0 + sum over b of phi_b(r0) q_b.

    All data are in SI, relative to the origin of the reference frame and resolved in it. Bodies are equal if all data
    of the equations are equal. Nodal data, which only nodal results need, are not compared, hashed or pickled.

    Parameters
    ----------
    mass : float
        Mass m in kg.
    first_moment : array, shape (3,)
        s0, integral of r0 dm in kg.m.
    second_moment : array, shape (3, 3)
        P0, integral of r0 r0' dm in kg.m2.
    modal_first : array, shape (3, n)
        S, integrals of phi_b dm.
    modal_second : array, shape (n, 3, 3)
        A_b, integrals of r0 phi_b' dm.
    modal_products : array, shape (n, n, 3, 3)
        B_bc, integrals of phi_b phi_c' dm.
    M, K, D : array, shape (n, n)
        Modal mass (the trace of B_bc), stiffness and damping.
    interfaces : tuple of Interface
        Frames at which the body can be connected.
    origin : array, shape (3,)
        Position of the reference frame in the coordinates of the original nodes, in m; the axes are the same.
    nodal : NodalField, optional
        Nodes and nodal modes; not pickled, so not sent to other processes.

    Raises
    ------
    DeclarationError
        If shapes are inconsistent, a number is not finite, or two interfaces have the same name.
    """

    mass: float
    first_moment: Array
    second_moment: Array
    modal_first: Array
    modal_second: Array
    modal_products: Array
    M: Array
    K: Array
    D: Array
    interfaces: tuple[Interface, ...] = ()
    origin: Array = field(default_factory=lambda: np.zeros(3))
    nodal: NodalField | None = None

    def __post_init__(self) -> None:
        if np.ndim(self.modal_first) != 2:
            raise DeclarationError(
                "modal_first of a reduced body must have three rows x, y, z and a column for each mode"
            )
        for name, shape in _shapes(self.n).items():
            object.__setattr__(self, name, frozen(getattr(self, name), shape, f"{name} of a reduced body"))
        object.__setattr__(self, "mass", float(self.mass))
        object.__setattr__(self, "interfaces", tuple(self.interfaces))
        names = [frame.name for frame in self.interfaces]
        if len(set(names)) < len(names):
            raise DeclarationError(f"interfaces of a reduced body must have different names: {', '.join(names)}")
        wrong = [frame.name for frame in self.interfaces if frame.displacement.shape[1] != self.n]
        if wrong or (self.nodal is not None and self.nodal.modes.shape[2] != self.n):
            raise DeclarationError(
                f"the number of modes of {', '.join(wrong) or 'nodal'} differs from that of the reduced body, {self.n}"
            )

    @property
    def n(self) -> int:
        """Number of modes."""
        return np.shape(self.modal_first)[1]

    @property
    def frequencies(self) -> Array:
        """Frequencies of the modes in Hz with the reference frame fixed, shape (n,), in ascending order."""
        squares = np.linalg.eigvals(np.linalg.solve(self.M, self.K)).real if self.n else np.zeros(0)
        return np.sqrt(np.sort(np.maximum(squares, 0.0))) / (2 * np.pi)

    @property
    def effective_mass(self) -> Array:
        """Effective modal mass, shape (n, 6): along x, y, z in kg, and about x, y, z of the reference frame in kg.m2.

        (S_b)^2 / M_bb and (H_b)^2 / M_bb, with H_b the integral of r0 x phi_b dm. Modes in a mean-axis frame have none.
        """
        return np.hstack([self.modal_first.T, axial(self.modal_second)]) ** 2 / np.diag(self.M)[:, None]

    @property
    def lost_mass(self) -> Array:
        """Residual mass: fraction of the mass and of the moments of inertia in no `effective_mass`, shape (6,).

        It consists of the effective mass of truncated modes and of the mass at the fixed nodes, which no mode moves.
        """
        P = self.second_moment
        whole = np.array([*[self.mass] * 3, *(np.trace(P) - np.diag(P))])
        return 1 - self.effective_mass.sum(axis=0) / np.where(whole > 0, whole, np.inf)

    @property
    def second_order(self) -> bool:
        """True if the symmetric parts of B_bc are known, as inertia of second order in q needs; some SIDs lack them."""
        return bool(np.trace(self.modal_products, axis1=2, axis2=3).any())

    def first(self, n: int) -> ReducedBody:
        """Return the body with the first n of its modes.

        Raises
        ------
        DeclarationError
            If n is not an integer from 0 to the number of modes.
        """
        if isinstance(n, bool) or not isinstance(n, int | np.integer) or not 0 <= n <= self.n:
            raise DeclarationError(f"modes of a reduced body must be an integer from 0 to {self.n}, not {n!r}")
        if n == self.n:
            return self
        return replace(
            self,
            modal_first=self.modal_first[:, :n],
            modal_second=self.modal_second[:n],
            modal_products=self.modal_products[:n, :n],
            **{name: getattr(self, name)[:n, :n] for name in "MKD"},
            interfaces=tuple(frame.first(n) for frame in self.interfaces),
            nodal=None if self.nodal is None else self.nodal.first(n),
        )

    @cached_property
    def digest(self) -> str:
        """Hash of all data of the equations."""
        total = hashlib.sha256()
        for name, array in self._arrays():
            total.update(f"{name} {array.shape} {array.dtype}".encode() + array.tobytes())
        return total.hexdigest()[:32]

    def _arrays(self) -> Iterator[tuple[str, Array]]:
        yield "mass", np.array(self.mass)
        yield from ((name, getattr(self, name)) for name in _shapes(self.n))
        for k, frame in enumerate(self.interfaces):
            yield f"name {k}", np.array(frame.name)
            yield f"turns {k}", np.array(frame.turns)
            yield f"averages {k}", np.array(frame.averages)
            yield from ((f"{name} {k}", getattr(frame, name)) for name in MAPS)

    def __eq__(self, other: object) -> bool:
        return self is other or (isinstance(other, ReducedBody) and self.digest == other.digest)

    def __hash__(self) -> int:
        return hash(self.digest)

    def __repr__(self) -> str:
        frames = ", ".join(frame.name for frame in self.interfaces) or "no frames"
        return f"ReducedBody({self.n} modes, {frames}, {self.digest[:12]})"

    def __getstate__(self) -> dict[str, Any]:
        return {entry.name: getattr(self, entry.name) for entry in fields(self)} | {"nodal": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(**state)

    def __copy__(self) -> ReducedBody:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> ReducedBody:
        return self

    def save(self, path: str | Path, *, nodal: bool = True) -> None:
        """Write the body to a .npz file, atomically.

        Parameters
        ----------
        path : str or Path
            File; an existing one is replaced once the new one is complete.
        nodal : bool
            Whether to include nodes and nodal modes, if the body has them.

        Raises
        ------
        ExportError
            If the file cannot be written.
        """
        content = dict(self._arrays())
        if nodal and self.nodal is not None:
            cells = {f"nodal cells {kind}": np.asarray(cells) for kind, cells in self.nodal.cells.items()}
            content |= {"nodal nodes": self.nodal.nodes, "nodal modes": self.nodal.modes, **cells}
        archive.write(Path(path), content)

    @classmethod
    def load(cls, path: str | Path) -> ReducedBody:
        """Read a body that `save` wrote.

        Raises
        ------
        DeclarationError
            If the file does not exist, is not a reduced-body file, or is damaged.
        """
        content = archive.read(Path(path))
        frames, k = [], 0
        while f"name {k}" in content:
            more: dict[str, Any] = {
                name: content[key] for name in (*MAPS, "turns", "averages") if (key := f"{name} {k}") in content
            }
            frames.append(Interface(name=str(content[f"name {k}"]), **more))
            k += 1
        nodal = None
        if "nodal nodes" in content:
            cells = {
                key.removeprefix("nodal cells "): v for key, v in content.items() if key.startswith("nodal cells ")
            }
            nodal = NodalField(content["nodal nodes"], content["nodal modes"], cells)
        arrays = {name: content[name] for name in _shapes(0)}
        return cls(mass=float(content["mass"]), interfaces=tuple(frames), nodal=nodal, **arrays)


def alike(one: ReducedBody, other: ReducedBody) -> bool:
    """Return whether two bodies are equal up to round-off, such as two reductions of the same matrices."""
    if one.n != other.n or [i.name for i in one.interfaces] != [i.name for i in other.interfaces]:
        return False
    return all(
        np.allclose(a, b, rtol=0, atol=ALIKE * np.abs(a).max(initial=0.0))
        for a, b in ((one.mass, other.mass), (one.second_moment, other.second_moment), (one.K, other.K))
    )


def _shapes(n: int) -> dict[str, tuple[int, ...]]:
    return {
        "first_moment": (3,),
        "second_moment": (3, 3),
        "modal_first": (3, n),
        "modal_second": (n, 3, 3),
        "modal_products": (n, n, 3, 3),
        "M": (n, n),
        "K": (n, n),
        "D": (n, n),
        "origin": (3,),
    }
