"""The model as a file: all that the core needs to integrate it, see docs/background/model-file.md."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from acausal.core.equations import Equations
from acausal.core.tape import Tape

VERSION = 1
_MAGIC = b"acausal\0"
_INT, _FLOAT = np.dtype("<i4"), np.dtype("<f8")


@dataclass(frozen=True, eq=False)
class StoredModel:
    """Equations, where they start, and what is known of the states.

    Attributes
    ----------
    equations : Equations
        What is integrated.
    time : float
        Time of the start in s.
    x, z, p, c : arrays
        States and algebraic unknowns at the start, consistent; parameters; constants of the segment.
    size : array, shape (nx,)
        Sizes of the states in the error test.
    rate : array, shape (nx,)
        Whether a state is the rate of another one.
    names : tuple of str
        Names of the states.
    """

    equations: Equations
    time: float
    x: np.ndarray
    z: np.ndarray
    p: np.ndarray
    c: np.ndarray
    size: np.ndarray
    rate: np.ndarray
    names: tuple[str, ...]

    @property
    def content(self) -> bytes:
        """The bytes of the file."""
        return framed(VERSION, self.sections)

    @property
    def sections(self) -> dict[str, bytes]:
        """Content of the sections by their tags."""
        e = self.equations
        given = (len(self.x), len(self.z), len(self.p), len(self.c), len(self.size), len(self.rate), len(self.names))
        if given != (e.nx, e.nz, e.np, e.nc, e.nx, e.nx, e.nx):
            raise ValueError("the start does not fit the equations")
        return {**equations_sections(e), **self.start}

    @property
    def start(self) -> dict[str, bytes]:
        """Those of them that hold the start and the states."""
        return {
            "start": b"".join(map(floats, ([self.time], self.x, self.z, self.p, self.c))),
            "sizes": floats(self.size),
            "rates": ints(self.rate),
            "names": b"".join(name.encode() + b"\0" for name in self.names),
        }


def equations_sections(e: Equations) -> dict[str, bytes]:
    """Return the content of the sections of equations by their tags."""
    return {
        "numbers": ints([e.nx, e.nz, e.np, e.nc]),
        "values": tape_bytes(e.values),
        "slopes": tape_bytes(e.slopes),
        **({"powers": tape_bytes(e.powers)} if e.powers else {}),
        **({"kinks": tape_bytes(e.kinks)} if e.kinks else {}),
        "pattern": ints(e.start) + ints(e.row) + ints(e.diagonal),
    }


def framed(version: int, sections: dict[str, bytes]) -> bytes:
    """Return sections by their tags, between header and checksum."""
    body = b"".join(
        struct.pack("<8sQ", tag.encode(), len(content)) + content + bytes(-len(content) % 8)
        for tag, content in sections.items()
    )
    head = _MAGIC + struct.pack("<IIQ", version, len(sections), 24 + len(body) + 8)
    return head + body + struct.pack("<II", zlib.crc32(head + body), 0)


def tape_bytes(tape: Tape) -> bytes:
    """Return a tape as a section holds it."""
    constants, *places = tape.arrays
    return ints(tape.counts) + floats(constants) + b"".join(map(ints, places))


def ints(values: ArrayLike) -> bytes:
    """Return integers as a section holds them."""
    return np.asarray(values).astype(_INT).tobytes()


def floats(values: ArrayLike) -> bytes:
    """Return numbers as a section holds them."""
    return np.asarray(values).astype(_FLOAT).tobytes()
