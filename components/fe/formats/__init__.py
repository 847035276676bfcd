"""Mass and stiffness matrices from files, one format a module."""

from components.fe.formats.npz import read_npz

__all__ = ["read_npz"]
