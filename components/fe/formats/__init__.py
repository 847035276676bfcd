"""Readers of mass and stiffness matrices, meshes and SIDs, one module for each format."""

from components.fe.formats.npz import read_npz

__all__ = ["read_npz"]
