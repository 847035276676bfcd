"""Beam: what beams of every formulation have in common."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import Scalar, effect, observed, parameter, sqrt, structural
from components.beams.range import beam_range
from components.beams.tube import tube
from components.frame import TwoFrames
from components.orientation import resolve2


class Beam(TwoFrames):
    """Base of straight beams along x of frame_a that bend in its xy plane."""

    length: Scalar = parameter("length", unit="m", positive=True)
    E: Scalar = parameter("modulus of elasticity", unit="Pa", positive=True)
    rho: Scalar = parameter("density", unit="kg/m3", positive=True)
    A: Scalar = parameter("area of the section", unit="m2", positive=True)
    J: Scalar = parameter("second moment of area for bending in xy", unit="m4", positive=True)
    J_y: Scalar = parameter(
        "second moment of area about y",
        unit="m4",
        default=lambda s: s.J,
        minimum=0,
        doc="It only enters the inertia about the beam's own axis; J if not given.",
    )
    torsional_inertia: Scalar = parameter(
        "moment of inertia about the beam's own axis",
        unit="kg.m2",
        default=lambda s: s.rho * (s.J + s.J_y) * s.length,
        minimum=0,
        doc="It is rho (J + J_y) length if not given.",
    )
    reference: str = structural(
        "reference frame",
        default="tangent",
        choices=("tangent", "pinned"),
        doc="It is tangent to the root, or the chord from the first to the last point.",
    )
    alpha: Scalar = parameter(
        "mass-proportional damping",
        unit="1/s",
        default=0,
        minimum=0,
        doc="Rayleigh damping: D = alpha M + beta K, of what moves in the reference frame: little does in short volumes.",
    )
    beta: Scalar = parameter(
        "stiffness-proportional damping",
        unit="s",
        default=0,
        minimum=0,
        doc="Rayleigh damping: D = alpha M + beta K.",
    )
    initial: str = structural(
        "state at the start",
        default="undeformed",
        choices=("undeformed", "static", "free"),
        doc="undeformed: q = 0 and der(q) = 0; static: der(q) = 0 and der(der(q)) = 0; free: nothing. A start "
        "in steady state, where the flag `initial` is 0, takes the shape of rest instead of q = 0.",
    )
    nominal_rate: Scalar = parameter(
        "nominal value of der(q) over that of q",
        unit="1/s",
        default=1,
        positive=True,
        doc="A larger one, such as the rate of the slowest vibrations, lets the error test follow displacements "
        "rather than the velocities of ringing at high frequency.",
    )

    check_range: bool = structural(
        "whether a run warns where the beam model is not valid",
        default=True,
        choices=(True, False),
        doc="False suppresses the warning that slopes or axial forces are too large for the frames of the beam.",
    )
    adaptive: bool = structural(
        "whether accuracy chooses the number of elements",
        default=False,
        choices=(True, False),
        doc="simulate(accuracy=...) then chooses it, and the number of volumes as well.",
    )
    axial: str = effect(
        "stretch",
        default="dynamic",
        choices=("dynamic", "quasi_static", "none"),
        doc="dynamic: with its vibrations; quasi_static: it follows the axial force at once, without inertia of its own.",
    )
    bending: bool = effect("bending in the xy plane", default=True, doc="False leaves a bar that stretches only.")
    rotary_inertia: bool = effect(
        "inertia of the sections against rotation", default=False, doc="It is rho J per length."
    )
    centrifugal: bool = effect(
        "centrifugal forces of the deformation",
        default=True,
        doc="They act on the deformation and because of it, with the square of the angular velocity; those of the straight "
        "beam always act.",
    )
    coriolis: bool = effect(
        "Coriolis forces of the rates of deformation",
        default=True,
        doc="They go with the product of angular velocity and rate of deformation.",
    )
    geometric_stiffness: bool = effect(
        "second-order stiffness by axial forces",
        default=False,
        doc="It is the shortening of the axis by its slope, by which axial forces stiffen the beam or let it buckle.",
    )
    damping: bool = effect("damping by alpha and beta", default=True)
    weight: bool = effect("weight", default=True)

    middle_r_0: ClassVar[Any]

    @property
    def frames(self) -> list[Any]:
        """The flexible beams that it consists of, each in a frame of its own."""
        return [self]

    def validity(self):
        if self.bending and self.check_range:
            yield from beam_range(self, self.frames)

    def shapes(self):
        """A tube along the deformed axis."""
        yield tube(self, self.frames)

    @observed
    def middle_deflection(self):
        """Transverse distance of the material middle point from the chord, positive along y of frame_a, in m."""
        a = self.frame_a
        chord = resolve2(a.R, self.frame_b.r_0 - a.r_0)
        middle = resolve2(a.R, self.middle_r_0 - a.r_0)
        return (chord[0] * middle[1] - chord[1] * middle[0]) / sqrt(chord @ chord)
