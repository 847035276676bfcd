"""What a run looks like, in numbers: shapes over time, their extent, and the sizes that suit them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.collect import PartShape, call_user_code, collect
from acausal.animation.deformation_reference import with_references
from acausal.animation.evaluation import Evaluate, evaluate_shapes
from acausal.animation.missing_frames import fill_missing_frames
from acausal.animation.validation import check_shape
from acausal.errors import DeclarationError
from acausal.language.component import Component

# Sizes that suit a scene, as fractions of its median extent: thin beside its parts, and still to be seen.
DIAMETER = {g.Cylinder: 0.02, g.Sphere: 0.03, g.Axle: 0.025}
AXLE = 0.06
SPAN = {"rod": 0.008, "rail": 0.012, "coil": 0.04}
TUBE = 0.006
# What is a point beside its path, as a body alone without sizes, is as large as this part of the path suits.
POINT, ALONE = 1e-6, 0.5
ALL = "all"


@dataclass(frozen=True)
class Plot:
    """A scalar under the picture: name, unit as declared, and its expression (1, 1) or values of shape (times,)."""

    name: str
    unit: str
    values: Any


@dataclass(frozen=True)
class Run:
    """What is shown of a run.

    Parameters
    ----------
    tree : Component
        The bound model.
    time : array, shape (times,)
        Of the frames, in s, not decreasing; equal times are the two sides of a jump.
    evaluate : callable
        From a column of n expressions in the model's symbols to an array of shape (times, n).
    plots : sequence of Plot
        With expressions.
    title : str
        Name of what moves.
    stopped : str, optional
        Why the run ended early.
    """

    tree: Component
    time: np.ndarray
    evaluate: Evaluate
    plots: Sequence[Plot] = ()
    title: str = ""
    stopped: str | None = None


@dataclass(frozen=True)
class Scene:
    """A run in numbers.

    Parameters
    ----------
    run : Run
        Where they come from.
    seen : list of PartShape
        Shapes with arrays in place of expressions.
    plots : list of Plot
        With values.
    low, high : array, shape (3,)
        Corners of the box that holds everything at all times, in m, along the axes of the world.
    size : float
        Median over time of the diagonal of the box that holds everything at a time, in m; where this is a point, a part of
        its path.
    up : array, shape (3,)
        Unit vector, resolved in the world.
    """

    run: Run
    shapes: list[PartShape]
    plots: list[Plot]
    low: np.ndarray
    high: np.ndarray
    size: float
    up: np.ndarray

    def with_default_sizes(self, size: float) -> Scene:
        """Return the scene with the sizes that were open, as suits an extent in m."""
        return replace(
            self, size=size, shapes=[replace(one, shape=_with_default_sizes(one.shape, size)) for one in self.shapes]
        )


def shapes_of(trees: Sequence[Component], values: Sequence[str] = ()) -> list[list[PartShape]]:
    """Return the shapes of models, with those of the values along curves that were asked for or cost nothing.

    Parameters
    ----------
    trees : sequence of Component
        Bound models.
    values : sequence of str
        Names of values; "all" are all.

    Raises
    ------
    DeclarationError
        If there is nothing to be seen of a model, or no model has values of such a name.
    """
    found = [collect(tree) for tree in trees]
    for tree, seen in zip(trees, found, strict=True):
        if all(isinstance(one.shape, g.Ground | g.Arrow) for one in seen):
            raise DeclarationError(
                f"there is nothing to be seen in {type(tree).__name__}: none of its parts has a shape. Yield some from shapes(), "
                "for instance `yield geometry.Sphere(geometry.Pose(self.frame.r_0, self.frame.R.T))`."
            )
    known = {v.name for seen in found for one in seen if isinstance(one.shape, g.Curve) for v in one.shape.values}
    missing = [name for name in values if name not in known | {ALL}]
    if missing:
        there = ", ".join(f'"{name}"' for name in sorted(known)) or "none"
        raise DeclarationError(
            f'there are no values "{missing[0]}" along the curves that are shown; there are: {there}.'
        )
    return [
        [
            replace(one, shape=call_user_code(partial(_with_values, one.shape, values), one.path, one.kind))
            for one in seen
        ]
        for seen in found
    ]


def _with_values(shape: Any, names: Sequence[str]) -> Any:
    if not isinstance(shape, g.Curve):
        return shape
    kept = [v for v in shape.values if not callable(v.entries) or v.name in names or ALL in names]
    return replace(
        shape, values=tuple(replace(v, entries=v.entries() if callable(v.entries) else v.entries) for v in kept)
    )


def scene_of(run: Run, seen: Sequence[PartShape]) -> Scene:
    """Evaluate a run and measure it.

    Parameters
    ----------
    run : Run
        With one time or more.
    seen : sequence of PartShape
        What `shapes_of` returned for its tree.
    """
    found, scalars = evaluate_shapes(seen, [plot.values for plot in run.plots], run.evaluate, run.time)
    for one in found:
        check_shape(one)
    found = with_references(fill_missing_frames(found, run.time))
    boxes = [box for box in (_box(one.shape) for one in found) if box is not None]
    low = np.min([box[0] for box in boxes], axis=0)
    high = np.max([box[1] for box in boxes], axis=0)
    size = float(np.median(np.linalg.norm(high - low, axis=1)))
    path = float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))
    if size <= POINT * path:
        size = ALONE * path or 1.0
    ups = [one.shape.up for one in found if isinstance(one.shape, g.Ground) and one.shape.up is not None]
    up = np.asarray(ups[0] if ups else (0, 1, 0), dtype=float)
    plots = [replace(plot, values=values) for plot, values in zip(run.plots, scalars, strict=True)]
    return Scene(run, found, plots, low.min(axis=0), high.max(axis=0), size, up / np.linalg.norm(up))


def _box(shape: Any) -> tuple[np.ndarray, np.ndarray] | None:
    """Return the corners, shape (times, 3) each, of what a shape fills."""
    points = bounding_points(shape)
    if points is None:
        return None
    diameter = getattr(shape, "diameter", None)
    margin = 0.0 if diameter is None else float(diameter) / 2
    return points.min(axis=1) - margin, points.max(axis=1) + margin


def bounding_points(shape: Any) -> np.ndarray | None:
    """Return points that hold a shape between them, shape (times, points, 3), in the world; None of what fills no room."""
    if isinstance(shape, g.Curve):
        return shape.points
    if isinstance(shape, g.Span):
        return np.stack([shape.start, shape.end], axis=1)
    if isinstance(shape, g.Arrow):
        return shape.at[:, None]
    local = _LOCAL.get(type(shape))
    return None if local is None else in_world(shape.pose, local(shape))


def in_world(pose: g.Pose, points: np.ndarray) -> np.ndarray:
    """Return points of a pose, (points, 3), in the world: shape (times, points, 3)."""
    return pose.r[:, None] + np.asarray(points, dtype=float) @ pose.T


def corners(low: Any, high: Any) -> np.ndarray:
    """Return the corners of a box, shape (8, 3)."""
    return np.array(np.meshgrid(*zip(low, high, strict=True), indexing="ij")).reshape(3, 8).T


def _of_box(box: g.Box) -> np.ndarray:
    half = np.asarray(box.size) / 2
    return box.center + corners(-half, half) @ box.axes


_LOCAL: dict[type, Callable[[Any], np.ndarray]] = {
    g.Box: _of_box,
    g.Cylinder: lambda s: np.array([s.start, s.end]),
    g.Sphere: lambda s: np.array([s.center]),
    g.Axle: lambda s: np.zeros((1, 3)),
    g.Mesh: lambda s: corners(s.vertices.min(axis=0), s.vertices.max(axis=0)),
}


def _with_default_sizes(shape: Any, size: float) -> Any:
    """Fill in the sizes that are open."""
    more: dict[str, Any] = {}
    if isinstance(shape, g.Curve):
        section = np.asarray(shape.section, dtype=float)
        other = np.nanmax(section) if np.isfinite(section).any() else TUBE * size
        more["section"] = np.where(np.isfinite(section), section, other)
        if shape.tangents is None:
            more["tangents"] = smooth_tangents(shape.points)
    elif hasattr(shape, "diameter"):
        usual = SPAN[shape.style] if isinstance(shape, g.Span) else DIAMETER[type(shape)]
        more["diameter"] = usual * size if shape.diameter is None else float(shape.diameter)
        if isinstance(shape, g.Axle):
            more["length"] = AXLE * size if shape.length is None else float(shape.length)
    return replace(shape, **more)


def smooth_tangents(points: np.ndarray) -> np.ndarray:
    """Return tangents of a smooth curve through points, shape (times, n, 3): differences of second order.

    Of the parameter that grows by 1 from each point to the next; within, these are the tangents of Catmull and Rom.
    """
    if points.shape[1] < 2:
        return np.zeros_like(points)
    return np.gradient(points, axis=1, edge_order=min(points.shape[1] - 1, 2))


def chord_fractions(curve: g.Curve) -> list[float]:
    """Return where the points of a curve are along its chord, undeformed, from 0 to 1."""
    if curve.rest_points is not None:
        way = np.linalg.norm(curve.rest_points - curve.rest_points[0], axis=1)
    else:
        way = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(curve.points[0], axis=0), axis=1))])
    return (way / way[-1] if way[-1] else np.linspace(0, 1, len(way))).tolist()
