"""Colours of shapes: one for each rigid body, and those of joints, springs and arrows; visible on light and dark pages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.collect import PartShape

PALETTE = ("#5585b5", "#d99a52", "#6aa37c", "#c26d63", "#8f79b8", "#55a3a8", "#b3a04f", "#b67a9c")
STEEL, BRIGHT, DARK, BASE, RUBBER = "#6f7886", "#b4bcc6", "#565f6c", "#a3abb6", "#4b515b"
FIXED, ROD, COIL, ROPE = "#8d949e", "#8f99a8", "#c08a3e", "#a07a50"
ARROWS = {"force": "#d8504d", "torque": "#8e4ec6"}
TRAIL = "#d0408a"
DIVERGING = ("#1f5fd0", "#5f9cf0", "#a9c4ea", "#c9c9c9", "#f0b59a", "#ea7a55", "#c8263b")  # of values, as on the page
SPANS = {"rod": ROD, "rail": STEEL, "coil": COIL, "damper": STEEL, "rope": ROPE}
# Shapes belong to one rigid body if they move relative to each other by less than this fraction of the scene, and this angle in
# rad: the tolerance of a run. So many frames are compared.
RIGID, COMPARED = 1e-4, 40


def coloured(seen: Sequence[PartShape], size: float) -> list[PartShape]:
    """Return shapes with the colours of their bodies or kinds; what never moves is grey, unless nothing moves.

    Parameters
    ----------
    seen : sequence of PartShape
        Evaluated shapes.
    size : float
        Size of the scene in m.
    """
    bodies = _bodies(seen, size)
    colours: dict[Any, str] = {}
    found = []
    for one, body in zip(seen, bodies, strict=True):
        if isinstance(one.shape, g.Span):
            colour = SPANS[one.shape.style]
        elif isinstance(one.shape, g.Arrow):
            colour = ARROWS[one.shape.quantity]
        elif isinstance(one.shape, g.Ground | g.Trail):
            colour = TRAIL if isinstance(one.shape, g.Trail) else None
        elif body == 0:
            colour = FIXED
        elif isinstance(one.shape, g.Axle) and one.shape.style not in OF_BODY:
            colour = STEEL
        else:
            colour = colours.setdefault(body, PALETTE[len(colours) % len(PALETTE)])
        found.append(replace(one, colour=colour))
    return found


OF_BODY = ("block", "sleeve", "gear", "rotor")


def _bodies(seen: Sequence[PartShape], size: float) -> list[Any]:
    """Return the rigid body of each shape: 0 for the world, a number, or the path of a part without a pose."""
    known: list[g.Pose] = []
    by_pose: dict[int, int] = {}
    for one in seen:
        pose = getattr(one.shape, "pose", None)
        if pose is None or id(pose) in by_pose:
            continue
        if not known:
            known.append(g.Pose(np.zeros_like(pose.r), np.broadcast_to(np.eye(3), pose.T.shape)))
        number = next((k for k, other in enumerate(known) if _fixed_to(other, pose, size)), len(known))
        if number == len(known):
            known.append(pose)
        by_pose[id(pose)] = number
    moves = len(known) > 1
    deforms = [isinstance(one.shape, g.Curve) or getattr(one.shape, "q", None) is not None for one in seen]
    return [
        one.path if soft or not moves else by_pose.get(id(getattr(one.shape, "pose", None)), one.path)
        for one, soft in zip(seen, deforms, strict=True)
    ]


def _fixed_to(one: g.Pose, other: g.Pose, size: float) -> bool:
    """Return whether a pose does not move relative to another one."""
    step = max(1, len(one.r) // COMPARED)
    T = one.T[::step]
    r = np.einsum("tij,tj->ti", T, other.r[::step] - one.r[::step])
    turned = T @ other.T[::step].transpose(0, 2, 1)
    return bool(np.ptp(r, axis=0).max() <= RIGID * size and np.ptp(turned, axis=0).max() <= RIGID)
