"""Beam: base of all beam formulations."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import Scalar, effect, observed, parameter, sqrt, structural
from components.beams.range import beam_range
from components.beams.tube import tube
from components.frame import TwoFrames
from components.orientation import resolve2


class Beam(TwoFrames):
    """Base of straight beams along x of frame_a with bending in the xy plane."""

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
        doc="Enters the inertia about the beam axis only; J if not given.",
    )
    torsional_inertia: Scalar = parameter(
        "moment of inertia about the beam axis",
        unit="kg.m2",
        default=lambda s: s.rho * (s.J + s.J_y) * s.length,
        minimum=0,
        doc="rho (J + J_y) length if not given.",
    )
    reference: str = structural(
        "reference frame",
        default="tangent",
        choices=("tangent", "pinned"),
        doc="tangent: tangent at the root; pinned: chord from the first to the last point.",
    )
    alpha: Scalar = parameter(
        "mass-proportional damping",
        unit="1/s",
        default=0,
        minimum=0,
        doc="Rayleigh damping: D = alpha M + beta K, of velocities in the reference frame, which are small in short volumes.",
    )
    beta: Scalar = parameter(
        "stiffness-proportional damping",
        unit="s",
        default=0,
        minimum=0,
        doc="Rayleigh damping: D = alpha M + beta K.",
    )
    initial: str = structural(
        "initial state",
        default="undeformed",
        choices=("undeformed", "static", "free"),
        doc="undeformed: q = 0 and der(q) = 0; static: der(q) = 0 and der(der(q)) = 0; free: no condition. In a start "
        "at equilibrium, where the flag `initial` is 0, the static shape replaces q = 0.",
    )
    nominal_rate: Scalar = parameter(
        "nominal value of der(q) over the nominal value of q",
        unit="1/s",
        default=1,
        positive=True,
        doc="A larger value, such as the angular frequency of the slowest vibration, makes the error test control "
        "displacements rather than velocities of high-frequency vibrations.",
    )

    check_range: bool = structural(
        "whether a run warns outside the range of validity of the beam model",
        default=True,
        choices=(True, False),
        doc="False suppresses the warning about slopes or axial forces too large for the frames of the beam.",
    )
    adaptive: bool = structural(
        "whether accuracy determines the number of elements",
        default=False,
        choices=(True, False),
        doc="True lets simulate(accuracy=...) select the number of elements, or of volumes.",
    )
    axial: str = effect(
        "stretch",
        default="dynamic",
        choices=("dynamic", "quasi_static", "none"),
        doc="dynamic: with axial vibrations; quasi_static: proportional to the axial force, without inertia; none: inextensible.",
    )
    bending: bool = effect("bending in the xy plane", default=True, doc="False leaves axial deformation only.")
    rotary_inertia: bool = effect("rotary inertia of the sections", default=False, doc="rho J per unit length.")
    centrifugal: bool = effect(
        "centrifugal forces of the deformation",
        default=True,
        doc="The part of the centrifugal forces that depends on the deformation; that of the straight beam always acts.",
    )
    coriolis: bool = effect(
        "Coriolis forces of the rates of deformation",
        default=True,
        doc="Proportional to the product of angular velocity and rate of deformation.",
    )
    geometric_stiffness: bool = effect(
        "geometric (second-order) stiffness",
        default=False,
        doc="Shortening of the axis by its slope: axial tension stiffens the beam, compression softens or buckles it.",
    )
    damping: bool = effect("Rayleigh damping by alpha and beta", default=True)
    weight: bool = effect("weight", default=True)

    middle_r_0: ClassVar[Any]

    @property
    def frames(self) -> list[Any]:
        """The flexible beams of this beam, each with its own floating frame."""
        return [self]

    def validity(self):
        if self.bending and self.check_range:
            yield from beam_range(self, self.frames)

    def shapes(self):
        """A tube along the deformed axis."""
        yield tube(self, self.frames)

    @observed
    def middle_deflection(self):
        """Transverse distance of the material midpoint from the chord, positive along y of frame_a, in m."""
        a = self.frame_a
        chord = resolve2(a.R, self.frame_b.r_0 - a.r_0)
        middle = resolve2(a.R, self.middle_r_0 - a.r_0)
        return (chord[0] * middle[1] - chord[1] * middle[0]) / sqrt(chord @ chord)
