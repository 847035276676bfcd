"""Joints of closed loops that jump: they jump to what is said, and the other joints follow, however far."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, chain, fixed, part, reinit, structural, time, when
from components import BodyRod, Fixed, FlexibleBeam, Revolute, World
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


@pytest.mark.parametrize("to", [-2.9, -1.5, 0.5, 1.7, 2.1, 2.7, 3.1])
def test_a_loop_stays_in_its_assembly(to: float) -> None:
    """The rocker is where circles about both ends meet, on the side of before."""
    model = JumpingFourBar(jump=to)
    result = ac.simulate(model, stop_time=AT, intervals=2, tolerance=1e-8)
    crank = result["j1.phi"]
    tip, pivot = 0.4 * np.exp(1j * crank), -0.15 + 1j
    coupler, rocker = abs(0.1 + 1.1j), abs(0.65 + 0.1j)
    apart = pivot - tip
    along = (coupler**2 - rocker**2 + np.abs(apart) ** 2) / (2 * np.abs(apart))
    across = np.sqrt(coupler**2 - along**2)
    ends = np.array([tip + (along + side * 1j * across) * apart / np.abs(apart) for side in (1, -1)])
    found = pivot + (0.65 + 0.1j) * np.exp(1j * result["j3.phi"])
    off = np.abs(ends - found)
    side = int(np.argmin(off[:, 0]))
    assert np.abs(off[side]).max() < 1e-7


class Coupled(Model):
    """A four-bar whose coupler bends, or does not."""

    elastic: bool = structural("whether it bends")
    world, far = World(), Fixed(r=(1.2, 0, 0))
    crank, rocker = BodyRod(r=(0, 0.4, 0), m=1), BodyRod(r=(-0.2, 0.7, 0), m=1)
    bearing, pin, knee, pivot = Revolute(phi=fixed(0), w=fixed(0)), Revolute(), Revolute(), Revolute()

    @part
    def coupler(self) -> Component:
        """Of steel."""
        length = float(np.hypot(1.0, 0.3))
        beam = FlexibleBeam(length=length, E=2e11, rho=7850, A=1e-4, J=1e-9, elements=2, check_range=False)
        return beam if self.elastic else BodyRod(r=(length, 0, 0), m=7850 * 1e-4 * length)

    def connections(self):
        yield chain(self.world, self.bearing, self.crank, self.pin, self.coupler, self.knee, self.rocker.frame_b)
        yield chain(self.far, self.pivot, self.rocker)

    def equations(self):
        yield when(time > AT, reinit(self.bearing.phi, self.bearing.phi + 0.5))


def test_stiff_parts_are_spared() -> None:
    """Joints follow; the jump changes the energy as much as without elasticity, not that of a coupler that is crushed."""
    runs = [
        ac.simulate(Coupled(elastic=elastic), stop_time=AT + 1e-3, intervals=2, energy=True, initial="fixed")
        for elastic in (False, True)
    ]
    rigid, bent = (run.stats["energy_stored_change"] for run in runs)
    assert abs(rigid) > 1
    assert bent == pytest.approx(rigid, rel=1e-2)
    for name in ("pin.phi", "knee.phi", "pivot.phi"):
        assert runs[1][name][-1] == pytest.approx(runs[0][name][-1], abs=1e-2)  # ends of the coupler slope by 2e-3 rad


def test_a_jump_out_of_reach_is_named() -> None:
    class Far(FourBar):
        def equations(self):
            yield from super().equations()
            yield when(time > AT, reinit(self.j3.phi, 1.0))

    with pytest.raises(
        ac.SimulationError, match=r"does not close with `j3\.phi` = 1, to which Far, .* sets it:[\s\S]*can reach"
    ) as told:
        ac.simulate(Far(), stop_time=STOP)
    assert "fixed" not in str(told.value)
