"""Default sizes of shapes, which suit the scene and what is attached to them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.arrangement import End, ends_of, near
from acausal.animation.collect import PartShape

# Default sizes as fractions of the detail: the smaller of the size of the scene and LONG times the median length of its parts.
LONG = 3.0
SPHERE, TUBE = 0.045, 0.006
CYLINDER = {"plain": 0.03, "link": 0.032, "wheel": 0.2, "guide": 0.012, "shaft": 0.012, "screw": 0.024}
SPAN = {"rod": 0.014, "rail": 0.016, "coil": 0.05, "damper": 0.026, "rope": 0.006}
# Length and diameter of the parts of joints, beside a part of the thickness THICK.
AXLE = {
    "hinge": (0.05, 0.038),
    "pin": (0.075, 0.016),
    "ball": (0.044, 0.044),
    "block": (0.075, 0.056),
    "sleeve": (0.07, 0.045),
    "gear": (0.024, 0.12),
    "rotor": (0.07, 0.07),
    "support": (0.08, 0.05),
}
THICK = 0.03
# Joints are smaller or larger by these factors at most, beside thin or thick parts.
SMALLEST, LARGEST = 0.4, 2.5
SLENDER = 0.14  # largest diameter of a link, relative to its length


def with_default_sizes(seen: Sequence[PartShape], size: float) -> list[PartShape]:
    """Return shapes with default sizes where none are declared.

    Parameters
    ----------
    seen : sequence of PartShape
        Evaluated shapes.
    size : float
        Size of the scene in m.
    """
    detail = min(size, LONG * _median_length(seen) or size)
    bars = [replace(one, shape=_sized(one.shape, detail)) for one in seen]
    ends = [end for one in bars for end in ends_of(one.shape) if end.thickness is not None]
    return [replace(one, shape=_joint(one.shape, ends, size, detail)) for one in bars]


def _median_length(seen: Sequence[PartShape]) -> float:
    """Return the median length of the long parts, 0 without any."""
    lengths = []
    for one in seen:
        if getattr(one.shape, "style", "link") in ("link", "plain", "rod", "coil", "damper"):
            points = [end.point for end in ends_of(one.shape)]
            lengths += [float(np.linalg.norm(points[1] - points[0]))] if points else []
    return float(np.median([length for length in lengths if length > 0] or [0.0]))


def _sized(shape: Any, detail: float) -> Any:
    """Return a shape other than a joint with default sizes."""
    if isinstance(shape, g.Curve):
        section = np.asarray(shape.section, dtype=float)
        other = np.nanmax(section) if np.isfinite(section).any() else TUBE * detail
        smooth = smooth_tangents(shape.points) if shape.tangents is None else shape.tangents
        return replace(shape, section=np.where(np.isfinite(section), section, other), tangents=smooth)
    if not isinstance(shape, g.Cylinder | g.Span | g.Sphere):
        return shape
    if shape.diameter is not None:
        return replace(shape, diameter=float(shape.diameter))
    if isinstance(shape, g.Sphere):
        return replace(shape, diameter=SPHERE * detail)
    if isinstance(shape, g.Span):
        return replace(shape, diameter=SPAN[shape.style] * detail)
    length = float(np.linalg.norm(np.asarray(shape.end) - np.asarray(shape.start)))
    thin = SLENDER * length if shape.style == "link" and length else np.inf
    return replace(shape, diameter=min(CYLINDER[shape.style] * detail, thin))


def _joint(shape: Any, ends: Sequence[End], size: float, detail: float) -> Any:
    """Return a part of a joint with default sizes that suit the thickest part attached to it."""
    if not isinstance(shape, g.Axle):
        return shape
    attached = [end.thickness or 0.0 for end in ends if near(end.point, shape.pose.r[0], size)]
    factor = float(np.clip(max(attached) / (THICK * detail), SMALLEST, LARGEST)) if attached else 1.0
    length, diameter = (factor * detail * fraction for fraction in AXLE[shape.style])
    return replace(
        shape,
        length=length if shape.length is None else float(shape.length),
        diameter=diameter if shape.diameter is None else float(shape.diameter),
    )


def smooth_tangents(points: np.ndarray) -> np.ndarray:
    """Return tangents at the points of a curve, shape (times, n, 3), by differences of second order.

    The parameter grows by 1 from each point to the next. At inner points these are the tangents of a Catmull-Rom spline.
    """
    if points.shape[1] < 2:
        return np.zeros_like(points)
    return np.gradient(points, axis=1, edge_order=min(points.shape[1] - 1, 2))
