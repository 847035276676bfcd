"""Machines in millimetres: all lengths a thousand times as large, and gravity too, so that angles are the same."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed, guess, structural
from components import Body, BodyRod, FixedTranslation, Prismatic, Revolute, World, rotational
from tests.hard.measure import within

LENGTHS = (1e-3, 1.0, 1e3, 1e6)


class SliderCrank(Model):
    """Crank of 0.3, rod of 0.8, and a slider 0.05 above the bearing."""

    L: float = structural("unit of length", default=1.0)
    world = World(g=9.81 * L)
    joint = Revolute(phi=fixed(2.5), w=fixed(1.0))
    crank = BodyRod(r=(0.3 * L, 0, 0), m=0.5)
    pin = Revolute(phi=guess(-2))
    rod = BodyRod(r=(0.8 * L, 0, 0), m=1.0)
    wrist = Revolute()
    rail = FixedTranslation(r=(0, 0.05 * L, 0))
    slide = Prismatic(s=guess(0.5 * L))
    slider = Body(m=2.0)

    def connections(self):
        yield chain(self.world, self.joint, self.crank, self.pin, self.rod, self.wrist, self.slider)
        yield chain(self.world, self.rail, self.slide, self.slider)


class Yoke(Model):
    """A crank whose pin slides in a slot across the way of a mass, which it moves as a sine of its angle."""

    L: float = structural("unit of length", default=1.0)
    world = World(g=9.81 * L)
    joint = Revolute(phi=fixed(0.3), w=fixed(4.0))
    crank = BodyRod(r=(0.3 * L, 0, 0), m=0.5)
    pin = Revolute(phi=guess(-0.3))
    way = Prismatic(n=(1, 0, 0), s=guess(0.3 * L))
    mass = Body(m=2.0)
    slot = Prismatic(n=(0, 1, 0))

    def connections(self):
        yield chain(self.world, self.joint, self.crank, self.pin)
        yield chain(self.world, self.way, self.mass)
        yield chain(self.way, self.slot)
        yield connect(self.slot.frame_b, self.pin.frame_b)


@cache
def angles(scene: type[Model], method: str, tolerance: float, length: float) -> np.ndarray:
    result = ac.simulate(scene(L=length), stop_time=2.0, tolerance=tolerance, method=method, intervals=100)
    return np.asarray(result["joint.phi"])


@pytest.mark.parametrize("scene", [SliderCrank, Yoke])
@pytest.mark.parametrize("method", ["auto", "rosenbrock", "idas"])
@pytest.mark.parametrize("length", LENGTHS)
def test_angles_do_not_depend_on_the_unit(scene, method, length):
    """Errors are at most some thousand times the tolerance, in metres as well."""
    exact = angles(scene, "auto", 1e-10, 1.0)
    for tolerance, allowed in ((1e-4, 0.1), (1e-6, 5e-3)):
        found = angles(scene, method, tolerance, length)
        within(f"angle in units of {1 / length:g} m at {tolerance:g}, rad", np.max(np.abs(found - exact)), allowed)


@pytest.mark.parametrize("length", LENGTHS)
def test_angles_are_independent_in_any_unit(length):
    """The slide does not tell the crank's angle at its dead centres."""
    found = ac.simulate(SliderCrank(L=length), stop_time=0.1).stats["independent_states"]
    assert {name.rpartition(".")[2] for name in found} == {"phi", "w"}


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("length", [1e-3, 1e3])
def test_exported_machines_pass_their_dead_centres(kind, length, tmp_path):
    fmpy = pytest.importorskip("fmpy")

    class Exported(SliderCrank):
        stop_time = 2.0
        tolerance = 1e-6

    ac.export_fmu(Exported(L=length), path := str(tmp_path / "exported.fmu"))
    found = fmpy.simulate_fmu(path, fmi_type=kind, stop_time=2.0, output_interval=0.02, output=["joint.phi"])
    exact = angles(SliderCrank, "auto", 1e-10, 1.0)
    at = np.linspace(0, 2, len(exact))
    within("angle, rad", np.max(np.abs(np.interp(at, found["time"], found["joint.phi"]) - exact)), 5e-3)


class Damped(Yoke):
    """A yoke with a damper in the bearing of the crank."""

    joint = Revolute(phi=fixed(0.3), w=fixed(4.0), use_axis_flange=True)
    damper = rotational.Damper(d=0.02)

    def connections(self):
        yield from super().connections()
        yield connect(self.damper.flange_a, self.joint.support)
        yield connect(self.damper.flange_b, self.joint.axis)


@pytest.mark.parametrize("method", ["auto", "rosenbrock", "idas"])
def test_energies_do_not_depend_on_outputs(method):
    """States are chosen anew between outputs, by IDAS some times in a turn."""
    few, many = (
        ac.simulate(Damped(), stop_time=2.0, tolerance=1e-6, method=method, intervals=n, energy=True).stats
        for n in (2, 100)
    )
    assert few["energy_dissipated"] == pytest.approx(many["energy_dissipated"], rel=1e-6)
