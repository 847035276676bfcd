"""Where a linear body is valid: how fast it may turn, and where it can carry a moment."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import dot, expect, quantity, require, sqrt
from components.fe.reduction.interface import Interface
from components.fe.reduction.reduced_body import ReducedBody

# Of the square of the first frequency: what w^2 may reach, which is the part of the stiffness that is missing. At half of the
# first frequency the spin-up beam deflects by a tenth more than the true one (docs/fe.md).
SPIN = 0.25
# Of force times size of the body: what of a moment is rounding at the start, and in a run, where values follow from steps.
ROUNDING, SHARE = 1e-9, 1e-6
# Of the moment that bends the body by its own size: the same where no force acts.
SMALL = 1e-12


def spinning(body: ReducedBody, w: Any, stiffness: Any) -> Any:
    """State that a body turns slowly against its first frequency.

    Parameters
    ----------
    body : ReducedBody
        Its modes.
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
        f"it turns faster than half of its first frequency, {first / (2 * np.pi):.4g} Hz, but a linear body is not stiffened by "
        "centrifugal forces: it deflects too much, and beyond its first frequency without bound. Divide it into several "
        "bodies, or, if it is a beam, take a FlexibleBeam with geometric_stiffness=True",
    )


def welded(interface: Interface, frame: Any) -> Any:
    """State that a frame which follows the average of its nodes carries nothing to another body of finite elements.

    Parameters
    ----------
    interface : Interface
        The frame, welded to one of another body.
    frame : Frame
        Its port.
    """
    f, t = frame.f, frame.t
    carried = sqrt(dot(f, f) * quantity(1.0, "m2") + dot(t, t))
    return expect(
        carried,
        carried,
        1 / 2,
        f"the frame `{interface.name}` is welded to another body of finite elements, and follows the average of its nodes, which "
        "do not hold together: the joint is softer than the material. Do this: "
        f'reduce_body(frames={{"{interface.name}": rigid(nodes)}}) for both bodies',
    )


class Moments:
    """How large a moment is on a frame that cannot carry any.

    Parameters
    ----------
    body : ReducedBody
        Its modes.
    """

    def __init__(self, body: ReducedBody) -> None:
        self.length = quantity(np.sqrt(np.trace(body.second_moment) / body.mass), "m")
        rate = np.max(body.frequencies, initial=1.0) * 2 * np.pi
        self.moment = quantity(np.trace(body.second_moment) * rate**2, "N.m")

    def none(self, interface: Interface, frame: Any) -> Any:
        """State that there is none at the start."""
        f, t = frame.f, frame.t
        most = (ROUNDING * self.length) ** 2 * dot(f, f) + (SMALL * self.moment) ** 2
        return require(dot(t, t) <= most, _refused(interface))

    def stays_none(self, interface: Interface, frame: Any) -> Any:
        """State that there is none in a run."""
        f, t = frame.f, frame.t
        return expect(
            sqrt(dot(t, t)), self.length * sqrt(dot(f, f)) + SMALL / SHARE * self.moment, SHARE, _refused(interface)
        )


def _refused(interface: Interface) -> str:
    return (
        f"the frame `{interface.name}` is given by one node or by nodes on a line, which cannot carry a moment, and something "
        "connected to it puts one on it or holds its rotation. Take more nodes for the frame, or connect it by what carries "
        "forces only: Spherical, Spring, WorldForce"
    )
