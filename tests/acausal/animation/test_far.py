"""What stands far from the origin is drawn as exactly as what stands there."""

from __future__ import annotations

from typing import Any

import numpy as np

import acausal as ac
from acausal import Model, Vector3, chain, fixed, structural
from acausal.animation.document import document
from acausal.result.animated import run_of
from components import BodyBox, Fixed, Revolute, World
from models import SliderCrank
from tests.acausal.animation.places import Frame
from tests.shared import compiled


class Remote(Model):
    """Pendulum at some place."""

    at: Any = structural("where", default=(0, 0, 0), shape=(3,))
    world = World()
    place = Fixed(r=at)
    hinge = Revolute(phi=fixed(0), w=fixed(0))
    bar = BodyBox(r=(1, 0, 0), width=0.05)
    tip: Vector3 = ac.output("place of the tip", unit="m")

    def connections(self):
        yield chain(self.place, self.hinge, self.bar)

    def equations(self):
        yield self.tip == self.bar.frame_b.r_0


FAR = (4e6, -5.3e5, 0.1)


def test_far_from_the_origin() -> None:
    result = ac.simulate(Remote(at=FAR), stop_time=1, intervals=40)
    run = document({"swing": run_of(result)})["runs"][0]
    box = next(s for s in run["shapes"] if s["kind"] == "box")
    extent = np.linalg.norm(np.subtract(run["extent"]["high"], run["extent"]["low"]))
    assert extent < 3
    for k in (0, 20, 40):
        drawn = Frame(run, k).at(box["pose"], (1, 0, 0))[0]
        assert np.max(np.abs(drawn - result["bar.frame_b.r_0"][k])) < 1e-6 * extent
        plotted = [Frame(run, k).values[plot["column"]] for plot in run["plots"]]
        assert np.max(np.abs(np.array(plotted) - result["tip"][k])) < 1e-6


def test_scenes_at_the_origin_need_no_offsets() -> None:
    result = ac.simulate(compiled(SliderCrank), stop_time=0.1, intervals=10)
    run = document({"": run_of(result)})["runs"][0]
    assert set(run["offsets"]) <= {str(plot["column"]) for plot in run["plots"]}  # of outputs that hardly change yet
