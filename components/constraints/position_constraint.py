"""PositionConstraint: base of joints that are stated as constraints."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal import cross, structural
from components.frame import TwoFrames
from components.orientation import resolve1, resolve2


class PositionConstraint(TwoFrames):
    """Base of constraints between two frames; a subclass states how they may turn.

    Notes
    -----
    No branch: both frames are held by the rest of the machine, or belong to bodies that move freely. Where constraints of a
    machine follow from one another, an independent subset is kept.
    """

    x_locked: bool = structural(
        "whether frame_b is held along x of frame_a",
        default=True,
        choices=(True, False),
        doc="False lets it slide along x.",
    )
    y_locked: bool = structural(
        "whether frame_b is held along y of frame_a",
        default=True,
        choices=(True, False),
        doc="False lets it slide along y.",
    )
    z_locked: bool = structural(
        "whether frame_b is held along z of frame_a",
        default=True,
        choices=(True, False),
        doc="False lets it slide along z.",
    )

    def equations(self):
        a, b = self.frame_a, self.frame_b
        r_rel_a = resolve2(a.R, b.r_0 - a.r_0)
        t_b_a = self.seen(b.t)
        for k, locked in enumerate((self.x_locked, self.y_locked, self.z_locked)):
            yield r_rel_a[k] == 0 if locked else a.f[k] == 0
        yield b.f == -resolve2(b.R, resolve1(a.R, a.f))
        yield a.t == cross(r_rel_a, a.f) - t_b_a
        yield from self.turning(t_b_a)

    def seen(self, v: Any) -> Any:
        """Turn a vector resolved in frame_b into frame_a."""
        return resolve2(self.frame_a.R, resolve1(self.frame_b.R, v))

    def turning(self, t_b_a: Any) -> Iterator[Any]:
        """Yield three equations of the relative orientation and of the torque of frame_b, t_b_a resolved in frame_a.

        The power of the constraint is t_b_a times the relative angular velocity; it is 0.
        """
        raise NotImplementedError("states how its frames may turn", "yield self.frame_b.t == (0, 0, 0)")
