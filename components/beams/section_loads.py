"""Section forces and moments of a beam, for results."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from acausal import as_expr, cross
from components.orientation import planar_matrix


def section_loads(beam: Any) -> list[tuple[Any, Any]]:
    """Return section force in N and moment in N.m on the side of frame_a at every node, resolved in the reference frame.

    They equal the tip load minus the inertia and damping forces beyond the node. The damping forces of alpha act on the
    velocities in the reference frame, with reactions at the points that guide this frame: the root, or, for the chord, both
    ends across it.

    Parameters
    ----------
    beam : FlexibleBeam
        The beam.
    """
    motion, ref, b = beam._motion(), beam.ref, beam.frame_b
    (U, Ud, Udd), inertia, sections = motion, beam._inertia(motion), beam._sections(motion)
    alpha, a = beam.alpha if beam.damping else 0.0, beam._acceleration(inertia)
    R_b, r_b = planar_matrix(beam._strain.angle(U[-1])), beam._end(U)
    force = R_b.T @ b.f
    if beam.reference == "pinned":
        _, spin = inertia.deformation_momentum()
        force += as_expr((0.0, alpha * spin / r_b[0], 0.0))
    moment = R_b.T @ b.t + cross(r_b, force)
    loads = []
    for k in range(beam.elements, -1, -1):
        at = as_expr((k * beam._l + U[3 * k], U[3 * k + 1], 0.0))
        loads.append((force, moment - cross(at, force)))
        if k:
            nodes, part = slice(3 * k - 3, 3 * k + 3), inertia.element(k - 1)
            own, about, _ = part.forces(a, ref.z, ref.R.w)
            drag, turning = part.deformation_momentum()
            turned = replace(sections, elements=1, I=sections.I / beam.elements, Ud=Ud[nodes], Udd=Udd[nodes])
            force = force - own - alpha * drag
            moment = moment - about - turned.moment(ref.z, ref.R.w) - as_expr((0.0, 0.0, alpha * turning))
    return loads[::-1]
