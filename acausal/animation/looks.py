"""Looks of shapes by style: layers of solids of revolution, which the page and the films draw alike."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from acausal.animation.colours import BASE, BRIGHT, DARK, RUBBER, STEEL

# A row of a layer holds the position along the axis as a fraction of the length and, added to it, in diameters; and the radius in
# diameters. So ends keep their shape whatever the length.
Row = tuple[float, float, float]
TEETH, THREADS = 18, 12  # teeth of a gear, grooves of a screw
OVERHANG = 3.0  # of a rail beyond the path on it, in diameters
FEW = 8  # sides of what is not round
QUARTER = np.linspace(0, np.pi / 2, 5)


@dataclass(frozen=True)
class Layer:
    """One solid of revolution.

    Parameters
    ----------
    rows : sequence of Row
        Half of its section, along the axis.
    colour : str, optional
        Colour "#rrggbb"; that of the shape if not given.
    sides : int
        Number of corners around the axis.
    notch : float
        Depth of a gap behind every second pair of corners, as a fraction of the radius: teeth.
    """

    rows: tuple[Row, ...]
    colour: str | None = None
    sides: int = 32
    notch: float = 0.0


def _solid(start: float, end: float, radius: float, *, beyond: float = 0.0, bevel: float = 0.0) -> tuple[Row, ...]:
    """Return a cylinder with bevelled edges between two fractions of the length; both ends reach farther by `beyond`."""
    low, high = (start, -beyond), (end, beyond)
    rows = [(*low, 0.0), (*low, radius - bevel), (start, bevel - beyond, radius)]
    return (*rows, (end, beyond - bevel, radius), (*high, radius - bevel), (*high, 0.0))


def _round_ends(start: float, end: float) -> tuple[Row, ...]:
    """Return a cone with round ends of two radii."""
    first = [(0.0, -start * float(np.cos(a)), start * float(np.sin(a))) for a in QUARTER]
    return (*first, *((1.0, end * float(np.sin(a)), end * float(np.cos(a))) for a in QUARTER))


def _ring(inner: float, outer: float) -> tuple[Row, ...]:
    """Return a ring with a round tread over the whole length."""
    tread = [
        (0.5 + 0.5 * float(np.sin(a)), 0.0, outer - 0.06 * (1 - float(np.cos(a)))) for a in np.linspace(-1.5, 1.5, 9)
    ]
    return ((0.02, 0.0, inner), *tread, (0.98, 0.0, inner), (0.02, 0.0, inner))


def _thread() -> tuple[Row, ...]:
    """Return a rod with grooves."""
    places = np.arange(2 * THREADS + 1) / (2 * THREADS)
    rows = [(float(s), OVERHANG * (2 * float(s) - 1), 0.5 if k % 2 else 0.36) for k, s in enumerate(places)]
    return ((0.0, -OVERHANG, 0.0), *rows, (1.0, OVERHANG, 0.0))


PLAIN = (Layer(_solid(0, 1, 0.5)),)
LOOKS: dict[str, tuple[Layer, ...]] = {
    "plain": PLAIN,
    "rod": PLAIN,
    "rope": (Layer(_solid(0, 1, 0.5), sides=8),),
    "link": (Layer(_round_ends(0.5, 0.36)),),
    "rail": (Layer(_solid(0, 1, 0.5), STEEL, sides=4),),
    "guide": (Layer(_solid(0, 1, 0.5, beyond=OVERHANG), STEEL, sides=4),),
    "shaft": (Layer(_solid(0, 1, 0.5, beyond=OVERHANG), STEEL),),
    "screw": (Layer(_thread(), STEEL),),
    "wheel": (
        Layer(_ring(0.36, 0.5), RUBBER, sides=40),
        Layer(_solid(0.2, 0.8, 0.37), BRIGHT, sides=40),
        Layer(_solid(0.1, 0.9, 0.3, bevel=0.02), sides=5),
        Layer(_solid(0.0, 1.0, 0.07, bevel=0.02), DARK),
    ),
    "hinge": (
        Layer(_solid(0, 1, 0.5, bevel=0.06), STEEL),
        Layer(_solid(0, 1, 0.24, beyond=0.1, bevel=0.04), BRIGHT),
    ),
    "pin": (Layer(_solid(0, 1, 0.5, bevel=0.1), STEEL),),
    "ball": (
        Layer(tuple((0.5, -0.5 * float(np.cos(a)), 0.5 * float(np.sin(a))) for a in np.linspace(0, np.pi, 13)), STEEL),
    ),
    "block": (Layer(_solid(0, 1, 0.5, bevel=0.05), sides=4),),
    "sleeve": (Layer(_solid(0, 1, 0.5, bevel=0.06)),),
    "gear": (
        Layer(_solid(0, 1, 0.5), sides=4 * TEETH, notch=0.12),
        Layer(_solid(0, 1, 0.12, beyond=0.05, bevel=0.02), STEEL),
    ),
    "rotor": (
        Layer(_solid(0.15, 0.85, 0.5, bevel=0.06)),
        Layer(_solid(0, 1, 0.12, bevel=0.02), BRIGHT),
    ),
    # A square plate behind the pose, on whose boss the joint or beam is mounted.
    "support": (
        Layer(_solid(0, 0.12, 1.0, bevel=0.05), BASE, sides=4),
        Layer(((0.12, 0.0, 0.75), (0.3, 0.0, 0.56), (0.5, 0.0, 0.5), (0.5, 0.0, 0.0)), BASE),
    ),
    "damper": (
        Layer(_solid(0, 0.55, 0.5, bevel=0.06), STEEL),
        Layer(_solid(0.5, 1, 0.2), BRIGHT),
    ),
}


def corners_of(layer: Layer, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the angles of the corners around the axis, in rad, and their radii relative to those of the rows.

    The flats of few sides touch the circle, so that a diameter is the width of a square. There are at most `most` without teeth.
    """
    sides = layer.sides if layer.notch else min(layer.sides, most)
    k = np.arange(sides)
    flat = 1 / np.cos(np.pi / sides) if sides < FEW else 1.0
    return 2 * np.pi * (k + 0.5) / sides, flat * np.where(k % 4 < 2, 1.0, 1 - layer.notch)
