"""Shape of a beam: a tube along the deformed axis."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from acausal import as_expr, dot, geometry, in_loop, rooted, sqrt
from components.beams.beam_motion import BeamMotion
from components.frame import pose
from components.orientation import resolve1


def tube(beam: Any, frames: list[Any]) -> geometry.Curve:
    """Return the deformed axis of a beam, with an elliptical section that has the beam's second moments of area.

    An ellipse with half-axes a, b has the second moment A b^2 / 4 for the area A of the beam, which differs from pi a b.
    The undeformed reference is attached to the end section closer to the root; in closed loops, where the machine holds both
    ends, to the chord.

    Parameters
    ----------
    beam : Beam
        The whole beam.
    frames : list of FlexibleBeam
        Its flexible beams, from frame_a to frame_b.
    """
    count = len(frames) * frames[0]._elements
    fixed, first = (beam.frame_a, 0) if rooted(frames[0].ref, frames[0].frame_b) else (beam.frame_b, count)
    return geometry.Curve(
        points=beam.node_r_0,
        tangents=_of_nodes(frames, _tangents),
        section=(2 * sqrt(beam.J_y / beam.A), 2 * sqrt(beam.J / beam.A)),
        up=resolve1(beam.frame_a.R, as_expr((0.0, 1.0, 0.0))),
        rest=None if in_loop(beam) else pose(fixed),
        rest_points=as_expr([[(k - first) * beam.length / count, 0.0, 0.0] for k in range(count + 1)]),
        values=(
            geometry.Values("bending moment", "N.m", lambda: _of_nodes(frames, _moments)),
            geometry.Values("axial force", "N", lambda: _of_nodes(frames, _axial_forces)),
            geometry.Values("deflection", "m", beam.node_deflection[:, 1]),
        ),
    )


def _of_nodes(frames: list[Any], entries: Callable[[Any], list[Any]]) -> Any:
    """Entries of all nodes; a shared node belongs to the preceding frame."""
    return as_expr([entry for k, frame in enumerate(frames) for entry in entries(frame)[k > 0 :]])


def _tangents(frame: Any) -> list[Any]:
    """Tangent d/dxi of the deformed axis at every node, resolved in the world, in m."""
    return [resolve1(frame.ref.R, tangent) for tangent in BeamMotion(frame).tangents()]


def _moments(frame: Any) -> list[Any]:
    moment = frame.node_moment
    return [moment[k, 2] for k in range(frame._elements + 1)]


def _axial_forces(frame: Any) -> list[Any]:
    """Axial force in each section, in N, positive in tension."""
    force, motion = frame.node_force, BeamMotion(frame)
    return [dot(motion.rotation(k).axis(), force[k]) for k in range(frame._elements + 1)]
