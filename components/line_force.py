"""LineForce: base of springs and dampers between the origins of two frames."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import (
    Scalar,
    apart,
    dot,
    is_root,
    parameter,
    piecewise,
    port,
    potential_root,
    require,
    sqrt,
    structural,
    variable,
)
from components.frame import Frame, TwoFrames
from components.orientation import resolve1, resolve2

LAST = 10  # priority as a root, as in PointMass: any other potential root determines the orientation first


class LineForce(TwoFrames):
    """Base of forces along the line from frame_a to frame_b; a subclass defines f.

    Notes
    -----
    No branch: the component does not relate the orientations of its ends; other parts must hold both. A point held by line
    forces only needs fixed_rotation_at_frame_a or _b of one of them. If the ends meet under a nonzero force, the line has no
    direction and the run ends with a SimulationError.
    """

    s_small: Scalar = parameter(
        "smallest length used as a divisor",
        unit="m",
        default=1e-10,
        positive=True,
        doc="Lower bound of the length in the direction of the line.",
    )
    fixed_rotation_at_frame_a: bool = structural(
        "whether frame_a has the axes of the world unless other parts determine its orientation",
        default=False,
        choices=(True, False),
        doc="True at a point held by line forces only.",
    )
    fixed_rotation_at_frame_b: bool = structural(
        "whether frame_b has the axes of the world unless other parts determine its orientation",
        default=False,
        choices=(True, False),
        doc="True at a point held by line forces only.",
    )
    s: Scalar = variable("length of the line", unit="m")
    v: Scalar = variable("der(s)", unit="m/s")
    f: Scalar = variable("force along the line, positive if it pulls the ends together", unit="N")

    @port
    def frame_a(self) -> Frame:
        """Coordinate system at the first end."""
        return Frame(turns=not self.fixed_rotation_at_frame_a)

    @port
    def frame_b(self) -> Frame:
        """Coordinate system at the second end."""
        return Frame(turns=not self.fixed_rotation_at_frame_b)

    def connections(self):
        if self.fixed_rotation_at_frame_a:
            yield potential_root(self.frame_a, LAST)
        if self.fixed_rotation_at_frame_b:
            yield potential_root(self.frame_b, LAST)

    def equations(self):
        a, b = self.frame_a, self.frame_b
        r_rel_0 = b.r_0 - a.r_0
        square, least = dot(r_rel_0, r_rel_0), self.s_small**2
        # A separate expression rather than s: the iteration of s may begin at 0, where this length stays positive.
        length = sqrt(piecewise((square, square > least), least, smooth=True))
        e_0 = r_rel_0 / length
        yield self.s == length
        yield self.v == dot(e_0, resolve1(b.R, b.v) - resolve1(a.R, a.v))
        yield from self.law()
        f_a, f_b = self.pulls()
        inertia_a, inertia_b = self.inertia_loads(e_0)
        yield a.f == resolve2(a.R, inertia_a - e_0 * f_a)
        yield b.f == resolve2(b.R, inertia_b + e_0 * f_b)
        for frame in (a, b):
            if not is_root(frame):
                yield frame.t == (0, 0, 0)

    def requirements(self):
        name = self._path or type(self).__name__
        yield require(
            self.s > 1.5 * self.s_small,
            f"the ends of {name} coincide at the start and the force has no direction; separate frame_a and frame_b, for "
            "instance by FixedTranslation(r=...), or start a joint elsewhere: Prismatic(s=fixed(0.1))",
        )

    def validity(self):
        yield apart(
            self.frame_b.r_0 - self.frame_a.r_0,
            self.v,
            self.f,
            "the ends meet, where the force has no direction and reverses. Offset their paths, for instance by "
            "FixedTranslation(r=...) at one end, add a stop that keeps them apart, or use a law with zero force at zero "
            "length (s_unstretched=0). Place a spring that acts in both directions along a guide on the axis of its joint: "
            "Prismatic(use_axis_flange=True)",
        )

    def pulls(self) -> tuple[Any, Any]:
        """Forces at frame_a and frame_b along the line, positive if they pull the ends together."""
        return self.f, self.f

    def inertia_loads(self, e_0: Any) -> tuple[Any, Any]:
        """Inertia loads of masses on the line at frame_a and frame_b, resolved in the world; e_0 is the line's direction."""
        return np.zeros(3), np.zeros(3)

    def law(self) -> Any:
        """Yield the equation of f."""
        raise NotImplementedError("yields the equation of the force f", "yield self.f == ...")
