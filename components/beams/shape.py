"""Shape of a beam: a tube along the deformed axis."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from acausal import as_expr, cos, geometry, in_loop, rooted, sin
from components.beams.beam_motion import BeamMotion
from components.beams.section_values import given_at, section_at
from components.frame import pose
from components.orientation import resolve1


def tube(beam: Any, frames: list[Any]) -> geometry.Curve:
    """Return the deformed axis of a beam with its section, which turns with the beam.

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
    drawn = [given_at(beam, k / count) or section_at(beam, k / count) for k in range(count + 1)]
    half_axes = [section.half_axes for section in drawn]
    return geometry.Curve(
        points=beam.node_r_0,
        tangents=_of_nodes(frames, _tangents),
        section=as_expr(half_axes if callable(beam.section) else half_axes[0]),
        up=_of_nodes(frames, _z_axes),
        profile=drawn[0].profile,
        rest=None if in_loop(beam) else pose(fixed),
        rest_points=as_expr([[(k - first) * beam.length / count, 0.0, 0.0] for k in range(count + 1)]),
        values=(
            geometry.Values("bending moment", "N.m", lambda: _of_nodes(frames, _moments)[:, 2]),
            geometry.Values("bending moment y", "N.m", lambda: _of_nodes(frames, _moments)[:, 1]),
            geometry.Values("torque", "N.m", lambda: _of_nodes(frames, _moments)[:, 0]),
            geometry.Values("axial force", "N", lambda: _of_nodes(frames, _axial_forces)),
            geometry.Values("deflection", "m", beam.node_deflection[:, 1]),
            geometry.Values("deflection z", "m", beam.node_deflection[:, 2]),
        ),
    )


def _of_nodes(frames: list[Any], entries: Callable[[Any], list[Any]]) -> Any:
    """Entries of all nodes; a shared node belongs to the preceding frame."""
    return as_expr([entry for k, frame in enumerate(frames) for entry in entries(frame)[k > 0 :]])


def _tangents(frame: Any) -> list[Any]:
    """Tangent d/dxi of the deformed axis at every node, resolved in the world, in m."""
    return [resolve1(frame.ref.R, tangent) for tangent in BeamMotion(frame).tangents()]


def _z_axes(frame: Any) -> list[Any]:
    """Unit vector along z of the section at every node, resolved in the world."""
    motion, found = BeamMotion(frame), []
    for k in range(frame._elements + 1):
        angle = section_at(frame, k / frame._elements).angle
        z_axis = as_expr((0.0, -sin(angle), cos(angle)))
        found.append(resolve1(frame.ref.R, motion.rotation(k).matrix().T @ z_axis))
    return found


def _moments(frame: Any) -> list[Any]:
    """Torque and bending moments about y and z of the beam in each section, which turn with it, in N.m."""
    moment, motion = frame.node_moment, BeamMotion(frame)
    return [motion.rotation(k).matrix() @ moment[k] for k in range(frame._elements + 1)]


def _axial_forces(frame: Any) -> list[Any]:
    """Axial force in each section, in N, positive in tension."""
    force, motion = frame.node_force, BeamMotion(frame)
    return [(motion.rotation(k).matrix() @ force[k])[0] for k in range(frame._elements + 1)]
