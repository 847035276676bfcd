"""Joints of closed loops that jump: they jump to what is said, and the other joints follow, however far."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import reinit, structural, time, when
from models import Bricard, FourBar, FourBarSpatial
from tests.hard.bennett import ASKEW, RATIO, Bennett

AT, STOP = 0.2, 0.4


class JumpingFourBar(FourBar):
    """The crank jumps."""

    jump: float = structural("by which the crank jumps, rad", default=2.8)

    def equations(self):
        yield from super().equations()
        yield when(time > AT, reinit(self.j1.phi, self.j1.phi + self.jump))


class JumpingSpatial(FourBarSpatial):
    """The crank jumps; the rod between two ball joints is free to spin."""

    jump: float = structural("by which the crank jumps, rad", default=2.0)

    def equations(self):
        yield from super().equations()
        yield when(time > AT, reinit(self.j1.phi, self.j1.phi + self.jump))


class JumpingBricard(Bricard):
    """The first joint jumps."""

    jump: float = structural("by which the joint jumps, rad", default=2.0)

    def equations(self):
        yield from super().equations()
        yield when(time > AT, reinit(self.joint[0].phi, self.joint[0].phi + self.jump))


class JumpingBennett(Bennett):
    """The first joint jumps to where other constraints are to be kept."""

    jump: float = structural("by which the joint jumps, rad", default=2.5)

    def equations(self):
        yield when(time > AT, reinit(self.joint[0].phi, self.joint[0].phi + self.jump))


JUMPS = (-2.8, -1.0, 0.3, 1.8, 3.0)
CASES: list[tuple[type, str, float]] = [
    *((JumpingFourBar, "j1", jump) for jump in JUMPS),
    *((JumpingSpatial, "j1", jump) for jump in JUMPS),
    *((JumpingBricard, "joint[0]", jump) for jump in JUMPS if jump > 0),
    *((JumpingBennett, "joint[0]", jump) for jump in JUMPS),
]


@pytest.mark.parametrize("method", ["auto", "rosenbrock", pytest.param("idas", marks=pytest.mark.slow)])
@pytest.mark.parametrize(("scene", "joint", "jump"), CASES)
def test_a_joint_jumps_to_what_is_said(scene: Any, joint: str, jump: float, method: str) -> None:
    model = scene(jump=jump, **({"turned": ASKEW} if scene is JumpingBennett else {}))
    result = ac.simulate(model, stop_time=STOP, intervals=400, tolerance=1e-7, method=method)
    turned, speed = result[f"{joint}.phi"], result[f"{joint}.w"]
    place = int(np.argmin(np.abs(result.time - AT)))
    moved = np.max(np.abs(speed[place - 2 : place + 2])) * 2 * STOP / 400
    assert turned[place] - turned[place - 1] == pytest.approx(jump, abs=moved + 1e-6)
    # What is integrated is what joints are at: their rates are those of their angles.
    slopes = np.gradient(turned[place + 1 :], result.time[place + 1 :])[1:-1]
    assert np.abs(slopes - speed[place + 2 : -1]).max() < 1e-3 * (1 + np.abs(speed).max())
    if scene is JumpingBennett:
        first = 0.8 + turned
        second = result["joint[1].phi"] + 2 * np.arctan(RATIO / np.tan(0.4))
        apart = np.sin(first / 2) * np.sin(second / 2) - RATIO * np.cos(first / 2) * np.cos(second / 2)
        assert np.abs(apart).max() < 1e-6


@pytest.mark.parametrize("scene", [JumpingFourBar, JumpingSpatial, JumpingBricard, JumpingBennett])
def test_methods_go_on_from_the_same_point(scene: Any) -> None:
    found = [
        ac.simulate(scene(), stop_time=STOP, intervals=20, tolerance=1e-8, method=method) for method in ("auto", "idas")
    ]
    for name in ac.compile(scene()).states:
        assert np.abs(found[0][name] - found[1][name]).max() < 1e-4
