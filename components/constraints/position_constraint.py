"""PositionConstraint: base of joints formulated as constraints."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal import cross, structural
from components.frame import TwoFrames
from components.orientation import resolve1, resolve2


class PositionConstraint(TwoFrames):
    """Base of constraints between two frames; a subclass defines the rotational constraints.

    Notes
    -----
    No branch: other parts hold both frames, or the frames belong to free bodies. If constraints of a mechanism are
    redundant, an independent subset is selected.
    """

    x_locked: bool = structural(
        "whether frame_b is held along x of frame_a",
        default=True,
        choices=(True, False),
        doc="False lets frame_b slide along x.",
    )
    y_locked: bool = structural(
        "whether frame_b is held along y of frame_a",
        default=True,
        choices=(True, False),
        doc="False lets frame_b slide along y.",
    )
    z_locked: bool = structural(
        "whether frame_b is held along z of frame_a",
        default=True,
        choices=(True, False),
        doc="False lets frame_b slide along z.",
    )

    def equations(self):
        a, b = self.frame_a, self.frame_b
        r_rel_a = resolve2(a.R, b.r_0 - a.r_0)
        t_b_a = self.resolved_in_a(b.t)
        for k, locked in enumerate((self.x_locked, self.y_locked, self.z_locked)):
            yield r_rel_a[k] == 0 if locked else a.f[k] == 0
        yield b.f == -resolve2(b.R, resolve1(a.R, a.f))
        yield a.t == cross(r_rel_a, a.f) - t_b_a
        yield from self.rotational_constraints(t_b_a)

    def resolved_in_a(self, v: Any) -> Any:
        """Transform a vector from frame_b to frame_a."""
        return resolve2(self.frame_a.R, resolve1(self.frame_b.R, v))

    def rotational_constraints(self, t_b_a: Any) -> Iterator[Any]:
        """Yield three equations of the relative orientation and of t_b_a, the torque at frame_b resolved in frame_a.

        The power of the constraint, t_b_a times the relative angular velocity, must be 0.
        """
        raise NotImplementedError("yields the rotational constraints", "yield self.frame_b.t == (0, 0, 0)")
