"""Range of validity of beam models: neglected forces of the frames, compared with the deflection.

With the slopes s = (v', w') of the unit tangent at arc length x, the curvatures k = (v'', w''), k~ = (w'', -v''), the
stiffness K and the axial force N, the energy of an inextensible beam is

    V = int k K k / 2 + (s . k) (s . K k) (1 + s^2 + ...) / 2 + N (s^2 / 2 + s^4 / 8 + s^6 / 16 + ...)
        + phi k~ K k + GJ_t (phi' + k~ . s / 2)^2 / 2 + ... dx,

and end moments work on angles such as v' + v'^3 / 6 + 3 v'^5 / 40 + ... A linear frame includes the squares alone, a
second-order frame all terms up to the fourth power. The derivatives g of the first neglected terms are the neglected forces.
They bend a frame with the bending stiffness K by K^-1 g, which is the first-order error for any boundary conditions, because
whole frames are balanced in their deflected shapes. Two limitations: the loads must vary slowly compared with the first
natural frequency, and the phase error of free vibrations grows with time.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal import expect, sqrt
from components.beams.beam_chain import BeamChain
from components.beams.neglected import errors
from components.beams.rigid_range import rigid_range

SHARE = 0.01  # error over deflection that gives a warning
SMALLEST = 2e-4  # deflection over length: errors of much smaller deflections are not reported


def beam_range(beam: Any, frames: list[Any]) -> Iterator[Any]:
    """Expect small errors of a beam made of the flexible beams `frames`.

    Parameters
    ----------
    beam : Beam
        The whole beam.
    frames : list of FlexibleBeam
        Its flexible beams, from frame_a to frame_b.
    """
    if beam.bending == "none" or len({frame._elements for frame in frames}) > 1:
        return
    chain = BeamChain(beam, frames)
    yield from rigid_range(chain)
    shape, found = chain.shape, errors(chain)
    error = found.axial.plus(found.slope).plus(found.twist)
    size, whole = chain.deflection(error) * chain.amplification(error), chain.deflection(shape)
    whole = sqrt(whole * whole + (SMALLEST * beam.length) * (SMALLEST * beam.length))
    more = "more volumes" if len(frames) > 1 else "SubstructuredBeam(volumes=...)"
    if beam.geometric_stiffness:
        text = (
            f"the slope is too large for second-order frames: the error is not small against the deflection; use {more}"
        )
        yield expect(size, whole, SHARE, text)
        return
    # Report the largest of the errors, which may cancel each other.
    axial, slope, twist = (chain.deflection(e) for e in found)
    text = (
        "linear frames neglect the effect of the axial force on bending (rotation and tension stiffen, compression softens): "
        f"the error is not small against the deflection; use geometric_stiffness=True or {more}"
    )
    yield expect(size * _leads(axial, slope) * _leads(axial, twist), whole, SHARE, text)
    text = (
        "the slope is too large for linear frames: the error is not small against the deflection; use "
        f"geometric_stiffness=True and, beyond 20 degrees, {more}"
    )
    yield expect(size * _leads(slope, axial) * _leads(slope, twist), whole, SHARE, text)
    if beam.torsion and beam.bending == "both":
        text = (
            "linear frames neglect that moments turn with the twist of the sections: the error is not small against the "
            f"deflection; use geometric_stiffness=True or {more}"
        )
        yield expect(size * _leads(twist, axial) * _leads(twist, slope), whole, SHARE, text)


def _leads(a: Any, b: Any) -> Any:
    """Return 1 if a > b, else 0; not a number if they are equal, which counts as 0."""
    return (1 + (a - b) / sqrt((a - b) * (a - b))) / 2
