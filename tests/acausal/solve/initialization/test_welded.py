"""Loops of parts that are welded to one another: what closes them holds by rounding, and no state changes it."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import acausal as ac
from acausal import InitializationError, Model, chain, connect, fixed, guess
from components import BodyBox, FixedRotation, Prismatic, Revolute, Spherical, World
from tests.shared import pairwise

JOINTS = {
    "hinge": lambda: Revolute(phi=fixed(0.3), w=fixed(2)),
    "skewed": lambda: Revolute(n=(1, 2, 2), phi=fixed(0.3), w=fixed(0)),
    "ball": lambda: Spherical(angles_fixed=True, w_rel=fixed((1.0, 2.0, 3.0))),
    "slide": lambda: Prismatic(n=(1, 2, 2), s=fixed(0.1), v=fixed(0)),
}


def ring(joint, sides=3, closed=True, length=0.5, more=0.0) -> Model:
    """Boxes welded to a polygon on a joint; `more` opens one of its corners, in rad."""

    class Ring(Model):
        world, hold = World(), joint
        side = tuple(BodyBox(r=(length, 0, 0), width=0.1 * length, density=1000) for _ in range(sides))
        corner = tuple(FixedRotation(angle=2 * np.pi / sides + more * (k == 0), n=(0, 0, 1)) for k in range(sides))

        def connections(self):
            yield connect(self.world.frame_b, self.hold.frame_a)
            end = self.hold.frame_b
            for side, corner in zip(self.side, self.corner, strict=True):
                yield chain(end, side, corner.frame_a)
                end = corner.frame_b
            if closed:
                yield connect(end, self.side[0].frame_a)

    return Ring()


@pytest.mark.parametrize(("sides", "joint", "method"), pairwise([3, 5], JOINTS, ["auto", "rosenbrock", "idas"]))
def test_a_polygon_moves_as_the_one_that_is_not_closed(sides: int, joint: str, method: str) -> None:
    found, open_ = (
        ac.simulate(ring(JOINTS[joint](), sides, closed), stop_time=0.5, method=method, tolerance=1e-8, intervals=20)
        for closed in (True, False)
    )
    for name, size in (("side[1].frame_b.r_0", 0.5), ("world.frame_b.f", 40.0), ("world.frame_b.t", 40.0)):
        assert np.abs(found[name] - open_[name]).max() < 1e-5 * size


def test_boxes_of_tenths() -> None:
    """0.1 + 0.2 is not 0.3 in binary numbers."""

    class Beside(Model):
        world, hinge = World(), Revolute(phi=fixed(0.3), w=fixed(0))
        short, middle, long = (BodyBox(r=(x, 0, 0), width=0.02) for x in (0.1, 0.2, 0.3))

        def connections(self):
            yield chain(self.world, self.hinge, self.short, self.middle)
            yield connect(self.hinge.frame_b, self.long.frame_a)
            yield connect(self.middle.frame_b, self.long.frame_b)

    result = ac.simulate(Beside(), stop_time=0.2)
    assert np.abs(result["middle.frame_b.r_0"] - result["long.frame_b.r_0"]).max() < 1e-15


@pytest.mark.parametrize("length", [5e-7, 0.5, 5e4])
def test_what_closes_to_its_digits_only(length: float) -> None:
    ac.simulate(ring(JOINTS["hinge"](), 3, length=length, more=1e-11), stop_time=1e-3, intervals=1)
    with pytest.raises(InitializationError, match="does not close"):
        ac.simulate(ring(JOINTS["hinge"](), 3, length=length, more=1e-4), stop_time=1e-3, intervals=1)


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("stop_time", [0.1, 1.0, 10.0])
@pytest.mark.parametrize("phi", [-0.5, 0.1, 2.0])
def test_a_triangle_comes_to_rest_below_its_hinge(phi: float, stop_time: float, closed: bool) -> None:
    """The last corner lies on the axis, where its acceleration is that of rounding."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", ac.AcausalWarning)
        model = ring(Revolute(phi=guess(phi), w=guess(2.0)), 3, closed)
        result = ac.simulate(model, stop_time=stop_time, intervals=1, initial="steady")
    assert np.sin(result["hold.phi"][0] + np.pi / 6) == pytest.approx(-1)
