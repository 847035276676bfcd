"""Range of validity of a linear body: its angular velocity, welds, and frames that carry no moment."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import dot, expect, quantity, require, sqrt
from components.fe.reduction.interface import Interface
from components.fe.reduction.reduced_body import ReducedBody

# Limit of w^2 relative to the square of the first frequency, the missing part of the stiffness: at half of the first
# frequency, the deflection of the spin-up beam is a tenth too large (docs/background/fe.md).
SPIN = 0.25
# Moment that counts as 0, relative to force times size of the body: round-off at the start, integration error during a
# run.
ROUNDING, SHARE = 1e-9, 1e-6
# The same without a force, relative to the moment that bends the body by its own size.
SMALL = 1e-12


def spinning(body: ReducedBody, w: Any, stiffness: Any) -> Any:
    """Expect the angular velocity to stay well below the first frequency.

    Parameters
    ----------
    body : ReducedBody
        The reduced body.
    w : Expr, shape (3,)
        Angular velocity of the reference frame.
    stiffness : Expr
        Factor of the stiffness.
    """
    first = 2 * np.pi * body.frequencies[body.frequencies > 0][0]
    return expect(
        dot(w, w),
        quantity(first**2, "1/s2") * stiffness,
        SPIN,
        f"it turns faster than half of its first frequency, {first / (2 * np.pi):.4g} Hz, where a linear body deflects too much "
        "because it lacks centrifugal stiffening; beyond its first frequency it is unstable. Do this: divide it into several "
        "bodies, or, for a beam, use a FlexibleBeam with geometric_stiffness=True",
    )


def welded(interface: Interface, frame: Any) -> Any:
    """Expect no load at a frame that averages its nodes and is welded to another FE body.

    Parameters
    ----------
    interface : Interface
        The frame, welded to a frame of another body.
    frame : Frame
        Port of the frame.
    """
    f, t = frame.f, frame.t
    carried = sqrt(dot(f, f) * quantity(1.0, "m2") + dot(t, t))
    return expect(
        carried,
        carried,
        1 / 2,
        f"the frame `{interface.name}` is welded to another FE body, but averages its nodes without connecting them rigidly: the "
        "joint is softer than the material. Do this: "
        f'reduce_body(frames={{"{interface.name}": rigid(nodes)}}) for both bodies',
    )


class Moments:
    """Conditions that a frame without rotations carries no moment.

    Parameters
    ----------
    body : ReducedBody
        The reduced body.
    """

    def __init__(self, body: ReducedBody) -> None:
        self.length = quantity(np.sqrt(np.trace(body.second_moment) / body.mass), "m")
        rate = np.max(body.frequencies, initial=1.0) * 2 * np.pi
        self.moment = quantity(np.trace(body.second_moment) * rate**2, "N.m")

    def none(self, interface: Interface, frame: Any) -> Any:
        """Require zero moment at the start."""
        f, t = frame.f, frame.t
        most = (ROUNDING * self.length) ** 2 * dot(f, f) + (SMALL * self.moment) ** 2
        return require(dot(t, t) <= most, _refused(interface))

    def stays_none(self, interface: Interface, frame: Any) -> Any:
        """Expect zero moment during a run."""
        f, t = frame.f, frame.t
        return expect(
            sqrt(dot(t, t)), self.length * sqrt(dot(f, f)) + SMALL / SHARE * self.moment, SHARE, _refused(interface)
        )


def _refused(interface: Interface) -> str:
    return (
        f"the frame `{interface.name}` has one node or collinear nodes, which cannot carry a moment, but a connected part exerts "
        "a moment on it or constrains its rotation. Do this: use more nodes for the frame, or connect it by parts that carry "
        "forces only, such as Spherical, Spring, WorldForce"
    )
