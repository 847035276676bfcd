"""Force and moment in the sections of a beam, for results."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from acausal import as_expr, cross
from components.orientation import planar_matrix


def section_loads(beam: Any) -> list[tuple[Any, Any]]:
    """Return force in N and moment in N.m on the part towards frame_a at every node, resolved in the reference frame.

    They are what is applied at the tip, less inertia forces and drag beyond the node. The drag by alpha acts on what moves
    in the reference frame, and against it on the points that guide that frame: at the root, or, where it is the chord,
    across it at both ends.

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
        _, spin = inertia.deforming()
        force += as_expr((0.0, alpha * spin / r_b[0], 0.0))
    moment = R_b.T @ b.t + cross(r_b, force)
    loads = []
    for k in range(beam.elements, -1, -1):
        at = as_expr((k * beam._l + U[3 * k], U[3 * k + 1], 0.0))
        loads.append((force, moment - cross(at, force)))
        if k:
            nodes, part = slice(3 * k - 3, 3 * k + 3), inertia.element(k - 1)
            own, about, _ = part.forces(a, ref.z, ref.R.w)
            drag, turning = part.deforming()
            turned = replace(sections, elements=1, I=sections.I / beam.elements, Ud=Ud[nodes], Udd=Udd[nodes])
            force = force - own - alpha * drag
            moment = moment - about - turned.moment(ref.z, ref.R.w) - as_expr((0.0, 0.0, alpha * turning))
    return loads[::-1]
