"""The document that a page plays: one or several runs as JSON; its fields are told in page/DOCUMENT.md."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any
from urllib.parse import urlencode

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.collect import PartShape
from acausal.animation.columns import Columns, encode
from acausal.animation.rotations import quaternions, rotation_angles
from acausal.animation.scene import ALL, Run, Scene, chord_fractions, scene_of, shapes_of
from acausal.errors import DeclarationError, caution

VERSION = 1
# Between two frames a body turns on the shortest way: beyond this the picture may differ from the motion, and at a half
# turn it does. rad
TURN = 0.5
# Of the extent: less is nothing in a picture, nor in the numbers of 24 bits that it is kept in.
NOTHING = 1e-9


def document(
    runs: Mapping[str, Run], values: Sequence[str] = (), title: str = "", deformation: float = 1.0
) -> dict[str, Any]:
    """Return what a page needs to show runs.

    Parameters
    ----------
    runs : mapping of str to Run
        By their names, which are shown where there are several.
    values : sequence of str
        Values along curves to be evaluated although they cost time, by name; "all" are all.
    title : str
        Of the page; those of the runs if it is not given.
    deformation : float
        Scale of deformations with which the page begins.

    Returns
    -------
    dict
        For JSON.

    Raises
    ------
    DeclarationError
        If a run has nothing to be seen, no such values, or an entry of a shape that is none.
    """
    return document_of(scenes(runs, values), values, title, deformation)


def scenes(runs: Mapping[str, Run], values: Sequence[str] = ()) -> dict[str, Scene]:
    """Return runs in numbers, with the sizes that suit the largest."""
    seen = shapes_of([run.tree for run in runs.values()], values)
    found = {name: scene_of(run, own) for (name, run), own in zip(runs.items(), seen, strict=True)}
    size = max(scene.size for scene in found.values())
    return {name: scene.with_default_sizes(size) for name, scene in found.items()}


def document_of(
    found: Mapping[str, Scene], values: Sequence[str] = (), title: str = "", deformation: float = 1.0
) -> dict[str, Any]:
    """Return the document of some scenes, which begins with the first of the values that were asked for."""
    titles = dict.fromkeys(scene.run.title for scene in found.values() if scene.run.title)
    start = {"colour": values[0]} if values and values[0] != ALL else {}
    return {
        "version": VERSION,
        "title": title or ", ".join(titles),
        "start": urlencode(start | ({"x": f"{deformation:g}"} if deformation != 1 else {})),
        "runs": [_Writer(name, scene).document() for name, scene in found.items()],
    }


class _Writer:
    """Writes one run."""

    def __init__(self, name: str, scene: Scene) -> None:
        self.name, self.scene = name, scene
        self.columns = Columns(len(scene.run.time))
        self.poses: list[dict[str, Any]] = []
        self._known: dict[str, int] = {}
        self._by_id: dict[int, int] = {}
        self.fastest: tuple[float, str] = (0.0, "")

    def document(self) -> dict[str, Any]:
        """Return the run."""
        scene, run = self.scene, self.scene.run
        parts: dict[tuple[str, str], int] = {}
        shapes = []
        for one in scene.shapes:
            part = parts.setdefault((one.path, one.kind), len(parts))
            kind = type(one.shape)
            shapes.append({"kind": kind.__name__.lower(), "part": part, "color": None} | WRITE[kind](self, one))
        if self.fastest[0] > TURN:
            caution(
                f"{self.fastest[1] or 'the model'} turns by up to {self.fastest[0]:.2g} rad from one frame to the next, and the "
                "picture takes the shortest way between them: show more frames, or simulate with more intervals."
            )
        return self.columns.resolve(
            {
                "name": self.name,
                "stopped": run.stopped,
                "time": encode(np.asarray(run.time, dtype="<f8")),
                "poses": self.poses,
                "parts": [{"path": path, "type": kind} for path, kind in parts],
                "shapes": shapes,
                "plots": [{"name": p.name, "unit": p.unit, "column": self.plotted(p.values)} for p in scene.plots],
                "extent": {"low": scene.low.tolist(), "high": scene.high.tolist()},
                "size": scene.size,
                "up": scene.up.tolist(),
            }
        )

    def pose(self, pose: g.Pose, of: PartShape) -> int:
        """Return the place of a pose; equal ones are one."""
        if id(pose) not in self._by_id:
            try:
                q = quaternions(pose.T)
            except ValueError:
                raise DeclarationError(
                    f"T of a Pose of {of.path or 'the model'} ({of.kind}) is no rotation matrix."
                ) from None
            if len(q) > 1:
                between = rotation_angles(q)[np.diff(self.scene.run.time) > 0]
                self.fastest = max(self.fastest, (float(np.max(between, initial=0)), of.path))
            q[np.abs(q) < NOTHING] = 0
            found = {"r": self.places(pose.r), "q": self.columns.add(q)}
            if str(found) not in self._known:
                self._known[str(found)] = len(self.poses)
                self.poses.append(found)
            self._by_id[id(pose)] = self._known[str(found)]
        return self._by_id[id(pose)]

    def places(self, lengths: np.ndarray) -> Any:
        """Return the columns of lengths in m, shape (times, ...)."""
        return self.columns.add(np.where(np.abs(lengths) < NOTHING * self.scene.size, 0, lengths), self.scene.size)

    def plotted(self, values: np.ndarray) -> Any:
        """Return the column of an output, whose range is what is seen of it."""
        finite = values[np.isfinite(values)]
        return self.columns.add(values, float(np.ptp(finite)) if finite.size else 0.0)

    def ground(self, one: PartShape) -> dict[str, Any]:
        """It is the same in all scenes."""
        return {}

    def box(self, one: PartShape) -> dict[str, Any]:
        """Numbers in a pose."""
        s = one.shape
        return self._rigid(one, center=s.center, axes=s.axes, size=s.size)

    def cylinder(self, one: PartShape) -> dict[str, Any]:
        """Its ends have other names, as `end` says nothing of where it is."""
        s = one.shape
        return self._rigid(one, diameter=s.diameter) | {"from": _plain(s.start), "to": _plain(s.end)}

    def sphere(self, one: PartShape) -> dict[str, Any]:
        """Numbers in a pose."""
        return self._rigid(one, center=one.shape.center, diameter=one.shape.diameter)

    def axle(self, one: PartShape) -> dict[str, Any]:
        """Its axis has length 1."""
        s = one.shape
        axis = s.axis / np.linalg.norm(s.axis)
        return self._rigid(one, center=np.zeros(3), axis=axis, length=s.length, diameter=s.diameter)

    def span(self, one: PartShape) -> dict[str, Any]:
        """Between columns."""
        s = one.shape
        return {"a": self.places(s.start), "b": self.places(s.end), "style": s.style, "diameter": float(s.diameter)}

    def arrow(self, one: PartShape) -> dict[str, Any]:
        """Its length is not that of the vector: the page chooses a scale."""
        s = one.shape
        unit = "N" if s.quantity == "force" else "N.m"
        return {"at": self.places(s.at), "vector": self.columns.add(s.vector), "quantity": s.quantity, "unit": unit}

    def curve(self, one: PartShape) -> dict[str, Any]:
        """What it is deformed from is a chord, or points in a pose."""
        s = one.shape
        rest: dict[str, Any] = {"chord": True, "fractions": chord_fractions(s)}
        if s.rest is not None:
            if s.rest_points is None or s.rest_points.shape != s.points.shape[1:]:
                raise DeclarationError(
                    f"the Curve of {one.path or 'the model'} ({one.kind}) needs `rest_points`, one for each point."
                )
            rest = {"pose": self.pose(s.rest, one), "points": _plain(s.rest_points)}
        return {
            "points": self.places(s.points),
            "tangents": self.places(s.tangents),
            "section": _plain(s.section),
            "up": None if s.up is None else self.columns.add(s.up),
            "rest": rest,
            "values": [{"name": v.name, "unit": v.unit, "columns": self.columns.add(v.entries)} for v in s.values],
        }

    def mesh(self, one: PartShape) -> dict[str, Any]:
        """Its numbers are in a pose."""
        s = one.shape
        return self._rigid(one) | {
            "vertices": encode(np.asarray(s.vertices, dtype="<f4")),
            "triangles": encode(np.asarray(s.triangles, dtype="<u4")),
            "modes": encode(np.asarray(s.modes, dtype="<f4")) if s.q is not None else None,
            "q": self.columns.add(s.q) if s.q is not None else [],
        }

    def _rigid(self, one: PartShape, **fields: Any) -> dict[str, Any]:
        return {"pose": self.pose(one.shape.pose, one)} | {name: _plain(value) for name, value in fields.items()}


WRITE: dict[type, Callable[[_Writer, PartShape], dict[str, Any]]] = {
    g.Ground: _Writer.ground,
    g.Box: _Writer.box,
    g.Cylinder: _Writer.cylinder,
    g.Sphere: _Writer.sphere,
    g.Axle: _Writer.axle,
    g.Span: _Writer.span,
    g.Arrow: _Writer.arrow,
    g.Curve: _Writer.curve,
    g.Mesh: _Writer.mesh,
}


def _plain(numbers: Any) -> Any:
    return np.asarray(numbers, dtype=float).tolist()
