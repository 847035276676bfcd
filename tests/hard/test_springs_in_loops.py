"""Random over-constrained spatial loops with springs, which conserve their energy."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, fixed, parts, structural
from components import BodyShape, Fixed, Revolute, Spring, World
from tests.hard.measure import within
from tests.shared import compiled


@dataclass(frozen=True)
class Drawn:
    """Joints of a loop at the start, what its bars weigh, where two springs are held, and how it begins."""

    places: np.ndarray
    axes: np.ndarray
    speed: float
    masses: np.ndarray
    inertias: np.ndarray
    anchors: np.ndarray
    stiffness: np.ndarray


def sarrus(random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Sarrus' linkage: two knees in planes through the z axis lift a platform."""
    legs, out, apart = random.uniform(0.5, 1, 2), random.uniform(0.3, 0.8), random.uniform(0.9, 2.2)
    high, up = random.uniform(0.4, 0.9) * 2 * min(legs), np.array([0, 0, 1.0])
    knees, axes = [], []
    for leg, angle in zip(legs, (0.0, apart), strict=True):
        way = np.array([np.cos(angle), np.sin(angle), 0])
        knees.append(
            out * way + np.outer([0, np.sqrt(leg**2 - high**2 / 4), 0], way) + np.outer([0, high / 2, high], up)
        )
        axes += 3 * [np.cross(up, way)]
    return np.vstack([knees[0], knees[1][::-1]]), np.array(axes)


def bennett(random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Bennett's linkage, by the parameters of Denavit and Hartenberg: tan(a / 2) tan(b / 2) of its angles is constant."""
    length, twist = np.array([1.0, random.uniform(1.2, 1.9)]), np.array([random.uniform(0.3, 0.5), 0])
    twist[1] = np.arcsin(length[1] * np.sin(twist[0]))
    first = random.uniform(0.4, 2.5)
    ratio = np.sin((twist[1] + twist[0]) / 2) / np.sin((twist[1] - twist[0]) / 2)
    second = 2 * np.arctan2(ratio * np.cos(first / 2), np.sin(first / 2))
    at, turned, places, axes = np.zeros(3), Rotation.identity(), [], []
    for k, angle in enumerate((first, second, -first, -second)):
        places.append(at)
        axes.append(turned.apply([0, 0, 1]))
        turned = turned * Rotation.from_rotvec([0, 0, angle])
        at = at + turned.apply([length[k % 2], 0, 0])
        turned = turned * Rotation.from_rotvec([twist[k % 2], 0, 0])
    assert np.abs(at).max() < 1e-12
    return np.array(places), np.array(axes)


@cache
def drawn(kind: str, seed: int) -> Drawn:
    """Draw a machine."""
    random = np.random.default_rng(seed)
    places, axes = {"sarrus": sarrus, "bennett": bennett}[kind](random)
    turned, n = Rotation.from_quat(random.normal(size=4)), len(places) - 1
    places, axes = turned.apply(places), turned.apply(axes)
    speed, masses, inertias = random.uniform(-3, 3), random.uniform(0.2, 3, n), random.uniform(0.05, 0.1, n)
    anchors, stiffness = places[1:3] + random.uniform(-2, 2, (2, 3)), random.uniform(1, 100, 2)
    return Drawn(places, axes, speed, masses, inertias, anchors, stiffness)


class Sprung(Model):
    """A loop of bars between two points of the world, with springs on its first two bars."""

    kind: str = structural("kind of loop")
    seed: int = structural("which one")
    world = World()

    @property
    def drawn(self) -> Drawn:
        """Its numbers."""
        return drawn(self.kind, self.seed)

    @parts
    def end(self):
        """Where the loop begins and ends."""
        return [Fixed(r=tuple(self.drawn.places[k])) for k in (0, -1)]

    @parts
    def joint(self):
        """Its joints; the first one holds the start."""
        first, *others = map(tuple, self.drawn.axes)
        return [Revolute(n=first, phi=fixed(0), w=fixed(self.drawn.speed)), *(Revolute(n=axis) for axis in others)]

    @parts
    def bar(self):
        """Its moving bars."""
        ways = zip(np.diff(self.drawn.places, axis=0), self.drawn.masses, self.drawn.inertias, strict=True)
        return [BodyShape(r=tuple(way), r_CM=tuple(way / 2), m=m, I=i * np.eye(3)) for way, m, i in ways]

    @parts
    def anchor(self):
        """Where the springs are held."""
        return [Fixed(r=tuple(place)) for place in self.drawn.anchors]

    @parts
    def spring(self):
        """Springs to the ends of the first two bars."""
        return [Spring(c=c, s_unstretched=0.1) for c in self.drawn.stiffness]

    def connections(self):
        links = [one for pair in zip(self.joint, self.bar, strict=False) for one in pair]
        yield chain(self.end[0].frame_b, *links, self.joint[-1], self.end[1].frame_b)
        for anchor, spring, bar in zip(self.anchor, self.spring, self.bar, strict=False):
            yield chain(anchor.frame_b, spring, bar.frame_b)


def angles(kind: str, seed: int, **how: Any) -> tuple[np.ndarray, float]:
    """Return the angles of all joints of a run, and the change of the energy."""
    model = compiled(Sprung, kind=kind, seed=seed)
    result = ac.simulate(model, stop_time=3.0, intervals=60, energy=True, **how)
    found = [result[f"joint[{k}].phi"] for k in range(len(model.tree.joint))]
    return np.array(found), abs(result.stats.energy_stored_change)


@cache
def expected(kind: str, seed: int) -> np.ndarray:
    """Return the angles at a tenth of the tolerance, where the energy is kept."""
    found, change = angles(kind, seed, tolerance=1e-8, method="rosenbrock")
    within("energy at 1e-8, J", change, 2e-5)
    return found


@pytest.mark.parametrize("method", ["auto", "idas"])
# Of fifty, three that are quick and pass no singular configuration.
@pytest.mark.parametrize(("kind", "seed"), [("bennett", 11), ("sarrus", 5), ("sarrus", 1)])
def test_every_method_follows_them(kind: str, seed: int, method: str) -> None:
    found, change = angles(kind, seed, tolerance=1e-7, method=method)
    within("angles, rad", np.abs(found - expected(kind, seed)).max(), 1e-4)
    within("energy, J", change, 1e-4)
