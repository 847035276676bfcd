"""Looks of styles: the page and the films draw the same solids; bodies have colours."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, geometry, output
from acausal.animation import geometry as g
from acausal.animation.document import document_of, scenes
from acausal.animation.drawing import DRAW, Drawing
from acausal.animation.scene import Scene
from acausal.result.animated import run_of
from tests.acausal.animation.conftest import Show
from tests.acausal.animation.test_films import FRONT, edges

STYLED = [(kind, style) for kind, styles in g.STYLES.items() for style in styles if style != "coil"]


class Styles(Model):
    """A shape of each style, which turns and moves."""

    angle: Scalar = output("angle", unit="rad")

    def equations(self):
        yield self.angle == 0.4 + ac.time

    def shapes(self):
        c, s = ac.cos(self.angle), ac.sin(self.angle)
        pose = geometry.Pose((c, s, 0.2), ac.as_expr([[c, s, 0], [-s, c, 0], [0, 0, 1]]))
        yield geometry.Ground()
        for kind, style in STYLED:
            if kind is geometry.Axle:
                yield geometry.Axle(pose, (1, 2, 3), 0.3, 0.2, style)
            elif kind is geometry.Cylinder:
                yield geometry.Cylinder(pose, (0.1, 0, 0), (0.2, 0.7, 0.1), 0.2, style)
            elif kind is geometry.Rail:
                yield geometry.Rail(pose, (0, 0, 1), (c, s, self.angle), style)
            else:
                yield geometry.Span((0, 0, 0), (c, s, 1), style, 0.15)


@pytest.fixture(scope="module")
def scene() -> Scene:
    result = ac.simulate(Styles(), stop_time=1, intervals=20)
    (found,) = scenes({"styles": run_of(result)}).values()
    return found


def test_page_and_films_draw_the_same_solids(show: Show, scene: Scene) -> None:
    """Bounding boxes at one instant: circles have more corners on the page, and bevels of spans another ratio."""
    browser = show(document_of({"styles": scene}))
    box = (
        "(item) => { const b = new THREE.Box3(), p = new THREE.Vector3(); item.object.traverse((o) => {"
        " const at = o.geometry?.attributes.position;"
        " for (let i = 0; i < (at?.count ?? 0); i++)"
        " b.expandByPoint(p.fromBufferAttribute(at, i).applyMatrix4(o.matrixWorld)); });"
        " return [b.min, b.max].map((p) => p.toArray().map((x, j) => x + acausal.viewer.stage.origin[j])); }"
    )
    k = 13
    drawn = browser.run(f"acausal.seek({float(scene.run.time[k])}), acausal.viewer.runs[0].items.slice(1).map({box})")
    drawing = Drawing(scene, FRONT)
    for one, (low, high) in zip(scene.shapes[1:], drawn, strict=True):
        polygons = list(DRAW[type(one.shape)](drawing, one.shape, k, np.ones(3)))
        assert polygons, one.shape.style
        # A film draws visible faces alone, whose outline is that of the solid.
        for seen, expected in zip(edges(polygons), (low[:2], high[:2]), strict=True):
            assert seen == pytest.approx(expected, abs=0.06 * one.shape.diameter), one.shape.style


def test_rails_are_as_long_as_their_paths(scene: Scene) -> None:
    rails = [one.shape for one in scene.shapes if getattr(one.shape, "style", "") in g.STYLES[g.Rail]]
    found = [[rail.start[2], rail.end[2]] for rail in rails[-len(g.STYLES[g.Rail]) :]]
    assert found == [pytest.approx([0.2, 1.2])] * len(found)


def shows(*yielded: Any) -> list[Any]:
    """Shapes of a model, arranged, with colours and sizes; each argument is a shape, or a function of time that returns one."""

    class Own(Model):
        x: Scalar = output("angle", unit="rad")

        def equations(self):
            yield self.x == ac.time

        def shapes(self):
            yield from (item(self.x) if callable(item) else item for item in yielded)

    (found,) = scenes({"": run_of(ac.simulate(Own(), stop_time=1, intervals=10))}).values()
    return found.shapes


def at(x: Any, y: Any = 0.0, angle: Any = 0.0) -> geometry.Pose:
    c, s = ac.cos(ac.as_expr(angle)), ac.sin(ac.as_expr(angle))
    return geometry.Pose((x, y, 0), ac.as_expr([[c, s, 0], [-s, c, 0], [0, 0, 1]]))


def test_a_rigid_body_has_one_colour() -> None:
    """Shapes in two poses that move together, one in the world, and one that turns relative to both."""
    bar, ball, still, other = shows(
        lambda t: geometry.Cylinder(at(t, 0, t), (0, 0, 0), (1, 0, 0)),
        lambda t: geometry.Sphere(at(t - ac.sin(t), ac.cos(t), 3 + t)),
        geometry.Box(at(0), (0, 0, 0), (1, 1, 1)),
        lambda t: geometry.Box(at(t, 0, 2 * t), (0, 0, 0), (1, 1, 1)),
    )
    assert bar.colour == ball.colour
    assert len({bar.colour, still.colour, other.colour}) == 3


def test_parts_that_never_move_keep_their_colours() -> None:
    a, b = shows(geometry.Box(at(0), (0, 0, 0), (1, 1, 1)), geometry.Box(at(3), (0, 0, 0), (1, 1, 1)))
    assert a.colour == b.colour  # both are of the model
    (mobile, grey) = shows(lambda t: geometry.Sphere(at(t)), geometry.Box(at(3), (0, 0, 0), (1, 1, 1)))
    assert mobile.colour != grey.colour


@pytest.mark.parametrize(
    ("held", "axis"),
    [
        (geometry.Axle(at(0), (0, 0, 2)), (0, 0, 1)),
        (geometry.Axle(at(0), (0, -1, 0)), (0, 1, 0)),
        (geometry.Span((0, 0, 0), (3, 0, 0)), (1, 0, 0)),
        (geometry.Cylinder(at(3), (0, 0, 0), (-3, 0, 0)), (1, 0, 0)),
        (geometry.Axle(at(0), (1, 0, 0), style="ball"), (0, 1, 0)),
    ],
)
def test_supports_stand_behind_what_they_hold(held: Any, axis: tuple[float, ...]) -> None:
    for support in (one.shape for one in shows(held, geometry.Axle(at(0), None, style="support"))[1:]):
        assert support.axis / np.linalg.norm(support.axis) == pytest.approx(axis)


def test_the_wall_of_a_hinge_is_behind_the_front_view() -> None:
    hinge, ground = geometry.Axle(at(0), (0, 1, 0)), geometry.Ground((0, 0, 1))
    *_, support = shows(ground, hinge, geometry.Axle(at(0), None, style="support"))
    assert support.shape.axis == pytest.approx([0, -1, 0])


def test_supports_that_hold_nothing_are_not_drawn() -> None:
    free = shows(geometry.Sphere(at(1), diameter=1), geometry.Axle(at(0), None, style="support"))
    assert [type(one.shape) for one in free] == [g.Sphere]


@pytest.mark.parametrize("thickness", [0.004, 0.02, 0.05])
def test_joints_are_as_large_as_what_they_join(thickness: float) -> None:
    bar, hinge = shows(geometry.Box(at(0), (0.5, 0, 0), (1, thickness, thickness)), geometry.Axle(at(0), (0, 0, 1)))
    assert bar.shape.size[1] < hinge.shape.diameter < max(1.5 * thickness, 0.02)
    assert hinge.shape.length > thickness


@pytest.mark.parametrize("count", [1, 40])
def test_joints_of_a_long_chain_are_smaller_than_its_links(count: int) -> None:
    links = [geometry.Cylinder(at(k), (0, 0, 0), (1, 0, 0), style="link") for k in range(count)]
    for one in shows(*links, *(geometry.Axle(at(k), (0, 0, 1)) for k in range(count))):
        assert one.shape.diameter < 0.15
