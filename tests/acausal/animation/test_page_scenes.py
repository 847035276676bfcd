"""Every scene as a page: drawn where its document says, which is where the result has it."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, chain, fixed
from components import Body, Fixed, FixedTranslation, Prismatic, Revolute, Spherical, Spring, World, WorldForce
from models import SCENES
from tests.acausal.animation.browser import Browser
from tests.acausal.animation.places import extent_of, places
from tests.acausal.animation.test_far import FAR, Remote
from tests.shared import CONTRACT, compiled


def opened(result: ac.Result, browser: Browser, folder: Path, **asked: Any) -> dict[str, Any]:
    """Write the page of a result, open it, and return its document."""
    path = folder / "scene.html"
    result.animate(path, **asked)
    browser.open(path.as_uri() + "#t=0")
    browser.run("acausal.ready.then(() => null)")
    return browser.run("acausal.document")


def compare(result: ac.Result, browser: Browser, document: dict[str, Any]) -> int:
    """Compare what is drawn at three output times with the document and the result; return how much was compared."""
    (run,) = document["runs"]
    extent = extent_of(document)
    compared = 0
    for index in (0, len(result.time) // 2, len(result.time) - 1):
        time, expected = places(document, index)
        assert time == result.time[index]
        drawn = browser.run(
            f"acausal.seek({time!r}), acausal.viewer.runs[0].items.map((_, k) => [acausal.positions(k), acausal.poses(k)])"
        )
        for (points, matrix), places_, shape in zip(drawn, expected, run["shapes"], strict=True):
            seen = np.reshape(points, (-1, 3))
            assert seen == pytest.approx(places_, abs=1e-6 * extent), shape
            path = run["parts"][shape["part"]]["path"]
            if shape["kind"] == "curve" and f"{path}.node_r_0" in result:
                assert seen == pytest.approx(result[f"{path}.node_r_0"][index], abs=1e-6 * extent)
                compared += 1
            if shape["kind"] == "sphere" and f"{path}.frame_a.R.T" in result:
                turn = np.reshape(matrix, (4, 4))[:3, :3] / shape["diameter"]  # its columns are the rows of T
                T = result[f"{path}.frame_a.R.T"][index]
                assert turn == pytest.approx(T, abs=1e-6)
                center = result[f"{path}.frame_a.r_0"][index] + T.T @ shape["center"]
                assert seen[0] == pytest.approx(center, abs=1e-6 * extent)
                compared += 1
    assert browser.faults() == []
    assert browser.requests() == []
    assert browser.run("acausal.errors") == []
    return compared


@pytest.mark.parametrize("name", SCENES)
def test_every_scene_is_drawn_where_its_result_has_it(one_browser: Browser, tmp_path: Path, name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ac.AcausalWarning)  # of the physics, which is not what this is about
        result = ac.simulate(compiled(SCENES[name]), stop_time=CONTRACT[name][1] / 8, intervals=50, tolerance=1e-4)
        document = opened(result, one_browser, tmp_path)
    beams = [shape for shape in document["runs"][0]["shapes"] if shape["kind"] == "curve"]
    assert compare(result, one_browser, document) >= 3 * len(beams)
    one_browser.run("acausal.viewer.nextColour(), acausal.viewer.toggle('force', true), acausal.viewer.deform(10)")
    assert one_browser.run("acausal.viewer.draw(), acausal.errors") == []


class Swing(Component):
    """A user's own part that says nothing of its looks: what stands in it is seen."""

    hinge, arm, weight = (
        Revolute(n=(0, 1, 1), phi=fixed(0.3), w=fixed(2)),
        FixedTranslation(r=(0.5, 0.1, 0.2)),
        Body(m=2),
    )

    def connections(self):
        yield chain(self.hinge, self.arm, self.weight)


class Zoo(Model):
    """A body on a ball joint, springs, a free body, a force, and a user's own part."""

    world, post = World(), Fixed(r=(1, 0, 0))
    ball, arm, load = Spherical(), FixedTranslation(r=(0.4, 0, 0.1)), Body(m=1, I=np.diag((0.1, 0.2, 0.3)))
    spring, loose = Spring(c=50, s_unstretched=0.3), Body(m=1, I=np.diag((0.1, 0.2, 0.3)))
    push = WorldForce(force=(0.2, 0, 0))
    own, rail = Swing(), Prismatic(n=(0, 1, 0), s=fixed(0.1))
    slide = Body(m=1)

    def connections(self):
        yield chain(self.world, self.ball, self.arm, self.load)
        yield chain(self.post, self.spring, self.loose)
        yield chain(self.push, self.loose)
        yield chain(self.world, self.own.hinge)
        yield chain(self.world, self.rail, self.slide)


def test_bodies_springs_forces_and_a_part_without_shapes(one_browser: Browser, tmp_path: Path) -> None:
    result = ac.simulate(Zoo(), stop_time=0.5, intervals=50, initial="guesses")
    document = opened(result, one_browser, tmp_path)
    kinds = {shape["kind"] for shape in document["runs"][0]["shapes"]}
    assert {"ground", "sphere", "span", "arrow"} <= kinds
    assert "own.weight" in {part["path"] for part in document["runs"][0]["parts"]}
    assert compare(result, one_browser, document) >= 3 * 4


def test_a_scene_far_from_the_origin_is_drawn_as_exactly(one_browser: Browser, tmp_path: Path) -> None:
    result = ac.simulate(Remote(at=FAR), stop_time=1, intervals=40)
    document = opened(result, one_browser, tmp_path)
    compare(result, one_browser, document)
    box = next(k for k, shape in enumerate(document["runs"][0]["shapes"]) if shape["kind"] == "box")
    for index in (0, 20, 40):
        ends = one_browser.run(f"acausal.seek({float(result.time[index])!r}), acausal.positions({box})")
        tip = result["bar.frame_b.r_0"][index]
        assert ends[2] == pytest.approx(tip, abs=1e-6 * extent_of(document), rel=0)
