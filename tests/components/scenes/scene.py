"""Scenes in which a component stands: what a scene holds hangs on `place`, the scene moves a body `tip`."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from acausal import Model, chain, connect, fixed, part, structural
from components import (
    Body,
    FixedRotation,
    Spherical,
    World,
)

SHIFT = np.array([1.0, 2.0, 3.0])
AXIS = np.array([1.0, -2.0, 0.5]) / np.linalg.norm([1.0, -2.0, 0.5])
ANGLE = 1.1
M, R_CM = 1.5, (0.1, 0.05, -0.04)
INERTIA = np.array([[0.02, 0.001, 0.0], [0.001, 0.03, -0.002], [0.0, -0.002, 0.04]])
SPIN = np.array([1.0, 2.0, 1.5])
RUBBER = {"length": 0.5, "E": 1e7, "rho": 1000.0, "A": 1e-3, "J": 1e-7, "reference": "pinned", "beta": 1e-4}


class Scene(Model):
    """Gravity, a place that may be turned and shifted with it, and a body that moves."""

    moved = structural("whether the scene is turned and shifted", default=False)
    turned = structural("whether the component is connected the other way round", default=False)

    @property
    def turn(self) -> Rotation:
        return Rotation.from_rotvec(ANGLE * AXIS * self.moved)

    @part
    def world(self):
        return World(n=tuple(self.turn.apply([0.0, -1.0, 0.0])))

    @part
    def place(self):
        return FixedRotation(r=tuple(SHIFT * self.moved), n=tuple(AXIS), angle=ANGLE * self.moved)

    @part
    def tip(self):
        return Body(m=M, r_CM=R_CM, I=INERTIA)

    def through(self, component: Any) -> tuple[Any, Any]:
        """First and second end on the way from the place."""
        a, b = component.ends
        ends = getattr(component, a), getattr(component, b)
        return ends[::-1] if self.turned else ends

    def path(self, *members: Any):
        """Chain from the place to the tip, component under test turned round where it is asked for."""
        last = self.place.frame_b
        for member in members:
            first, second = (
                self.through(member)
                if member is getattr(self, "it", None)
                else (
                    member.frame_a,
                    member.frame_b,
                )
            )
            yield connect(last, first)
            last = second
        yield connect(last, self.tip.frame_a)

    def connections(self):
        yield chain(self.world, self.place)
        yield from self.graph()


class OnSpherical(Scene):
    """place - spherical joint - it - tip."""

    joint = Spherical(angles_fixed=True, w_rel_a=fixed(tuple(SPIN)))

    def graph(self):
        yield from self.path(self.joint, self.it)


class Plain(Scene):
    joint = Spherical(angles_fixed=True, w_rel_a=fixed(tuple(SPIN)))

    def graph(self):
        yield from self.path(self.joint)
