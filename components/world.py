"""World: inertial frame and gravity field."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import (
    Component,
    DeclarationError,
    Scalar,
    as_expr,
    connected,
    dot,
    effect,
    geometry,
    parameter,
    port,
    root,
    sqrt,
    structural,
)
from components.frame import Frame, pose
from components.orientation import unit_vector


class World(Component):
    """Inertial frame and gravity field of all bodies. Every model has exactly one World."""

    ends = ("", "frame_b")
    gravity: Any = effect(
        "gravity",
        default="uniform",
        choices=("uniform", "point", callable, None),
        tries=(None,),
        doc="uniform: g n; point: -mu r / |r|^3; or a function of the position r that returns the acceleration in m/s2, both "
        "resolved in the world.",
    )
    potential: Any = structural(
        "potential of gravity as a function of the position",
        default=None,
        choices=(None, callable),
        doc="In J/kg, if gravity is a function. Without it the work of gravity is supplied energy.",
    )
    g: Scalar = parameter("acceleration of gravity", unit="m/s2", default=9.80665, doc="For uniform gravity.")
    n: Any = structural(
        "direction of gravity, resolved in the world",
        default=(0, -1, 0),
        shape=(3,),
        doc="For uniform gravity; any nonzero length.",
    )
    mu: Scalar = parameter(
        "gravity constant of the central body",
        unit="m3/s2",
        default=3.986004418e14,
        doc="For point gravity.",
    )
    frame_b: Frame = port(Frame, "the inertial frame")

    def check(self) -> None:
        """Reject a direction of length 0."""
        require_direction(self, self.n, "n")

    def connections(self):
        yield root(self.frame_b)

    def equations(self):
        frame, zero = self.frame_b, np.zeros(3)
        yield frame.r_0 == zero
        yield np.eye(3) == frame.R.T
        yield frame.R.w == zero
        yield frame.v == zero
        yield frame.a == zero
        yield frame.z == zero

    def acceleration(self, r: Any) -> Any:
        """Acceleration of gravity at the position r, resolved in the world, in m/s2."""
        if self.gravity == "uniform":
            return unit_vector(self.n) * self.g
        if self.gravity == "point":
            return -self.mu / (dot(r, r) * sqrt(dot(r, r))) * r
        return as_expr(self.gravity(r)) if callable(self.gravity) else np.zeros(3)

    def gravity_potential(self, r: Any) -> Any:
        """Potential of gravity at the position r, resolved in the world, in J/kg."""
        if self.gravity == "uniform":
            return -self.g * dot(unit_vector(self.n), r)
        if self.gravity == "point":
            return -self.mu / sqrt(dot(r, r))
        return self.potential(r) if callable(self.gravity) and self.potential else 0.0

    def power(self, m: Any, r: Any, v: Any) -> Any:
        """Power of gravity without a potential on a mass m at r with velocity v, resolved in the world, in W."""
        known = not callable(self.gravity) or self.potential is not None
        return 0.0 if known else m * dot(self.acceleration(r), v)

    def shapes(self):
        """The ground, normal to uniform gravity, and a support if a part is connected."""
        yield geometry.Ground(-unit_vector(self.n) if self.gravity == "uniform" else None)
        if connected(self.frame_b):
            yield geometry.Axle(pose(self.frame_b), None, style="support")


def require_direction(component: Any, vector: Any, name: str) -> None:
    """Reject a direction of length 0."""
    if not np.any(vector):
        raise DeclarationError(f"`{name}` has length 0; give a direction, for instance {name}=(0, 0, 1).")
