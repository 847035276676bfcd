"""Where a beam is right: what its frames neglect, against its deflection.

In every frame a beam is linear, or of second order (geometric_stiffness). With v(x) the deflection in a frame, N the axial
force, and B = int EJ v''^2, first-order perturbation of v by a neglected force of work W = int f v gives dv / v = W / K,
where K is the work of all restoring forces in the shape v: K = B - C + H, with C = w^2 int rho A v^2 the centrifugal forces
across the beam and H = int N s^2 what the slopes s of the frames themselves take up.

- Axial force on the slope, which a linear frame leaves out: W = int N v'^2. Turning stiffens (N > 0), compression softens:
  W / K is about P / P_crit, and the ratio of squared speed and frequency.
- Slope. The tip of a cantilever under a transverse load deflects by P L^3 / 3 EJ (1 - 4/35 (P L^2 / EJ)^2 ...) (expansion
  of the elastica), and a linear one has a mean of v'^2 of 2/15 (P L^2 / EJ)^2: an error of 6/7 of that mean.
- A second-order frame errs by 0.58 times the mean of v'^4 (measured against the elastica from 7 to 45 degrees).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal import as_expr, expect, sqrt
from components.orientation import planar_matrix

SHARE = 0.01
SEEN = 2e-4  # of the length: errors of deflections much smaller than that are not seen


def beam_range(beam: Any, frames: list[Any]) -> Iterator[Any]:
    """Expect of a beam that consists of flexible beams `frames` that what these neglect is small.

    Parameters
    ----------
    beam : Beam
        The whole.
    frames : list of FlexibleBeam
        Its frames, from frame_a to frame_b.
    """
    stretch, slopes, steep, bent, held, away, moved = (as_expr(0.0) for _ in range(7))
    for frame in frames:
        strain, l, U = frame._strain, frame._l, frame._motion()[0]
        forces = _axial_forces(frame, U)
        for j, (e, N) in enumerate(zip(strain._bends(U), forces, strict=True)):
            slope = strain._slopes(e, e)  # integral of v'^2 in m
            stretch += N * slope
            slopes += slope
            steep += slope * slope / l
            bent += frame.E * frame.J / l**3 * (e.q * e.q + 3 * e.r * e.r)
            y_1, y_2 = _aside(beam, frames, frame, U, j)
            away += l * (y_1 * y_1 + y_1 * y_2 + y_2 * y_2) / 3
            moved += (y_1 * y_1 + y_2 * y_2) / (2 * frame.elements * len(frames))
            if len(frames) > 1:
                held += N * (y_2 - y_1) * (y_2 - y_1) / l
    w, size = frames[0].ref.R.w[2], sqrt(moved)
    restoring = bent + held - w * w * beam.rho * beam.A * away
    whole = sqrt(moved + (SEEN * beam.length) * (SEEN * beam.length))
    more = "more volumes" if len(frames) > 1 else "SubstructuredBeam(volumes=...)"
    if beam.geometric_stiffness:
        text = f"it slopes too much for frames of second order, whose error is not small against its deflection; take {more}"
        yield expect(0.58 * size * steep / beam.length, whole, SHARE, text)
        return
    text = (
        "its linear frames leave out what the axial force does to their bending (rotation and tension stiffen, compression "
        f"softens), which is not small against its deflection; take geometric_stiffness=True or {more}"
    )
    yield expect(size * stretch / restoring, whole, SHARE, text)
    text = (
        "it slopes too much for linear frames, whose error is not small against its deflection; take "
        f"geometric_stiffness=True and, beyond 20 degrees, {more}"
    )
    yield expect(6 / 7 * size * slopes / beam.length, whole, SHARE, text)


def _axial_forces(frame: Any, U: Any) -> list[Any]:
    """Axial force of every element in N, between those at the ends of the frame."""
    root, tip = as_expr(frame.frame_a.f), planar_matrix(frame._strain.angle(U[-1])).T @ frame.frame_b.f
    if frame.reference == "pinned":
        root = planar_matrix(frame._strain.angle(U[2])).T @ root
    N_a, N_b, n = -root[0], tip[0], frame.elements
    return [N_a + (N_b - N_a) * ((j + 0.5) / n) for j in range(n)]


def _aside(beam: Any, frames: list[Any], frame: Any, U: Any, j: int) -> tuple[Any, Any]:
    """Distances of the ends of an element from the axis of the beam's first frame, in m."""
    v = U[3 * j + 1], U[3 * j + 4]
    if frame is frames[0]:
        return v
    first, ref = frames[0].ref, frame.ref
    T = ref.R.T @ first.R.T.T
    origin = (first.R.T @ (ref.r_0 - first.r_0))[1]
    u = j * frame._l + U[3 * j], (j + 1) * frame._l + U[3 * j + 3]
    return tuple(as_expr((origin + T[0, 1] * x + T[1, 1] * y).sx) for x, y in zip(u, v, strict=True))  # type: ignore
