"""Draw a frame of a scene as coloured polygons, sorted from the farthest to the nearest."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.camera import Camera, horizontal
from acausal.animation.colours import ARROWS
from acausal.animation.looks import LOOKS
from acausal.animation.scene import Scene, corners, in_world
from acausal.animation.tube import PIECES, half_widths, sections
from acausal.animation.turned import faces, normal_to, rings

GRID = "#d9dee6"
ARROW = 0.25  # length of the longest arrow, relative to the size of the scene
SEEN = 0.02  # shortest arrow that counts, relative to the longest
LINES = 8  # grid spacings within the diagonal of the scene
SIDES, TURNS = 32, 9  # corners of a circle, turns of a coil
TRAIL = 0.0018  # half the width of a trail, relative to the size of the scene


@dataclass(frozen=True)
class Polygon:
    """Corners (n, 2) to the right and upwards in m, coordinate towards the viewer in m, and colour (3,)."""

    corners: np.ndarray
    depth: float
    colour: np.ndarray


Pieces = Iterator[Polygon]


class Drawing:
    """Drawing of the frames of a scene.

    Parameters
    ----------
    scene : Scene
        Scene with default sizes filled in.
    view : Camera
        Camera.
    colours : callable, optional
        Maps values along a curve, shape (n,), to colours (n, 3).
    by : str
        Name of the values to colour curves by.
    deformation : float
        Scale of deformations.
    """

    def __init__(
        self,
        scene: Scene,
        view: Camera,
        colours: Callable[[np.ndarray], np.ndarray] | None = None,
        by: str = "",
        deformation: float = 1.0,
    ) -> None:
        self.scene, self.view, self.colours, self.by = scene, view, colours, by
        self.deformation = deformation
        self.longest = {kind: self._longest(kind) for kind in ARROWS}

    def _longest(self, kind: str) -> float:
        lengths = [
            float(np.max(np.linalg.norm(one.shape.vector, axis=1)))
            for one in self.scene.shapes
            if isinstance(one.shape, g.Arrow) and one.shape.quantity == kind
        ]
        return max(lengths, default=0.0)

    def shows(self, quantity: str) -> bool:
        """Return whether an arrow of a quantity is seen, other than along the view."""
        seen = [
            float(np.max(np.linalg.norm(self.view.project(one.shape.vector)[:, :2], axis=1)))
            for one in self.scene.shapes
            if isinstance(one.shape, g.Arrow) and one.shape.quantity == quantity
        ]
        return max(seen, default=0.0) > SEEN * self.longest[quantity]

    def frame(self, k: int) -> list[Polygon]:
        """Return the polygons of frame k, without the ground."""
        found = [
            p
            for one in self.scene.shapes
            for p in DRAW[type(one.shape)](self, one.shape, k, rgb(one.colour) if one.colour else None)
        ]
        return sorted(found, key=lambda polygon: polygon.depth)

    def grid(self) -> Pieces:
        """Yield the lines of the ground, at the lowest level of the scene if that is below the origin; none without ground."""
        scene = self.scene
        if not any(isinstance(one.shape, g.Ground) for one in scene.shapes):
            return
        low = min(0.0, float(np.min(corners(scene.low, scene.high) @ scene.up)))
        first = horizontal(scene.up)
        sides = np.array([first, np.cross(scene.up, first)])
        middle = (scene.low + scene.high) / 2
        middle = middle - (middle @ scene.up - low) * scene.up
        step = float(np.linalg.norm(scene.high - scene.low)) / LINES
        for k in range(-LINES // 2, LINES // 2 + 1):
            for along, across in (sides, sides[::-1]):
                end = middle + k * step * across
                ends = np.array([end - LINES / 2 * step * along, end + LINES / 2 * step * along])
                yield from self.strip(ends, 0.0012 * scene.size, rgb(GRID))

    def strip(self, points: np.ndarray, radius: Any, colour: np.ndarray) -> Pieces:
        """Yield a line through points of the world: `radius` is half its width, or (n,); `colour` (3,), or (n - 1, 3)."""
        seen = self.view.project(points)
        steps = np.diff(seen, axis=0)
        length = np.linalg.norm(steps[:, :2], axis=1)
        colours, radii = np.broadcast_to(colour, (len(steps), 3)), np.broadcast_to(radius, len(seen))
        parts = zip(seen[:-1], seen[1:], radii[:-1], radii[1:], steps, length, colours, strict=True)
        for a, b, r_a, r_b, step, l, c in parts:
            if l > 0:
                across = np.array([-step[1], step[0]]) / l
                sides = [a[:2] + r_a * across, b[:2] + r_b * across, b[:2] - r_b * across, a[:2] - r_a * across]
                yield Polygon(np.array(sides), (a[2] + b[2]) / 2, c)

    def tube(self, points: np.ndarray, radius: Any, colour: np.ndarray) -> Pieces:
        """Yield a strip with a lighter middle and round ends."""
        radius = np.broadcast_to(radius, len(points))
        yield from (
            self.disc(points[0], radius[0], colour.reshape(-1, 3)[0]),
            self.disc(points[-1], radius[-1], colour.reshape(-1, 3)[-1]),
        )
        nearer = points + radius[:, None] * self.view.axes[2]  # of the surface, which is what hides or is hidden
        yield from self.strip(nearer, radius, colour)
        yield from self.strip(nearer, radius / 2, 0.75 * colour + 0.25)

    def disc(self, center: np.ndarray, radius: float, colour: np.ndarray) -> Polygon:
        """Return a circle that faces the viewer."""
        seen = self.view.project(center)
        return Polygon(seen[:2] + radius * _circle(), float(seen[2]), colour)

    def faces(self, points: np.ndarray, faces: Any, colour: np.ndarray) -> Pieces:
        """Yield the visible faces of a solid: (n, m) indices of points of the world, anticlockwise from outside."""
        seen = self.view.project(points)
        at = points[faces]
        normals = np.cross(at[:, 1] - at[:, 0], at[:, 2] - at[:, 0])
        size = np.linalg.norm(normals, axis=1)
        front = normals @ self.view.axes[2] > 0
        shades = self.view.shade(colour, normals / np.where(size > 0, size, 1)[:, None])
        for face, shade in zip(np.asarray(faces)[front], shades[front], strict=True):
            yield Polygon(seen[face, :2], float(np.mean(seen[face, 2])), shade)

    def turned(self, ends: np.ndarray, side: np.ndarray, style: str, diameter: float, colour: np.ndarray) -> Pieces:
        """Yield the layers of a solid of revolution between two points of the world."""
        for layer in LOOKS[style]:
            found = list(rings(layer, ends[0], ends[1], side, diameter))
            own = colour if layer.colour is None else rgb(layer.colour)
            yield from self.faces(np.concatenate(found), faces(len(found), len(found[0])), own)

    def box(self, s: g.Box, k: int, colour: np.ndarray) -> Pieces:
        """Yield the faces of a box."""
        half = np.asarray(s.size) / 2
        local = s.center + corners(-half, half) @ s.axes
        hand = np.linalg.det(s.axes) > 0
        faces = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
        yield from self.faces(_at(s.pose, local, k), faces if hand else faces[:, ::-1], colour)

    def cylinder(self, s: g.Cylinder, k: int, colour: np.ndarray) -> Pieces:
        """Yield the layers of a cylinder."""
        start, end = np.asarray(s.start), np.asarray(s.end)
        side = normal_to(end - start) @ s.pose.T[k]
        yield from self.turned(_at(s.pose, np.array([start, end]), k), side, s.style, s.diameter, colour)

    def sphere(self, s: g.Sphere, k: int, colour: np.ndarray) -> Pieces:
        """Yield a disc with a highlight."""
        (center,) = _at(s.pose, np.array([s.center]), k)
        radius = s.diameter / 2
        yield self.disc(center, radius, 0.8 * colour)
        spot = center + radius * self.view.axes[2] + 0.25 * radius * (self.view.axes[1] - self.view.axes[0])
        yield self.disc(spot, radius / 2, 0.7 * colour + 0.3)

    def axle(self, s: g.Axle, k: int, colour: np.ndarray) -> Pieces:
        """Yield the layers of a part of a joint."""
        half = np.asarray(s.axis) / np.linalg.norm(s.axis) * s.length / 2
        side = normal_to(half) @ s.pose.T[k]
        yield from self.turned(_at(s.pose, np.array([-half, half]), k), side, s.style, s.diameter, colour)

    def span(self, s: g.Span, k: int, colour: np.ndarray) -> Pieces:
        """Yield a rod or another straight body, or a coil."""
        a, b = s.start[k], s.end[k]
        if s.style != "coil":
            yield from self.turned(np.array([a, b]), normal_to(b - a), s.style, s.diameter, colour)
            return
        across = np.cross(self.view.axes[2], b - a)
        across = s.diameter / 2 * across / (np.linalg.norm(across) or 1)
        zigzag = np.concatenate([[0, 0], np.tile([1, -1], TURNS), [0, 0]])
        fraction = np.concatenate([[0], np.linspace(0.1, 0.9, 2 * TURNS + 2), [1]])
        yield from self.tube(a + fraction[:, None] * (b - a) + zigzag[:, None] * across, s.diameter / 12, colour)

    def trail(self, s: g.Trail, k: int, colour: np.ndarray) -> Pieces:
        """Yield the path up to the frame."""
        yield from self.strip(s.at[: k + 1], TRAIL * self.scene.size, colour)

    def arrow(self, s: g.Arrow, k: int, colour: np.ndarray) -> Pieces:
        """Yield shaft and head of an arrow, scaled by the longest arrow of its quantity."""
        longest = self.longest[s.quantity]
        vector = s.vector[k] * (ARROW * self.scene.size / longest if longest else 0)
        at, tip = self.view.project(np.array([s.at[k], s.at[k] + vector]))
        shaft = (tip - at)[:2]
        length, head = float(np.linalg.norm(shaft)), 0.03 * self.scene.size
        if length > 0:
            along = shaft / length
            across = np.array([-along[1], along[0]])
            neck = max(length - head, 0) * along + at[:2]
            near = max(at[2], tip[2]) + self.scene.size
            wide = head / 8 * across
            yield Polygon(np.array([at[:2] + wide, neck + wide, neck - wide, at[:2] - wide]), near, colour)
            yield Polygon(np.array([neck + head / 3 * across, tip[:2], neck - head / 3 * across]), near, colour)

    def curve(self, s: g.Curve, k: int, colour: np.ndarray) -> Pieces:
        """Yield a tube along the cubics between the points, as wide as its sections look."""
        points, half_axes = sections(s, k, self.deformation)
        steps = np.gradient(self.view.project(points)[:, :2], axis=0)
        length = np.linalg.norm(steps, axis=1)
        across = np.stack([-steps[:, 1], steps[:, 0]], axis=1) / np.where(length > 0, length, 1)[:, None]
        values = next((v.entries[k] for v in s.values if v.name == self.by), None)
        if self.colours and values is not None:
            place = (np.arange(len(points) - 1) + 0.5) / PIECES
            colour = self.colours(np.interp(place, np.arange(len(values)), values))
        yield from self.tube(points, half_widths(s.profile, half_axes, across @ self.view.axes[:2]), colour)

    def mesh(self, s: g.Mesh, k: int, colour: np.ndarray) -> Pieces:
        """Yield the deformed triangles of a mesh."""
        vertices = s.vertices
        if s.q is not None and s.modes is not None:
            vertices = vertices + self.deformation * np.tensordot(s.q[k], s.modes, 1)
        yield from self.faces(_at(s.pose, vertices, k), s.triangles, colour)


DRAW: dict[type, Callable[[Drawing, Any, int, Any], Pieces]] = {
    g.Ground: lambda *_: iter(()),
    g.Box: Drawing.box,
    g.Cylinder: Drawing.cylinder,
    g.Sphere: Drawing.sphere,
    g.Axle: Drawing.axle,
    g.Span: Drawing.span,
    g.Trail: Drawing.trail,
    g.Arrow: Drawing.arrow,
    g.Curve: Drawing.curve,
    g.Mesh: Drawing.mesh,
}


def rgb(text: str) -> np.ndarray:
    """Return red, green and blue of a colour "#rrggbb", 0 to 1."""
    return np.array([int(text[k : k + 2], 16) / 255 for k in (1, 3, 5)])


def _circle() -> np.ndarray:
    angle = 2 * np.pi * np.arange(SIDES) / SIDES
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _at(pose: g.Pose, points: Any, k: int) -> np.ndarray:
    return in_world(g.Pose(pose.r[k : k + 1], pose.T[k : k + 1]), points)[0]
