"""MovingBody: base of bodies, which move freely where nothing else guides them."""

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
    """Base of bodies: the motion of their reference frame, and where a freely moving one starts."""

    angles_start: Any = structural(
        "angles at the start, in rad",
        default=(0, 0, 0),
        shape=(3,),
        doc="The orientation of a freely moving body, a guess unless angles_fixed. Joints that hold the "
        "body have start values of their own.",
    )
    sequence_start: Any = structural("axes of these angles", default=(1, 2, 3), shape=(3,), choices=(1, 2, 3))
    angles_fixed: bool = structural("whether the angles hold at the start", default=False, choices=(True, False))
    T_start: Any = structural(
        "rotation matrix of these angles",
        default=lambda self: axes_rotations(self.sequence_start, self.angles_start),
        shape=(3, 3),
        doc="From the world to the body; from the angles if not given.",
    )
    w_0_start: Any = structural(
        "angular velocity at the start, resolved in the world, in rad/s",
        default=(0, 0, 0),
        shape=(3,),
        doc="A guess unless w_0_fixed.",
    )
    w_0_fixed: bool = structural("whether it holds at the start", default=False, choices=(True, False))
    r_0: Vector3 = variable("position of the body, resolved in the world", unit="m")
    v_0: Vector3 = variable("der(r_0), resolved in the world", unit="m/s")
    a_0: Vector3 = variable("der(v_0), resolved in the world", unit="m/s2")
    w_a: Vector3 = variable("angular velocity, resolved in the body", unit="rad/s", start=T_start @ w_0_start)
    z_a: Vector3 = variable("angular acceleration, resolved in the body", unit="rad/s2")

    def free_frame(self) -> Frame:
        """Return a reference frame with the angles at the start."""
        return Frame(Q=guess(self._orientation())) if np.any(self.angles_start) else Frame()

    def free_root(self, frame: Any) -> Any:
        """State that the frame is a root where nothing else guides the body."""
        # Of bodies that move together, the one whose orientation is given tells it.
        return potential_root(frame, 0 if self.angles_fixed else 1 if np.any(self.angles_start) else 2)

    def free_start(self, frame: Any) -> Iterator[Any]:
        """Equations at the start of a body that moves freely."""
        if self.w_0_fixed:
            yield self.w_0_start == resolve1(frame.R, frame.R.w)
        if is_root(frame):
            if self.angles_fixed:
                yield self._orientation() == frame.Q
            else:
                yield frame.Q @ frame.Q == 1
        elif self.angles_fixed:
            raise DeclarationError(
                "angles_fixed=True has no effect here: the orientation follows from what the body is connected to. Leave it "
                "out, and fix the start there: phi=fixed(...) of a joint, angles_fixed=True of a Spherical or a free body."
            )

    def motion(self, frame: Any) -> Iterator[Any]:
        """Equations of the motion that results show."""
        yield self.r_0 == frame.r_0
        yield self.v_0 == resolve1(frame.R, frame.v)
        yield self.a_0 == resolve1(frame.R, frame.a)
        yield self.w_a == frame.R.w
        yield self.z_a == frame.z

    def _orientation(self) -> Any:
        return quaternion_of(self.T_start)


def off_centre(body: Any, world: Any, centre: Any) -> Iterator[Any]:
    """What must hold at the start: where gravity is that of a point, no body is there."""
    if world.gravity == "point":
        name = body._path or type(body).__name__
        yield require(
            dot(centre, centre) > 0,
            f"{name} starts at the origin of the world, where gravity of a point is infinite; start it elsewhere, "
            "for instance r_0=fixed((7e6, 0, 0)), or take World(gravity=None)",
        )


def past_centre(world: Any, m: Any, centre: Any, velocity: Any) -> Iterator[Any]:
    """What must hold in a run: where gravity is that of a point, no body of mass m comes there."""
    if world.gravity == "point":
        distance = sqrt(dot(centre, centre))
        yield apart(
            centre,
            dot(centre, velocity) / distance,
            m * world.mu / dot(centre, centre),
            "it reaches the origin of the world, where point gravity is infinite. End the run before that, stop_time=..., "
            "or let the body pass beside it: v_0=fixed(...) at right angles to the line to the origin",
        )
