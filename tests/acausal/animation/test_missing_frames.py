"""Shapes with a position that is not finite at some times are drawn with a warning; shapes() that fails is located."""

from __future__ import annotations

import base64
import warnings
import zlib
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, as_expr, chain, fixed, geometry, sqrt, time
from acausal.animation.document import document
from acausal.animation.scene import scene_of, shapes_of
from acausal.result.animated import run_of
from components import Body, Revolute, World
from components.frame import pose


class Odd(Body):
    def shapes(self):
        yield self.look(pose(self.frame_a))


def swing(look) -> Any:
    """Return the result of a pendulum whose bob looks like what is made from its pose."""
    bob = type("Odd", (Odd,), {"look": staticmethod(look)})

    class Swing(Model):
        world, joint, bob_ = World(), Revolute(phi=fixed(0.3), w=fixed(0)), bob(m=1, r_CM=(0.5, 0, 0))

        def connections(self):
            yield chain(self.world, self.joint, self.bob_)

    return ac.simulate(Swing(), stop_time=1, intervals=20)


def drawn(result: Any) -> None:
    """Write what is drawn: finite numbers, the bob among them."""
    run = document({"": run_of(result)})["runs"][0]
    assert np.isfinite(np.frombuffer(zlib.decompress(base64.b64decode(run["data"])), dtype="<f4")).all()
    part = next(k for k, p in enumerate(run["parts"]) if p["path"] == "bob_")
    assert any(shape["part"] == part for shape in run["shapes"])


LATE = sqrt(0.5 - time)
BETWEEN = sqrt((time - 0.22) * (time - 0.38))
ONE = 1 + 1e-30 * LATE


@pytest.mark.parametrize(
    ("look", "says"),
    [
        (lambda p: geometry.Sphere(p, (LATE, 0, 0), 0.1), r"Sphere of bob_ \(Odd\) .* 10 of 21 frames.* t = 0\.55 s"),
        (lambda p: geometry.Sphere(p, (BETWEEN, 0, 0), 0.1), r"Sphere of bob_ .* at 3 of 21 frames.* t = 0\.25 s"),
        (lambda p: geometry.Box(p, (0, LATE, 0), (1, 1, 1)), r"Box of bob_ \(Odd\) .* 10 of 21 .* t = 0\.55 s"),
        (
            lambda p: geometry.Sphere(geometry.Pose(p.r + as_expr((LATE, 0, 0)), p.T), diameter=0.1),
            r"position of the Sphere of bob_ \(Odd\) .* the first at t = 0\.55 s",
        ),
        (
            lambda p: geometry.Span(p.r, p.r + as_expr((LATE, 0, 0))),
            r"position of the Span of bob_ \(Odd\) .* t = 0\.55 s",
        ),
        (
            lambda p: geometry.Cylinder(p, (0, 0, 0), (ONE, 0, 0), 0.1),
            r"`end` of the Cylinder of bob_ \(Odd\) is not a finite number at 10 of 21 frames, the first at t = 0\.55 s",
        ),
        (
            lambda p: geometry.Sphere(p, (0, 0, 0), 0.1 * ONE),
            r"`diameter` of the Sphere of bob_ \(Odd\) is not a finite number at 10 of 21 .* t = 0\.55 s",
        ),
    ],
)
def test_a_place_that_is_lost_is_drawn_with_a_warning_of_part_and_time(look, says):
    result = swing(look)
    with pytest.warns(ac.AcausalWarning, match=says):
        drawn(result)


def test_a_center_that_moves_is_where_it_says():
    result = swing(lambda p: geometry.Sphere(p, (0.5 - 0.2 * time, 0.1, 0), 0.1))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run = run_of(result)
        sphere = next(one.shape for one in scene_of(run, shapes_of([run.tree])[0]).shapes if one.path == "bob_")
    phi, t = result["joint.phi"], result.time
    along, aside = 0.5 - 0.2 * t, 0.1
    x, y = along * np.cos(phi) - aside * np.sin(phi), along * np.sin(phi) + aside * np.cos(phi)
    np.testing.assert_allclose(sphere.pose.r, np.column_stack([x, y, 0 * t]), atol=1e-12)
    assert np.all(sphere.center == 0)


def test_a_size_that_varies_besides_is_still_refused():
    with pytest.raises(ac.DeclarationError, match=r"`diameter` of the Sphere of bob_ \(Odd\) varies with time"):
        drawn(swing(lambda p: geometry.Sphere(p, (0, 0, 0), LATE)))


def fails(p):
    return geometry.Sphere(p, (1 / 0, 0, 0), 0.1)


def fails_later(p):
    return geometry.Curve((p.r, p.r + as_expr((1, 0, 0))), values=(geometry.Values("load", "N", lambda: [][1]),))


@pytest.mark.parametrize(
    ("look", "says"),
    [
        (fails, r"bob_ \(Odd\), .*test_missing_frames\.py:\d+: shapes\(\) fails: ZeroDivisionError: division by zero"),
        (lambda p: p.absent, r"bob_ \(Odd\), .*test_missing_frames\.py:\d+: shapes\(\) fails: AttributeError"),
        (fails_later, r"bob_ \(Odd\), .*test_missing_frames\.py:\d+: shapes\(\) fails: IndexError"),
    ],
)
def test_a_shape_that_fails_is_named_with_its_line(tmp_path, look, says):
    with pytest.raises(ac.DeclarationError, match=says):
        swing(look).animate(tmp_path / "odd.html", values=["all"])
