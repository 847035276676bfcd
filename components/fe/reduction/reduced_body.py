"""A solid body reduced to modes: what the equations of a body in a floating frame need, and nothing of its mesh."""

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

# Part of mass or stiffness: far above the rounding of a reduction, far below a change of a design.
ALIKE = 1e-6
MAPS = ("place", "displacement", "rotation", "axes")  # arrays of an interface


@dataclass(frozen=True, eq=False, repr=False)
class ReducedBody:
    """A body with n modes phi_b: in its reference frame, a point that was at r0 is at r0 + sum over b of phi_b(r0) q_b.

    All in SI, relative to the origin of the reference frame and resolved in it. Bodies are equal if everything is that
    the equations use; data at nodes, which only results at nodes need, are compared, pickled and hashed by nobody.

    Parameters
    ----------
    mass : float
        m in kg.
    first_moment : array, shape (3,)
        s0, the integral of r0 dm in kg.m.
    second_moment : array, shape (3, 3)
        P0, the integral of r0 r0' dm in kg.m2.
    modal_first : array, shape (3, n)
        S, the integrals of phi_b dm.
    modal_second : array, shape (n, 3, 3)
        A_b, the integrals of r0 phi_b' dm.
    modal_products : array, shape (n, n, 3, 3)
        B_bc, the integrals of phi_b phi_c' dm.
    M, K, D : array, shape (n, n)
        Modal mass, the trace of B_bc, stiffness and damping.
    interfaces : tuple of Interface
        Frames where the body is connected.
    origin : array, shape (3,)
        Place of the reference frame in the coordinates in which the nodes were given, in m; the axes are the same.
    nodal : NodalField, optional
        Nodes and modes at nodes; left behind when the body is sent to another process.

    Raises
    ------
    DeclarationError
        If a shape does not fit the others, a number is not finite, or two interfaces have one name.
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
                "modal_first of a reduced body has one row for x, y and z, and one column for each mode"
            )
        for name, shape in _shapes(self.n).items():
            object.__setattr__(self, name, frozen(getattr(self, name), shape, f"{name} of a reduced body"))
        object.__setattr__(self, "mass", float(self.mass))
        object.__setattr__(self, "interfaces", tuple(self.interfaces))
        names = [frame.name for frame in self.interfaces]
        if len(set(names)) < len(names):
            raise DeclarationError(f"two interfaces of a reduced body have one name: {', '.join(names)}")
        wrong = [frame.name for frame in self.interfaces if frame.displacement.shape[1] != self.n]
        if wrong or (self.nodal is not None and self.nodal.modes.shape[2] != self.n):
            raise DeclarationError(
                f"{', '.join(wrong) or 'nodal'} of a reduced body of {self.n} modes has another number"
            )

    @property
    def n(self) -> int:
        """Number of modes."""
        return np.shape(self.modal_first)[1]

    @property
    def frequencies(self) -> Array:
        """Frequencies of the modes in Hz while the reference frame is held, shape (n,), lowest first."""
        squares = np.linalg.eigvals(np.linalg.solve(self.M, self.K)).real if self.n else np.zeros(0)
        return np.sqrt(np.sort(np.maximum(squares, 0.0))) / (2 * np.pi)

    @property
    def effective_mass(self) -> Array:
        """Mass that each mode moves along when the reference frame is accelerated, shape (n, 6).

        Along x, y, z in kg and about x, y, z of the reference frame in kg.m2: (S_b)^2 / M_bb and (H_b)^2 / M_bb with
        H_b the integral of r0 x phi_b dm. Modes in a mean-axis frame have none.
        """
        return np.hstack([self.modal_first.T, axial(self.modal_second)]) ** 2 / np.diag(self.M)[:, None]

    @property
    def lost_mass(self) -> Array:
        """Part of the mass and of the moments of inertia that is in no `effective_mass`, from 0 to 1, shape (6,).

        It does not follow an acceleration of the reference frame by deformation: what modes left out would carry, and
        what is part of the held nodes themselves, which no mode moves.
        """
        P = self.second_moment
        whole = np.array([*[self.mass] * 3, *(np.trace(P) - np.diag(P))])
        return 1 - self.effective_mass.sum(axis=0) / np.where(whole > 0, whole, np.inf)

    @property
    def second_order(self) -> bool:
        """True if the symmetric parts of B_bc are known, from which inertia of second order in q follows; some SID lack them."""
        return bool(np.trace(self.modal_products, axis1=2, axis2=3).any())

    def first(self, n: int) -> ReducedBody:
        """The body with the first n of its modes.

        Raises
        ------
        DeclarationError
            If n is negative, no whole number, or more than there are.
        """
        if isinstance(n, bool) or not isinstance(n, int | np.integer) or not 0 <= n <= self.n:
            raise DeclarationError(f"a reduced body of {self.n} modes cannot give the first {n!r}: take 0 to {self.n}")
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
        """Hash of all that the equations use."""
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
        """Write the body to a .npz file, whole or not at all.

        Parameters
        ----------
        path : str or Path
            File; one that exists is replaced when the new one is complete.
        nodal : bool
            Whether nodes and modes at nodes go along, where there are any.

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
            If there is no such file, or it is none of a reduced body, or not whole.
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
    """Whether two bodies are one up to rounding, as one that was reduced twice, with more modes the second time."""
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
