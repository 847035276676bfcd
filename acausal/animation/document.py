"""Write the document that a page plays: one or several runs as JSON, specified in page/DOCUMENT.md."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any
from urllib.parse import urlencode

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.collect import PartShape
from acausal.animation.columns import Columns, encode
from acausal.animation.looks import LOOKS
from acausal.animation.rotations import quaternions, rotation_angles
from acausal.animation.scene import ALL, Run, Scene, chord_fractions, scene_of, shapes_of
from acausal.errors import DeclarationError, caution

VERSION = 1
# The page interpolates rotations along the shortest path, which is wrong from half a turn between two frames on. Larger
# rotations than this cause a warning, rad.
LARGEST_TURN = 0.5
# Lengths below this fraction of the size of the scene are written as 0, and entries of quaternions and directions below it: they
# are invisible and below the round-off of float32.
NEGLIGIBLE = 1e-9


def document(
    runs: Mapping[str, Run], values: Sequence[str] = (), title: str = "", deformation: float = 1.0
) -> dict[str, Any]:
    """Return the document of runs.

    Parameters
    ----------
    runs : mapping of str to Run
        Runs by name; the names are shown if there are several.
    values : sequence of str
        Names of the values along curves to evaluate although they are expensive; "all" for all.
    title : str
        Title of the page; by default the titles of the runs.
    deformation : float
        Initial scale of deformations.

    Returns
    -------
    dict
        Document, ready for JSON.

    Raises
    ------
    DeclarationError
        If a run has nothing to draw, no values of a requested name, or an invalid shape.
    """
    return document_of(scenes(runs, values), values, title, deformation)


def scenes(
    runs: Mapping[str, Run], values: Sequence[str] = (), shapes: Sequence[list[PartShape]] | None = None
) -> dict[str, Scene]:
    """Return the evaluated runs, with the default sizes of the largest one, and without values that are 0 everywhere.

    Requested values are kept. `shapes` are those of `shapes_of`, if they are known.
    """
    seen = shapes_of([run.tree for run in runs.values()], values) if shapes is None else shapes
    found = {name: scene_of(run, [*own, *run.trails]) for (name, run), own in zip(runs.items(), seen, strict=True)}
    size = max(scene.size for scene in found.values())
    names = {v.name for scene in found.values() for v in scene.values() if np.any(v.entries)}.union(values)
    return {name: scene.with_default_sizes(size).with_values(names) for name, scene in found.items()}


def document_of(
    evaluated: Mapping[str, Scene],
    values: Sequence[str] = (),
    title: str = "",
    deformation: float = 1.0,
    view: str | None = None,
) -> dict[str, Any]:
    """Return the document of scenes, coloured at first by the first of the requested values, and seen in a view of VIEWS."""
    titles = dict.fromkeys(scene.run.title for scene in evaluated.values() if scene.run.title)
    start = ({"colour": values[0]} if values and values[0] != ALL else {}) | ({"view": view} if view else {})
    return {
        "version": VERSION,
        "title": title or ", ".join(titles),
        "looks": looks(
            one.shape.style for scene in evaluated.values() for one in scene.shapes if hasattr(one.shape, "style")
        ),
        "start": urlencode(start | ({"x": f"{deformation:g}"} if deformation != 1 else {})),
        "runs": [_Writer(name, scene).document() for name, scene in evaluated.items()],
    }


def looks(styles: Iterable[str]) -> dict[str, Any]:
    """Return the layers of styles by name, without those of coils, which are not straight."""
    styles = sorted(set(styles) - {"coil"})
    return {
        style: [
            {
                "rows": np.round(layer.rows, 4).tolist(),
                "color": layer.colour,
                "sides": layer.sides,
                "notch": layer.notch,
            }
            for layer in LOOKS[style]
        ]
        for style in styles
    }


class _Writer:
    """Writer of one run."""

    def __init__(self, name: str, scene: Scene) -> None:
        self.name, self.scene = name, scene
        self.columns = Columns(len(scene.run.time))
        self.poses: list[dict[str, Any]] = []
        self._known: dict[str, int] = {}
        self._by_id: dict[int, int] = {}
        self.fastest: tuple[float, str] = (0.0, "")

    def document(self) -> dict[str, Any]:
        """Return the document of the run."""
        scene, run = self.scene, self.scene.run
        parts: dict[tuple[str, str], int] = {}
        shapes = []
        for one in scene.shapes:
            part = parts.setdefault((one.path, one.kind), len(parts))
            kind = type(one.shape)
            known = {"kind": kind.__name__.lower(), "part": part, "color": one.colour}
            shapes.append(known | WRITE[kind](self, one))
        if self.fastest[0] > LARGEST_TURN:
            caution(
                f"{self.fastest[1] or 'the model'} turns by up to {self.fastest[0]:.2g} rad from one frame to the next; the "
                "animation interpolates along the shortest rotation. Do this: show more frames, or simulate with more intervals."
            )
        return self.columns.resolve(
            {
                "name": self.name,
                "stopped": run.stopped,
                "time": encode(np.asarray(run.time, dtype="<f8")),
                "poses": self.poses,
                "parts": [{"path": path, "type": kind} for path, kind in parts],
                "shapes": shapes,
                "plots": [{"name": p.name, "unit": p.unit, "column": self.output(p.values)} for p in scene.plots],
                "extent": {"low": scene.low.tolist(), "high": scene.high.tolist()},
                "size": scene.size,
                "up": scene.up.tolist(),
            }
        )

    def pose(self, pose: g.Pose, owner: PartShape) -> int:
        """Return the index of a pose; equal poses share one."""
        if id(pose) not in self._by_id:
            try:
                q = quaternions(pose.T)
            except ValueError:
                raise DeclarationError(
                    f"T of a Pose of {owner.path or 'the model'} ({owner.kind}) is not a rotation matrix."
                ) from None
            if len(q) > 1:
                between = rotation_angles(q)[np.diff(self.scene.run.time) > 0]
                self.fastest = max(self.fastest, (float(np.max(between, initial=0)), owner.path))
            found = {"r": self.positions(pose.r), "q": self.columns.add(_rounded(q))}
            if str(found) not in self._known:
                self._known[str(found)] = len(self.poses)
                self.poses.append(found)
            self._by_id[id(pose)] = self._known[str(found)]
        return self._by_id[id(pose)]

    def positions(self, lengths: np.ndarray) -> Any:
        """Return the columns of positions in m, shape (times, ...)."""
        return self.columns.add(_rounded(lengths, self.scene.size), self.scene.size)

    def output(self, values: np.ndarray) -> Any:
        """Return the column of an output; round-off counts relative to its range, which a plot shows."""
        finite = values[np.isfinite(values)]
        return self.columns.add(values, float(np.ptp(finite)) if finite.size else 0.0)

    def ground(self, one: PartShape) -> dict[str, Any]:
        """Return no fields: the page lays out the grid."""
        return {}

    def box(self, one: PartShape) -> dict[str, Any]:
        """Return the fields of a box."""
        s = one.shape
        return self._rigid(one, center=s.center, axes=s.axes, size=s.size)

    def cylinder(self, one: PartShape) -> dict[str, Any]:
        """Return the fields of a cylinder, with its ends as `from` and `to`."""
        s = one.shape
        return self._rigid(one, diameter=s.diameter) | {
            "from": _plain(s.start),
            "to": _plain(s.end),
            "style": s.style,
        }

    def sphere(self, one: PartShape) -> dict[str, Any]:
        """Return the fields of a sphere."""
        return self._rigid(one, center=one.shape.center, diameter=one.shape.diameter)

    def axle(self, one: PartShape) -> dict[str, Any]:
        """Return the fields of an axle, with its axis normalised."""
        s = one.shape
        axis = s.axis / np.linalg.norm(s.axis)
        found = self._rigid(one, center=np.zeros(3), axis=axis, length=s.length, diameter=s.diameter)
        return found | {"style": s.style}

    def span(self, one: PartShape) -> dict[str, Any]:
        """Return the fields of a span."""
        s = one.shape
        return {
            "a": self.positions(s.start),
            "b": self.positions(s.end),
            "style": s.style,
            "diameter": float(s.diameter),
        }

    def trail(self, one: PartShape) -> dict[str, Any]:
        """Return the fields of a trail."""
        return {"at": self.positions(one.shape.at)}

    def arrow(self, one: PartShape) -> dict[str, Any]:
        """Return the fields of an arrow; the page scales its length."""
        s = one.shape
        unit = "N" if s.quantity == "force" else "N.m"
        return {"at": self.positions(s.at), "vector": self.columns.add(s.vector), "quantity": s.quantity, "unit": unit}

    def curve(self, one: PartShape) -> dict[str, Any]:
        """Return the fields of a curve, with its undeformed shape on the chord or in a pose."""
        s = one.shape
        rest: dict[str, Any] = {"chord": True, "fractions": chord_fractions(s)}
        if s.rest is not None:
            if s.rest_points is None or s.rest_points.shape != s.points.shape[1:]:
                raise DeclarationError(
                    f"the Curve of {one.path or 'the model'} ({one.kind}) needs one entry of `rest_points` for each point."
                )
            rest = {"pose": self.pose(s.rest, one), "points": _plain(s.rest_points)}
        return {
            "points": self.positions(s.points),
            "tangents": self.positions(s.tangents),
            "section": _plain(s.section),
            "up": None if s.up is None else self.columns.add(_rounded(s.up)),
            "profile": s.profile,
            "rest": rest,
            "values": [{"name": v.name, "unit": v.unit, "columns": self.columns.add(v.entries)} for v in s.values],
        }

    def mesh(self, one: PartShape) -> dict[str, Any]:
        """Return the fields of a mesh."""
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
    g.Trail: _Writer.trail,
    g.Arrow: _Writer.arrow,
    g.Curve: _Writer.curve,
    g.Mesh: _Writer.mesh,
}


def _rounded(numbers: np.ndarray, size: float = 1.0) -> np.ndarray:
    """Return numbers with 0 for those that are negligible beside a size."""
    return np.where(np.abs(numbers) < NEGLIGIBLE * size, 0, numbers)


def _plain(numbers: Any) -> Any:
    return np.asarray(numbers, dtype=float).tolist()
