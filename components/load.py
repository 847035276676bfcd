"""FrameLoad, WorldLoad: bases of prescribed forces and torques."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Component, cross, dot, port, structural
from components.frame import Frame, TwoFrames
from components.orientation import resolve1, resolve2

NONE = np.zeros(3)


class WorldLoad(Component):
    """Base of external loads at frame_b; a subclass defines load()."""

    ends = ("frame_b", "frame_b")
    resolve_in_frame: str = structural(
        "resolving frame of the load", default="world", choices=("world", "frame_b", "frame_resolve")
    )
    frame_b: Frame = port(Frame, "point of application")

    @port
    def frame_resolve(self) -> Frame | None:
        """Frame in which the load is resolved."""
        return Frame() if self.resolve_in_frame == "frame_resolve" else None

    def equations(self):
        b, (force, torque) = self.frame_b, self.load()
        where = {"frame_b": b, "frame_resolve": getattr(self, "frame_resolve", None)}.get(self.resolve_in_frame)
        yield b.f == -_transformed(force, where, b)
        yield b.t == -_transformed(torque, where, b)
        if self.resolve_in_frame == "frame_resolve":
            yield from _unloaded(self.frame_resolve)

    def load(self) -> tuple[Any, Any]:
        """Force and torque at frame_b, resolved in resolve_in_frame."""
        raise NotImplementedError("returns the force and torque at frame_b", "return self.force, NONE")

    def supplied_power(self):
        """Power of the load."""
        return -(dot(self.frame_b.f, self.frame_b.v) + dot(self.frame_b.t, self.frame_b.R.w))


class FrameLoad(TwoFrames):
    """Base of loads between two frames, opposite on one line of action; a subclass defines load(), acting at frame_b."""

    resolve_in_frame: str = structural(
        "resolving frame of the load", default="frame_b", choices=("frame_b", "frame_a", "world", "frame_resolve")
    )

    @port
    def frame_resolve(self) -> Frame | None:
        """Frame in which the load is resolved."""
        return Frame() if self.resolve_in_frame == "frame_resolve" else None

    def equations(self):
        a, b, (force, torque) = self.frame_a, self.frame_b, self.load()
        frames = {"frame_a": a, "frame_b": b, "frame_resolve": getattr(self, "frame_resolve", None)}
        where = frames.get(self.resolve_in_frame)
        force_0, torque_0 = _transformed(force, where, None), _transformed(torque, where, None)
        yield b.f == -_transformed(force, where, b)
        yield b.t == -_transformed(torque, where, b)
        yield a.f == resolve2(a.R, force_0)
        yield a.t == resolve2(a.R, torque_0 + cross(b.r_0 - a.r_0, force_0))
        if self.resolve_in_frame == "frame_resolve":
            yield from _unloaded(self.frame_resolve)

    def load(self) -> tuple[Any, Any]:
        """Force and torque at frame_b, resolved in resolve_in_frame."""
        raise NotImplementedError("returns the force and torque at frame_b", "return self.force, NONE")

    def supplied_power(self):
        """Power of the load at both frames."""
        a, b = self.frame_a, self.frame_b
        return -(dot(a.f, a.v) + dot(a.t, a.R.w) + dot(b.f, b.v) + dot(b.t, b.R.w))


def _transformed(vector: Any, where: Any, to: Any) -> Any:
    """Transform a vector from one frame to another; None is the world."""
    if where is to or vector is NONE:
        return vector
    vector = vector if where is None else resolve1(where.R, vector)
    return vector if to is None else resolve2(to.R, vector)


def _unloaded(frame: Any) -> Any:
    """Equations of a frame that transmits no load."""
    yield frame.f == (0, 0, 0)
    yield frame.t == (0, 0, 0)
