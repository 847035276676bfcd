"""Beam: base of all beam formulations."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import DeclarationError, Scalar, effect, observed, parameter, parts, sqrt, structural
from components.beams.load import Load
from components.beams.range import beam_range
from components.beams.section_values import EQUIVALENT, of_section
from components.beams.sections import Section
from components.beams.shape import tube
from components.frame import Frame, TwoFrames
from components.orientation import resolve2

ROUNDING = 1e-9  # of the place of a node, in elements
FINEST = 100  # elements, or volumes, for a node at every inner frame


class Beam(TwoFrames):
    """Base of straight beams along x of frame_a."""

    length: Scalar = parameter("length", unit="m", positive=True)
    section: Any = structural(
        "cross-section",
        default=None,
        doc="Rectangle, Circle, Tube or Section, or a function of x / length that returns one, for taper and pre-twist; "
        "without it, A and J.",
    )
    E: Scalar = parameter(
        "modulus of elasticity", unit="Pa", default=lambda s: of_section(s, "E"), positive=True, doc=EQUIVALENT
    )
    nu: Scalar = parameter("Poisson's ratio", unit="1", default=0.3)
    G: Scalar = parameter(
        "shear modulus",
        unit="Pa",
        default=lambda s: of_section(s, "G"),
        positive=True,
        doc="E / (2 (1 + nu)) if not given.",
    )
    rho: Scalar = parameter(
        "density", unit="kg/m3", default=lambda s: of_section(s, "rho"), positive=True, doc=EQUIVALENT
    )
    A: Scalar = parameter(
        "area, of the section if one is given", unit="m2", default=lambda s: of_section(s, "A"), positive=True
    )
    J: Scalar = parameter(
        "second moment of area about z, for bending in xy, of the section if one is given",
        unit="m4",
        default=lambda s: of_section(s, "J"),
        positive=True,
    )
    J_y: Scalar = parameter(
        "second moment of area about y, for bending in xz",
        unit="m4",
        default=lambda s: of_section(s, "J_y"),
        positive=True,
        doc="J if not given, without a section.",
    )
    J_t: Scalar = parameter(
        "torsion constant",
        unit="m4",
        default=lambda s: of_section(s, "J_t"),
        positive=True,
        doc="J + J_y if not given, without a section: exact for circles and tubes only.",
    )
    torsional_inertia: Scalar = parameter(
        "moment of inertia about the beam axis",
        unit="kg.m2",
        default=lambda s: of_section(s, "torsional_inertia"),
        minimum=0,
        doc="Spread evenly; rho (J + J_y) length if not given.",
    )
    distributed: Any = structural(
        "distributed loads",
        default=(),
        doc="A Load, or several: forces and moments per length, whose power is supplied.",
    )
    frames_at: Any = structural(
        "places x / length of inner frames",
        default=(),
        doc="Ports frames_inner[0], ..., fixed to the section there, which turns with the beam. At nodes: equal elements, or "
        "volumes, are as many as have nodes there, at least the given number.",
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
        doc="dynamic: with axial vibrations; quasi_static: proportional to the axial force, without inertia (in a closed loop "
        "only node_r_0 shows it); none: inextensible.",
    )
    bending: str = effect(
        "bending",
        default="both",
        choices=("both", "xy", "xz", "none"),
        doc="both: in both planes; xy, xz: in one plane, rigid across it; none: rigid in bending.",
    )
    torsion: bool = effect("torsion", default=True, doc="Saint-Venant torsion about the axis; False: rigid in torsion.")
    shear: bool = effect("shear", default=False, doc="Timoshenko's shear deformation, for stocky beams.")
    rotary_inertia: bool = effect(
        "rotary inertia of the sections",
        default=False,
        doc="Sections as rigid discs, with gyroscopic moments; rho J per unit length.",
    )
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
        doc="Shortening of the axis by its slope, and moments that turn with it: tension "
        "stiffens the beam, compression softens or buckles it.",
    )
    damping: bool = effect("Rayleigh damping by alpha and beta", default=True)
    weight: bool = effect("weight", default=True)

    middle_r_0: ClassVar[Any]

    @property
    def frames(self) -> list[Any]:
        """The flexible beams of this beam, each with its own floating frame."""
        return [self]

    @parts
    def frames_inner(self):
        """Frames at `frames_at`."""
        return [Frame() for _ in self.frames_at]

    def _with_nodes(self, least: int, each: int = 1) -> int:
        """Return how many parts of `each` elements have nodes at `frames_at`, from `least` on.

        Raises
        ------
        DeclarationError
            A place is outside the beam, or needs too many elements.
        """
        for x in self.frames_at:
            if not 0 < x < 1:
                raise DeclarationError(f"frames_at contains {x!r}, which is not between 0 and 1.")
        for n in range(least, max(least, FINEST) + 1):
            if all(abs(x * n * each - round(x * n * each)) <= ROUNDING * n * each for x in self.frames_at):
                return n
        raise DeclarationError(
            f"frames_at is {self.frames_at!r}, but meshes of up to {FINEST} elements have no nodes at all these places: "
            "round them."
        )

    @property
    def loads(self) -> tuple[Load, ...]:
        """The distributed loads."""
        return (self.distributed,) if isinstance(self.distributed, Load) else tuple(self.distributed)

    def check(self) -> None:
        """Refuse what cannot be.

        Raises
        ------
        DeclarationError
            Torsion without inertia, shear without stiffness, or a load of another class.
        """
        if self.torsion and self.torsional_inertia.sx.is_zero():
            raise DeclarationError("torsion=True needs torsional_inertia > 0: give it, or torsion=False.")
        if self.shear and isinstance(self.section, Section):
            self.section.with_units().shear()
        given = self.distributed if isinstance(self.distributed, list | tuple) else (self.distributed,)
        if wrong := [load for load in given if not isinstance(load, Load)]:
            raise DeclarationError(f"distributed takes a Load, or several, not {wrong[0]!r}.")

    def validity(self):
        if self.check_range:
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
