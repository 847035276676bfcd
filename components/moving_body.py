"""MovingBody: base of bodies, which move freely unless joints guide them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from acausal import (
    Component,
    DeclarationError,
    Vector3,
    apart,
    dot,
    guess,
    is_root,
    potential_root,
    require,
    sqrt,
    structural,
    variable,
)
from components.frame import Frame
from components.orientation import axes_rotations, quaternion_of, resolve1


class MovingBody(Component):
    """Base of bodies: motion of the reference frame, and initial conditions of free bodies."""

    angles_start: Any = structural(
        "initial angles, in rad",
        default=(0, 0, 0),
        shape=(3,),
        doc="Orientation of a free body, a guess unless angles_fixed=True. If joints guide the body, their start "
        "values apply.",
    )
    sequence_start: Any = structural("axes of these angles", default=(1, 2, 3), shape=(3,), choices=(1, 2, 3))
    angles_fixed: bool = structural("whether the initial angles are fixed", default=False, choices=(True, False))
    T_start: Any = structural(
        "rotation matrix of these angles",
        default=lambda self: axes_rotations(self.sequence_start, self.angles_start),
        shape=(3, 3),
        doc="From the world to the body; computed from the angles if not given.",
    )
    w_0_start: Any = structural(
        "initial angular velocity, resolved in the world, in rad/s",
        default=(0, 0, 0),
        shape=(3,),
        doc="A guess unless w_0_fixed=True.",
    )
    w_0_fixed: bool = structural("whether w_0_start is fixed", default=False, choices=(True, False))
    r_0: Vector3 = variable("position of the body, resolved in the world", unit="m")
    v_0: Vector3 = variable("der(r_0), resolved in the world", unit="m/s")
    a_0: Vector3 = variable("der(v_0), resolved in the world", unit="m/s2")
    w_a: Vector3 = variable("angular velocity, resolved in the body", unit="rad/s", start=T_start @ w_0_start)
    z_a: Vector3 = variable("angular acceleration, resolved in the body", unit="rad/s2")

    def free_frame(self) -> Frame:
        """Return a reference frame with the initial angles."""
        return Frame(Q=guess(self._orientation())) if np.any(self.angles_start) else Frame()

    def free_root(self, frame: Any) -> Any:
        """Return the potential root of a body: its frame becomes a root if no joint guides it."""
        # Among connected bodies, the body whose orientation is specified becomes the root.
        return potential_root(frame, 0 if self.angles_fixed else 1 if np.any(self.angles_start) else 2)

    def free_start(self, frame: Any) -> Iterator[Any]:
        """Yield the initial equations of a free body."""
        if self.w_0_fixed:
            yield self.w_0_start == resolve1(frame.R, frame.R.w)
        if is_root(frame):
            if self.angles_fixed:
                yield self._orientation() == frame.Q
            else:
                yield frame.Q @ frame.Q == 1
        elif self.angles_fixed:
            raise DeclarationError(
                "angles_fixed=True has no effect here: the connected parts determine the orientation. Leave it out and fix "
                "their initial values: phi=fixed(...) of a joint, angles_fixed=True of a Spherical or a free body."
            )

    def motion(self, frame: Any) -> Iterator[Any]:
        """Yield the equations of the motion variables, resolved in the world."""
        yield self.r_0 == frame.r_0
        yield self.v_0 == resolve1(frame.R, frame.v)
        yield self.a_0 == resolve1(frame.R, frame.a)
        yield self.w_a == frame.R.w
        yield self.z_a == frame.z

    def _orientation(self) -> Any:
        return quaternion_of(self.T_start)


def point_gravity_requirements(body: Any, world: Any, centre: Any) -> Iterator[Any]:
    """Require that the body does not start at the singularity of point gravity."""
    if world.gravity == "point":
        name = body._path or type(body).__name__
        yield require(
            dot(centre, centre) > 0,
            f"{name} starts at the origin of the world, where point gravity is infinite; start it elsewhere, "
            "for instance r_0=fixed((7e6, 0, 0)), or take World(gravity=None)",
        )


def point_gravity_validity(world: Any, m: Any, centre: Any, velocity: Any) -> Iterator[Any]:
    """Check during a run that a body of mass m does not reach the singularity of point gravity."""
    if world.gravity == "point":
        distance = sqrt(dot(centre, centre))
        yield apart(
            centre,
            dot(centre, velocity) / distance,
            m * world.mu / dot(centre, centre),
            "the body reaches the origin of the world, where point gravity is infinite. End the run before that, stop_time=..., "
            "or let the body miss it: v_0=fixed(...) perpendicular to the line to the origin",
        )
