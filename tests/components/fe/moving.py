"""Bodies and scenes of tests."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from components.fe import ReducedBody, box, reduce_body

SIZE, RUBBER = (0.5, 0.06, 0.04), {"E": 5e6, "nu": 0.3, "rho": 1100.0}


def ends(nodes: np.ndarray, first: str = "frame_a", last: str = "frame_b") -> dict[str, Any]:
    """Frames on the first and the last section of a body along x."""
    x = nodes[:, 0]
    return {first: np.flatnonzero(x == x.min()), last: np.flatnonzero(x == x.max())}


@cache
def rod(hold: str = "frame_a", modes: int = 6, element: str = "hex8", basis: str = "held") -> ReducedBody:
    """A rubber rod of few bricks."""
    M, K, nodes = box(SIZE, (4, 1, 1), element, **RUBBER)
    return reduce_body(M, K, nodes, frames=ends(nodes), hold=hold, modes=modes, basis=basis)


@cache
def masses() -> tuple[np.ndarray, np.ndarray]:
    """Mass of each pair of nodes of the rod, and places of the nodes."""
    M, _, nodes = box(SIZE, (4, 1, 1), "hex8", **RUBBER)
    return M.toarray()[::3, ::3], nodes


def momenta(reduced: ReducedBody, result: Any, path: str = "body", frame: str = "frame_a") -> tuple[np.ndarray, ...]:
    """Momentum and angular momentum about the origin of the world, from the motion of all nodes, shape (times, 3) each."""
    m, _ = masses()
    field, at = reduced.nodal, f"{path}.{frame}"
    T, w, v, r = (result[f"{at}.{name}"] for name in ("R.T", "R.w", "v", "r_0"))
    local = field.nodes + np.einsum("iab,tb->tia", field.modes, result[f"{path}.q"])
    rates = v[:, None] + np.cross(w[:, None], local) + np.einsum("iab,tb->tia", field.modes, result[f"{path}.qd"])
    places, rates = (np.einsum("tab,tia->tib", T, x) for x in (local, rates))
    places = places + r[:, None]
    carried = np.einsum("ij,tja->tia", m, rates)
    return carried.sum(axis=1), np.cross(places, carried).sum(axis=1)
