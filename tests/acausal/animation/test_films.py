"""Films and stills: polygons where the shapes are, files as long as the motion."""

from __future__ import annotations

import io
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import acausal as ac
from acausal import Model, Scalar, geometry, output
from acausal.animation.camera import VIEWS, Camera, camera, standard
from acausal.animation.document import scenes
from acausal.animation.drawing import Drawing, Polygon
from acausal.animation.tube import PIECES, sections
from acausal.result.animated import AnimationOptions, run_of
from acausal.result.films import _speed

FRONT = Camera(np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1]]))


class Orbit(Model):
    """Every kind of shape in a frame that turns about the z axis and goes round."""

    angle: Scalar = output("angle", unit="rad")

    def equations(self):
        yield self.angle == ac.time

    def shapes(self):
        c, s = ac.cos(self.angle), ac.sin(self.angle)
        here = geometry.Pose((3 * c, 3 * s, 0), ac.as_expr([[c, s, 0], [-s, c, 0], [0, 0, 1]]))
        yield geometry.Ground()
        yield geometry.Box(here, (1, 0, 0), (2, 0.4, 0.2))
        yield geometry.Cylinder(here, (0, 0, 0), (0, 2, 0), 0.2)
        yield geometry.Sphere(here, (0, 0, 1), 0.5)
        yield geometry.Axle(here, (0, 0, 3))
        yield geometry.Span((0, 0, 0), here.r, "coil")
        yield geometry.Span((0, 0, 0), here.r, "rail")
        yield geometry.Arrow(here.r, (c, s, 0))
        yield geometry.Curve(
            ((0, 0, 0), (c, s, 0), (2 * c, 2 * s, 0)), values=(geometry.Values("load", "N", (0, c, s)),)
        )
        vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        triangles = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        yield geometry.Mesh(here, vertices, triangles, np.ones((1, 4, 3)), ac.as_expr([self.angle * 0.1]))


@pytest.fixture(scope="module")
def orbit() -> ac.Result:
    return ac.simulate(Orbit(), stop_time=3, intervals=60)


def drawn(result: ac.Result, kind: type, k: int, view: Camera = FRONT) -> list[Polygon]:
    """Polygons of the first shape of a kind at a frame."""
    (scene,) = scenes({"orbit": run_of(result)}).values()
    (shape, *_) = (one.shape for one in scene.shapes if isinstance(one.shape, kind))
    seen = [one for one in scene.shapes if one.shape is shape]
    scene.shapes[:] = seen
    return Drawing(scene, view).frame(k)


def pin_of(result: ac.Result) -> Any:
    """The axle of the orbit, with its sizes."""
    (scene,) = scenes({"orbit": run_of(result)}).values()
    return next(one.shape for one in scene.shapes if isinstance(one.shape, geometry.Axle))


def edges(polygons: list[Polygon]) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest coordinates of polygons."""
    points = np.concatenate([polygon.corners for polygon in polygons])
    return points.min(axis=0), points.max(axis=0)


@pytest.mark.parametrize("k", [0, 17, 60])
def test_polygons_are_where_the_shapes_are(orbit: ac.Result, k: int) -> None:
    a = orbit.time[k]
    turn = np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])
    (top,) = drawn(orbit, geometry.Box, k)
    local = top.corners @ turn.T - [3, 0]
    assert np.sort(local, axis=0) == pytest.approx(np.array([[0, -0.2], [0, -0.2], [2, 0.2], [2, 0.2]]), abs=1e-12)
    assert top.depth == pytest.approx(0.1)
    low, high = edges(drawn(orbit, geometry.Sphere, k)[:1])
    assert (low + high) / 2 == pytest.approx(3 * turn[0], abs=1e-12)
    assert high - low == pytest.approx(0.5)
    faces = drawn(orbit, geometry.Cylinder, k)
    area = sum(abs(_area(face.corners)) for face in faces)
    assert area == pytest.approx(2 * 0.2, rel=0.02)  # seen from the side
    pin = drawn(orbit, geometry.Axle, k)
    low, high = edges(pin)  # seen from its end, which is round
    assert high - low == pytest.approx([pin_of(orbit).diameter] * 2, rel=0.02)
    assert len(drawn(orbit, geometry.Mesh, k)) == 1  # the others look away
    low, high = edges([p for p in drawn(orbit, geometry.Curve, k) if len(p.corners) == 4])
    assert np.linalg.norm(high - low) == pytest.approx(2, rel=0.1)
    tip = drawn(orbit, geometry.Arrow, k)[-1].corners[1] - 3 * turn[0]
    assert tip / np.linalg.norm(tip) == pytest.approx(turn[0], abs=1e-9)


def _area(corners: np.ndarray) -> float:
    x, y = corners.T
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)


@pytest.mark.parametrize("rest", [None, geometry.Pose((0, 0, 0), np.eye(3))])
def test_deformations_are_exaggerated_from_what_is_undeformed(rest: geometry.Pose | None) -> None:
    class Bent(Orbit):
        def shapes(self):
            x = np.linspace(0, 1, 5)
            w = x * (1 - x) * (1 if rest is None else x)
            points = np.stack([2 * x, 0.1 * w, 0 * x], axis=1)
            slopes = np.gradient(points, axis=0, edge_order=2)
            at = np.stack([2 * x, 0 * x, 0 * x], axis=1)
            yield geometry.Curve(points, slopes, section=(1e-9, 1e-9), rest=rest, rest_points=at)

    result = ac.simulate(Bent(), stop_time=1, intervals=2)
    (scene,) = scenes({"bent": run_of(result)}).values()
    tops = []
    for scale in (1, 10, 1000):
        drawing = Drawing(scene, FRONT, deformation=scale)
        points = np.concatenate([p.corners for p in drawing.frame(1) if len(p.corners) == 4])
        assert (points[:, 0].min(), points[:, 0].max()) == (pytest.approx(0, abs=1e-5), pytest.approx(2, abs=1e-5))
        tops.append(points[:, 1].max())
    assert np.array(tops) / tops[0] == pytest.approx([1, 10, 1000], rel=1e-6)
    assert tops[0] == pytest.approx(0.1 * (0.25 if rest is None else 4 / 27), rel=0.02)


@pytest.mark.parametrize("profile", ["ellipse", "rectangle"])
def test_curves_are_as_wide_as_their_sections_look(profile: Any) -> None:
    """A tapered strip that is turned about its axis: half widths of the section a, b at each point, seen along z."""
    x, turn = np.linspace(0, 2, 5), np.linspace(0, 1.2, 5)
    points = np.stack([x, 0 * x, 0 * x], axis=1)
    a, b = 0.1 + 0.1 * x, 0.02 + 0 * x
    up = np.stack([0 * x, np.sin(turn), np.cos(turn)], axis=1)

    class Strip(Orbit):
        def shapes(self):
            yield geometry.Curve(points, section=np.stack([a, b], axis=1), up=up, profile=profile)

    (scene,) = scenes({"strip": run_of(ac.simulate(Strip(), stop_time=1, intervals=2))}).values()
    parts = np.abs([a * np.cos(turn), b * np.sin(turn)])
    expected = parts.sum(axis=0) if profile == "rectangle" else np.hypot(*parts)
    corners = np.concatenate([p.corners for p in Drawing(scene, FRONT).frame(1) if len(p.corners) == 4])
    widths = [corners[np.abs(corners[:, 0] - at) < 1e-9][:, 1].max() for at in x]
    assert widths == pytest.approx(expected, rel=1e-9)


def test_up_continues_without_twist_from_the_first_point() -> None:
    """Around a quarter of a circle, in its plane and normal to it."""
    angle = np.linspace(0, np.pi / 2, 9)
    points = np.stack([np.sin(angle), 1 - np.cos(angle), 0 * angle], axis=1)
    slopes = np.pi / 16 * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    inwards = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=1)
    for up, expected in (((0, 1, 0), inwards), ((0, 0, 1), np.broadcast_to((0, 0, 1), (9, 3)))):
        curve = geometry.Curve(points[None], slopes[None], section=np.array([[0.1, 0.2]]), up=np.array([[up]]))
        _, half_axes = sections(curve, 0, 1.0)
        np.testing.assert_allclose(half_axes[::PIECES, 1], 0.2 * expected, atol=1e-9)
        np.testing.assert_allclose(np.linalg.norm(half_axes[:, 0], axis=1), 0.1, rtol=1e-9)


def test_nearer_things_are_drawn_later(orbit: ac.Result) -> None:
    (scene,) = scenes({"orbit": run_of(orbit)}).values()
    depths = [p.depth for p in Drawing(scene, camera(scene.low, scene.high, scene.up)).frame(5)]
    assert depths == sorted(depths)


@pytest.mark.parametrize("up", [(0, 1, 0), (0, 0, 1), (1, 0, 0), (-0.6, 0, 0.8), (0, -1, 0)])
@pytest.mark.parametrize("size", [(1, 1, 0), (0, 1, 1), (1, 0, 1), (1, 1, 1)])
def test_cameras_stand_upright(up: tuple[float, ...], size: tuple[float, ...]) -> None:
    view = camera(np.zeros(3), np.array(size, dtype=float), np.array(up, dtype=float))
    assert view.axes @ view.axes.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(view.axes) == pytest.approx(1)
    assert view.axes[0] @ up == pytest.approx(0, abs=1e-14)
    assert view.axes[1] @ up > 0.9
    assert view.axes[2] @ up > -1e-14


@pytest.mark.parametrize(
    ("seconds", "speed"), [(2, 1), (10, 1), (1.6, 0.2), (0.03, 0.005), (20, 5), (3600, 500), (0, 1)]
)
def test_films_are_neither_short_nor_long(seconds: float, speed: float) -> None:
    assert _speed(seconds) == pytest.approx(speed)


def test_files_hold_the_motion(orbit: ac.Result, tmp_path: Path) -> None:
    orbit.animate(tmp_path / "orbit.gif")
    with Image.open(tmp_path / "orbit.gif") as film:
        count: int = film.n_frames
        assert (film.format, count, film.info["duration"], film.info["loop"]) == ("GIF", 60, 50, 0)
    orbit.animate(tmp_path / "orbit.png", values=["load"])
    with Image.open(tmp_path / "orbit.png") as still:
        assert (still.format, still.width) == ("PNG", 640)
        colours = np.unique(np.asarray(still).reshape(-1, 3), axis=0)
        assert len(colours) > 50
    ac.animate({"a": orbit, "b": orbit}, tmp_path / "two.png")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["orbit.gif", "orbit.png", "two.png"]


def test_one_moment_is_a_picture(tmp_path: Path) -> None:
    result: Any = ac.simulate(Orbit(), stop_time=1, intervals=1)
    one = ac.Result(
        result.time[:1], lambda column: np.asarray(result._evaluate(column))[:1], result.tree, (), result.stats
    )
    one.animate(tmp_path / "one.png")
    one.animate(tmp_path / "one.gif")
    one.animate(tmp_path / "one.html")
    assert Image.open(io.BytesIO((tmp_path / "one.png").read_bytes())).width == 640


@pytest.mark.parametrize("up", [(0, 1, 0), (0, 0, 1), (-1, 0, 0)])
@pytest.mark.parametrize("name", VIEWS)
def test_standard_views_are_right_handed_and_upright(name: str, up: tuple[int, ...]) -> None:
    axes = standard(name, np.array(up, dtype=float)).axes
    assert axes @ axes.T == pytest.approx(np.eye(3))
    assert np.linalg.det(axes) == pytest.approx(1)
    seen = axes @ up
    assert seen[0] == pytest.approx(0, abs=1e-12)
    assert (seen[2] > 0.99) if name == "top" else (seen[1] > 0.8)


@pytest.mark.parametrize("size", [(200, 151), (64, 300), (900, 100)])
def test_pictures_have_the_wanted_size(orbit: ac.Result, tmp_path: Path, size: tuple[int, int]) -> None:
    """Every kind of picture: with the whole scene in it, whatever its shape."""
    for name, more in (("film.gif", {"fps": 10}), ("still.png", {})):
        orbit.animate(tmp_path / name, size=size, view="iso", **more)
        picture = Image.open(tmp_path / name)
        assert picture.size == size
        shown = np.asarray(picture.convert("L"))
        assert (shown < 200).any()
    assert Image.open(tmp_path / "film.gif").n_frames == 30


def test_trails_are_the_paths_up_to_now(orbit: ac.Result) -> None:
    here = geometry.Trail((3 * ac.cos(orbit.tree.angle), 3 * ac.sin(orbit.tree.angle), 0))
    run = run_of(orbit, AnimationOptions(trails=[ac.as_expr(here.at)]))
    (scene,) = scenes({"orbit": run}).values()
    scene.shapes[:] = [one for one in scene.shapes if isinstance(one.shape, geometry.Trail)]
    for k in (0, 17, 60):
        polygons = Drawing(scene, FRONT).frame(k)
        assert len(polygons) == k
        for p in polygons:
            assert np.linalg.norm(p.corners, axis=1) == pytest.approx(3, abs=0.05)
            assert np.arctan2(*p.corners.mean(axis=0)[::-1]) % (2 * np.pi) < orbit.time[k]


FFMPEG = """#!/bin/sh
for last; do :; done
{action}
"""


@pytest.mark.skipif(os.name != "posix", reason="the program is a shell script")
@pytest.mark.parametrize("fails", [False, True])
def test_movies_are_written_by_ffmpeg(
    orbit: ac.Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, fails: bool
) -> None:
    """A stand-in for ffmpeg writes what it is given: whole frames of the wanted size."""
    program = tmp_path / "ffmpeg"
    program.write_text(FFMPEG.format(action="echo no codec >&2; exit 1" if fails else 'cat > "$last"'))
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    film = tmp_path / "film.mp4"
    if fails:
        with pytest.raises(ac.ExportError, match="ffmpeg cannot write the film: no codec"):
            orbit.animate(film, size=(64, 64))
        assert not film.exists()
    else:
        orbit.animate(film, size=(80, 64), fps=10)
        assert film.stat().st_size == 30 * 80 * 64 * 3
