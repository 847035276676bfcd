"""Documents for the page, made by hand: one that holds every kind of shape, with the places where they must be drawn."""

from __future__ import annotations

import base64
import zlib
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from acausal.animation.document import looks
from acausal.animation.looks import LOOKS

Array = NDArray[np.float64]


def packed(values: ArrayLike, kind: str = "<f4") -> str:
    """Return numbers as the document has them."""
    return base64.b64encode(zlib.compress(np.ascontiguousarray(values, dtype=kind).tobytes())).decode()


class Columns:
    """Columns of a run, named by one integer each: those that vary first, then the constants."""

    def __init__(self, time: Array) -> None:
        self.time = time
        self.varying: list[Array] = []
        self.constants: list[float] = []
        self.mixed: list[tuple[bool, int]] = []

    def add(self, values: ArrayLike) -> list[int]:
        """Return placeholders of columns of (times,) or (times, n) or, where they are constant, (n,)."""
        array = np.asarray(values, dtype=float)
        if array.ndim == 2 or len(array) == len(self.time):
            columns = array.reshape(len(self.time), -1).T
            self.varying.extend(columns)
            return list(range(len(self.varying) - len(columns), len(self.varying)))
        self.constants.extend(array)
        # Their numbers are known when all that vary are: until then they are negative.
        return [-(k + 1) for k in range(len(self.constants) - len(array), len(self.constants))]

    def number(self, thing: Any) -> Any:
        """Return a structure of placeholders with the numbers of the columns."""
        if isinstance(thing, dict):
            return {key: self.number(value) for key, value in thing.items()}
        if isinstance(thing, list):
            return [self.number(value) for value in thing]
        return len(self.varying) - 1 - thing if type(thing) is int and thing < 0 else thing

    def document(self) -> dict[str, Any]:
        """Return the part of a run that holds the numbers."""
        values = np.concatenate([*self.varying, self.constants])
        return {
            "frames": len(self.time),
            "varying": len(self.varying),
            "constant": len(self.constants),
            "data": packed(values),
            "time": packed(self.time, "<f8"),
        }


def turns(axis: ArrayLike, angle: Array) -> Rotation:
    """Return turns about an axis: v_world = T v."""
    n = np.asarray(axis, float) / np.linalg.norm(axis)
    return Rotation.from_rotvec(np.outer(angle, n))


def rotations(axis: ArrayLike, angle: Array) -> Array:
    """Return turns as matrices (times, 3, 3)."""
    return turns(axis, angle).as_matrix()


def quaternions(axis: ArrayLike, angle: Array) -> Array:
    """Return turns as (times, 4): (w, x, y, z), continuous in sign."""
    q = turns(axis, angle).as_quat()[:, [3, 0, 1, 2]]
    signs = np.cumprod(np.sign(np.sum(q[1:] * q[:-1], axis=1)))
    return q * np.concatenate([[1], signs])[:, None]


def every_kind(scale: float = 1.0, away: ArrayLike = (0, 0, 0), frames: int = 101) -> tuple[dict, list[Array]]:
    """Return a run with every kind of shape, and for each the places (times, points, 3) where it is drawn.

    Parameters
    ----------
    scale : float
        Size of the scene (m).
    away : (3,)
        Where the scene is in the world (m).
    frames : int
        Number of output times, from 0 to 2 s.
    """
    time = np.linspace(0, 2, frames)
    columns = Columns(time)
    parts, shapes, drawn = [], [], []
    away = np.asarray(away, float)

    def show(shape: dict, path: str, places: ArrayLike, kind: str = "Part") -> None:
        shapes.append({"part": len(parts), "color": None, **shape})
        parts.append({"path": path, "type": kind})
        drawn.append(np.asarray(places, float).reshape(len(time), -1, 3))

    # Body 0 turns about a slanted axis and wanders, body 1 is a crank that is a fourth of a turn ahead, body 2 stays.
    axis, angle = (1, 2, 3), 2.5 * time
    r = away + scale * np.column_stack([0.3 * np.cos(time), 0.5 + 0.2 * np.sin(2 * time), 0.1 * time])
    T = rotations(axis, angle)
    poses = [{"r": columns.add(r), "q": columns.add(quaternions(axis, angle))}]
    r1 = away + scale * np.column_stack([np.cos(3 * time), np.sin(3 * time), 0 * time])
    T1 = rotations((0, 0, 1), 3 * time + np.pi / 2)
    poses.append({"r": columns.add(r1), "q": columns.add(quaternions((0, 0, 1), 3 * time + np.pi / 2))})
    poses.append({"r": columns.add(away), "q": columns.add([1.0, 0, 0, 0])})

    def places(r: Array, T: Array, points: ArrayLike) -> Array:
        return r[:, None] + np.einsum("tij,pj->tpi", T, np.asarray(points, float))

    show({"kind": "ground"}, "world", np.zeros((len(time), 0, 3)), "World")
    center, size = scale * np.array([0.1, -0.05, 0.02]), scale * np.array([0.5, 0.12, 0.2])
    axes = rotations((0, 1, 1), np.array([0.4]))[0].T
    half = axes[0] * size[0] / 2
    box = {"kind": "box", "pose": 0, "center": center.tolist(), "axes": axes.tolist(), "size": size.tolist()}
    show(box, "machine.box", places(r, T, [center, center - half, center + half]), "BodyBox")
    a, b = scale * np.array([0.0, 0, 0]), scale * np.array([0.1, 0.3, -0.2])
    shape = {
        "kind": "cylinder",
        "pose": 1,
        "from": a.tolist(),
        "to": b.tolist(),
        "diameter": 0.08 * scale,
        "style": "plain",
    }
    show(shape, "machine.cylinder", places(r1, T1, [(a + b) / 2, a, b]), "BodyCylinder")
    center = scale * np.array([0.2, 0.1, 0.3])
    shape = {"kind": "sphere", "pose": 0, "center": center.tolist(), "diameter": 0.15 * scale, "color": "#27ae80"}
    show(shape, "machine.sphere", places(r, T, [center]), "Body")
    pin = np.array([0.1, 0, 0]) * scale
    shape = {
        "kind": "axle",
        "pose": 1,
        "center": [0, 0, 0],
        "axis": [1, 0, 0],
        "length": 0.2 * scale,
        "diameter": 0.1 * scale,
        "style": "hinge",
    }
    show(shape, "machine.pin", places(r1, T1, [0 * pin, -pin, pin]), "Revolute")
    for style in ("coil", "rod", "rail"):
        fixed = away + scale * np.array([-1.0, 0.2, {"coil": 0, "rod": -0.2, "rail": 0.2}[style]])
        shape = {"kind": "span", "a": columns.add(fixed), "b": poses[0]["r"], "style": style, "diameter": 0.1 * scale}
        show(shape, f"machine.{style}", np.stack([np.broadcast_to(fixed, r.shape), r], 1), "Spring")
    for quantity, unit, factor in (("force", "N", 40.0), ("torque", "N.m", 7.0)):
        vector = factor * np.column_stack([np.cos(time), np.sin(5 * time), 0.3 + 0 * time])
        shape = {
            "kind": "arrow",
            "at": poses[0]["r"],
            "vector": columns.add(vector),
            "quantity": quantity,
            "unit": unit,
        }
        longest = np.linalg.norm(vector, axis=1).max()
        show(shape, f"machine.{quantity}", np.stack([r, r + 0.25 * EXTENT * scale * vector / longest], 1), "WorldForce")
    s = np.linspace(0, 1, 4)
    for path, chord in (("rod", True), ("crank", False)):
        bend = 0.15 * scale * np.sin(4 * time)
        local = np.stack([np.broadcast_to(scale * s, (len(time), 4)), bend[:, None] * s**2 * (1.5 - s)], 2)
        slope = np.stack([np.full((len(time), 4), scale / 3), bend[:, None] * (3 * s - 3 * s**2) / 3], 2)
        local, slope = (np.concatenate([x, np.zeros((len(time), 4, 1))], 2) for x in (local, slope))
        nodes, tangents = r1[:, None] + np.einsum("tij,tpj->tpi", T1, local), np.einsum("tij,tpj->tpi", T1, slope)
        moment = 12 * np.cos(4 * time)[:, None] * (1 - s)
        pose = {"pose": 1, "points": [[scale * x, 0, 0] for x in s]}
        shape = {
            "kind": "curve",
            "points": [columns.add(nodes[:, k]) for k in range(4)],
            "tangents": [columns.add(tangents[:, k]) for k in range(4)],
            "section": [[0.02 * scale, 0.04 * scale]],
            "up": [columns.add(T1[:, :, 1])],
            "profile": "ellipse",
            "rest": {"chord": True, "fractions": s.tolist()} if chord else pose,
            "values": [{"name": "bending moment", "unit": "N.m", "columns": columns.add(moment)}],
        }
        show(shape, f"machine.{path}", nodes, "FlexibleBeam")
    show(*skin(columns, scale, time, r, T, axis))
    show({"kind": "trail", "at": poses[0]["r"]}, "machine.trail", r)
    plots = [
        {"name": f"out <{k}>", "unit": unit, "column": columns.add(values)[0]} for k, unit, values in outputs(time)
    ]
    reach = np.concatenate([d.reshape(-1, 3) for d in drawn])
    middle = (reach.min(0) + reach.max(0)) / 2
    half = EXTENT * scale / 2 / np.sqrt(3)
    run = {"name": "machine", "stopped": None, **columns.document(), "poses": poses, "parts": parts, "shapes": shapes}
    run |= {"plots": plots, "extent": {"low": (middle - half).tolist(), "high": (middle + half).tolist()}}
    run |= {"size": 0.03 * scale, "up": [0, 1, 0]}
    return columns.number(run), drawn


EXTENT = 4.0  # diagonal of the scene of unit size (m)


def outputs(time: Array) -> list[tuple[str, str, Array]]:
    """Return some outputs: name, unit, values."""
    return [("x", "m", np.sin(3 * time)), ("y & z", "m", 0.5 * np.cos(7 * time)), ("speed", "m/s", np.exp(-time))]


def skin(columns: Columns, scale: float, time: Array, r: Array, T: Array, axis: Any) -> tuple[dict, str, Array, str]:
    """Return a cuboid of 8 vertices with two modes, carried by body 0."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 0.3) for z in (0, 0.2)]) * scale
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    modes = np.stack([corners * [0, 1, 0] * (corners[:, :1] > 0), corners[:, [1, 0, 2]] * [0, 0.5, 0]])
    q = np.column_stack([0.2 * np.sin(6 * time), 0.1 * np.cos(9 * time)])
    local = corners + np.einsum("tm,mvj->tvj", q, modes)
    shape = {
        "kind": "mesh",
        "pose": 0,
        "vertices": packed(corners),
        "triangles": packed(triangles, "<u4"),
        "modes": packed(modes),
        "q": columns.add(q),
    }
    return shape, "machine.plate", r[:, None] + np.einsum("tij,tpj->tpi", T, local), "FEBody"


def document(*runs: dict, title: str = "every kind") -> dict[str, Any]:
    """Return a document of runs."""
    return {"version": 1, "title": title, "looks": looks(LOOKS), "runs": list(runs)}
