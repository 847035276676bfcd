"""Section forces and moments of a beam, for results."""

from __future__ import annotations

from typing import Any

from acausal import as_expr, cross
from components.beams.beam_motion import BeamMotion
from components.beams.distributed import resultant


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
    motion, ref, b = BeamMotion(beam), beam.ref, beam.frame_b
    U, inertia, sections = motion.coordinates[0], motion.inertia, motion.sections
    alpha, a = beam.alpha if beam.damping else 0.0, motion.acceleration()
    T_b, r_b = motion.rotation(-1).matrix(), motion.place(motion.n, U)
    force = T_b.T @ b.f
    if beam.reference == "pinned":
        spin = inertia.deformation_momentum()[1] + sections.momentum()[0]
        force += alpha / r_b[0] * as_expr((0.0, spin[2], -spin[1]))
    moment = T_b.T @ b.t + cross(r_b, force)
    if beam.reference == "pinned":  # both ends guide the chord about its axis
        moment += alpha / 2 * as_expr((spin[0], 0.0, 0.0))
    loads = []
    for k in range(beam._elements, -1, -1):
        at = motion.place(k, U)
        for node, frame in motion.inner_frames():
            if node == k:
                f, t = motion.inner_load(node, frame)
                force, moment = force + f, moment + t + cross(at, f)
        loads.append((force, moment - cross(at, force)))
        if k:
            part = inertia.element(k - 1)
            own, about, _ = part.forces(a, ref.z, ref.R.w)
            turning, _ = sections.element(k - 1).forces(ref.z, ref.R.w)
            drag, spin = part.deformation_momentum()
            spin += sections.element(k - 1).momentum()[0]
            pushed, turned = resultant([load for load in motion.distributed if load.j == k - 1])
            force = force - own - alpha * drag + pushed
            moment = moment - about - turning - alpha * spin + turned
    return loads[::-1]
