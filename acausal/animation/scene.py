"""Evaluate the scene of a run: its shapes over time, their extent and their default sizes."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.arrangement import with_axes, with_rails
from acausal.animation.collect import PartShape, call_user_code, collect
from acausal.animation.colours import coloured
from acausal.animation.deformation_reference import with_references
from acausal.animation.evaluation import Evaluate, evaluate_shapes
from acausal.animation.missing_frames import fill_missing_frames
from acausal.animation.sizes import with_default_sizes
from acausal.animation.validation import check_shape
from acausal.errors import DeclarationError
from acausal.language.component import Component

# A scene whose median extent is below POINT times that of its path, such as a single body without sizes, takes the fraction
# ALONE of its path as its size.
POINT, ALONE = 1e-6, 0.5
ALL = "all"


@dataclass(frozen=True)
class Plot:
    """A plotted scalar: name, unit as declared, and its expression (1, 1) or values of shape (times,)."""

    name: str
    unit: str
    values: Any


@dataclass(frozen=True)
class Run:
    """A run to be animated.

    Parameters
    ----------
    tree : Component
        The bound model.
    time : array, shape (times,)
        Times of the frames, in s, not decreasing; equal times are the two sides of a jump.
    evaluate : callable
        Maps a column of n expressions in the model's symbols to an array of shape (times, n).
    plots : sequence of Plot
        Plotted scalars, as expressions.
    title : str
        Name of the model.
    stopped : str, optional
        Reason why the run ended early.
    trails : sequence of PartShape
        Trails, as expressions.
    """

    tree: Component
    time: np.ndarray
    evaluate: Evaluate
    plots: Sequence[Plot] = ()
    title: str = ""
    stopped: str | None = None
    trails: Sequence[PartShape] = ()


@dataclass(frozen=True)
class Scene:
    """An evaluated run.

    Parameters
    ----------
    run : Run
        Run that was evaluated.
    shapes : list of PartShape
        Shapes with arrays in place of expressions.
    plots : list of Plot
        Plotted scalars, as values.
    low, high : array, shape (3,)
        Corners of the bounding box over all times, in m, resolved in the world.
    size : float
        Median over time of the diagonal of the bounding box, in m; for a moving point a fraction of the extent of its path.
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

    def values(self) -> Iterator[g.Values]:
        """Yield the values of all curves."""
        for one in self.shapes:
            if isinstance(one.shape, g.Curve):
                yield from one.shape.values

    def with_values(self, names: Collection[str]) -> Scene:
        """Return the scene with the values of these names only."""
        shapes = []
        for one in self.shapes:
            if isinstance(curve := one.shape, g.Curve):
                one = replace(one, shape=replace(curve, values=tuple(v for v in curve.values if v.name in names)))
            shapes.append(one)
        return replace(self, shapes=shapes)

    def with_default_sizes(self, size: float) -> Scene:
        """Return the scene with default sizes, for a scene of the given size in m, where none are declared."""
        return replace(self, size=size, shapes=with_default_sizes(self.shapes, size))


def visible(seen: Iterable[PartShape]) -> bool:
    """Return whether a shape is more than the ground, a trail or an arrow."""
    return any(not isinstance(one.shape, g.Ground | g.Trail | g.Arrow) for one in seen)


def shapes_of(trees: Sequence[Component], values: Sequence[str] = ()) -> list[list[PartShape]]:
    """Return the shapes of models, with the values along curves that are requested or already evaluated.

    Parameters
    ----------
    trees : sequence of Component
        Bound models.
    values : sequence of str
        Names of the requested values; "all" for all.

    Raises
    ------
    DeclarationError
        If a model has nothing to draw, or no model has values of a requested name.
    """
    found = [collect(tree) for tree in trees]
    for tree, seen in zip(trees, found, strict=True):
        if not visible(seen):
            raise DeclarationError(
                f"{type(tree).__name__} cannot be animated: none of its parts has a shape. Yield shapes from shapes(), for "
                "instance `yield geometry.Sphere(geometry.Pose(self.frame.r_0, self.frame.R.T))`."
            )
    known = {v.name for seen in found for one in seen if isinstance(one.shape, g.Curve) for v in one.shape.values}
    missing = [name for name in values if name not in known | {ALL}]
    if missing:
        available = ", ".join(f'"{name}"' for name in sorted(known)) or "none"
        raise DeclarationError(f'no curve of the animation has values "{missing[0]}"; available values: {available}.')
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
    evaluated = [v for v in shape.values if not callable(v.entries) or v.name in names or ALL in names]
    return replace(
        shape, values=tuple(replace(v, entries=v.entries() if callable(v.entries) else v.entries) for v in evaluated)
    )


def scene_of(run: Run, seen: Sequence[PartShape]) -> Scene:
    """Return the scene of a run.

    Parameters
    ----------
    run : Run
        Run with at least one time.
    seen : sequence of PartShape
        Shapes of its tree, from `shapes_of`.
    """
    found, scalars = evaluate_shapes(seen, [plot.values for plot in run.plots], run.evaluate, run.time)
    for one in found:
        check_shape(one)
    found = with_references(with_rails(fill_missing_frames(found, run.time)))
    boxes = [box for box in (_box(one.shape) for one in found) if box is not None]
    low = np.min([box[0] for box in boxes], axis=0)
    high = np.max([box[1] for box in boxes], axis=0)
    size = float(np.median(np.linalg.norm(high - low, axis=1)))
    path = float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))
    if size <= POINT * path:
        size = ALONE * path or 1.0
    ups = [one.shape.up for one in found if isinstance(one.shape, g.Ground) and one.shape.up is not None]
    up = np.asarray(ups[0] if ups else (0, 1, 0), dtype=float)
    up = up / np.linalg.norm(up)
    found = coloured(with_axes(found, up, size), size)
    plots = [replace(plot, values=values) for plot, values in zip(run.plots, scalars, strict=True)]
    return Scene(run, found, plots, low.min(axis=0), high.max(axis=0), size, up)


def _box(shape: Any) -> tuple[np.ndarray, np.ndarray] | None:
    """Return the corners, shape (times, 3) each, of the bounding box of a shape; None if it has none."""
    points = bounding_points(shape)
    if points is None:
        return None
    diameter = getattr(shape, "diameter", None)
    margin = 0.0 if diameter is None else float(diameter) / 2
    return points.min(axis=1) - margin, points.max(axis=1) + margin


def bounding_points(shape: Any) -> np.ndarray | None:
    """Return points of the world, shape (times, points, 3), whose bounding box holds a shape; None of the ground."""
    if isinstance(shape, g.Curve):
        return shape.points
    if isinstance(shape, g.Span):
        return np.stack([shape.start, shape.end], axis=1)
    if isinstance(shape, g.Arrow | g.Trail):
        return shape.at[:, None]
    local = _LOCAL.get(type(shape))
    return None if local is None else in_world(shape.pose, local(shape))


def in_world(pose: g.Pose, points: np.ndarray) -> np.ndarray:
    """Return points that are fixed to a pose, (points, 3), in the world: shape (times, points, 3)."""
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


def chord_fractions(curve: g.Curve) -> list[float]:
    """Return the undeformed positions of the points of a curve along its chord, as fractions from 0 to 1."""
    if curve.rest_points is not None:
        distance = np.linalg.norm(curve.rest_points - curve.rest_points[0], axis=1)
    else:
        distance = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(curve.points[0], axis=0), axis=1))])
    return (distance / distance[-1] if distance[-1] else np.linspace(0, 1, len(distance))).tolist()
