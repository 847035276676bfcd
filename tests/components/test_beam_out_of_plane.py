"""A planar beam that is loaded across its plane, or twisted, says so where an Euler-Bernoulli beam would move noticeably."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, Vector3, chain, connect, fixed, parameter, structural
from components import (
    Body,
    FixedRotation,
    FlexibleBeam,
    Revolute,
    SubstructuredBeam,
    World,
    WorldForce,
    WorldTorque,
)

L, E, J, J_Y, A, RHO = 2.0, 2e11, 3e-10, 1e-10, 1e-4, 7800.0
PLANAR = {"bending": "xy", "torsion": False}
BEAM = {"length": L, "E": E, "rho": RHO, "A": A, "J": J, "J_y": J_Y, "beta": 1e-3, **PLANAR}
NOTICED = 1e-3
ACROSS, TWISTED = "bending in xz is left out", "torsion is left out"
# Loads that bend a cantilever by 1 / 1000 of its length, and twist a round one by 1 / 1000 rad.
FORCE = NOTICED * L * 3 * E * J_Y / L**3
MOMENT = NOTICED * L * 2 * E * J_Y / L**2
TORQUE = NOTICED * E / 2.6 * (J + J_Y) / L
GRAVITY = NOTICED * L * 8 * E * J_Y / (RHO * A * L**4)


class Cantilever(Model):
    """A beam clamped at one end, with a load at the other."""

    f: Vector3 = parameter("force", unit="N", default=(0, 0, 0))
    t: Vector3 = parameter("torque", unit="N.m", default=(0, 0, 0))
    at_b: bool = structural("whether frame_b is clamped", default=False)
    axis: Vector3 = structural("axis about which the whole scene is turned", default=(0, 0, 1))
    angle: Scalar = structural("angle by which it is", default=0.0)
    world = World(gravity=None)
    turned = FixedRotation(n=axis, angle=angle)
    beam = FlexibleBeam(elements=2, **BEAM)
    force, torque = WorldForce(force=f, resolve_in_frame="frame_b"), WorldTorque(torque=t, resolve_in_frame="frame_b")

    def connections(self):
        held, free = (self.beam.frame_b, self.beam.frame_a) if self.at_b else (self.beam.frame_a, self.beam.frame_b)
        yield chain(self.world, self.turned, held)
        yield connect(self.force.frame_b, free)
        yield connect(self.torque.frame_b, free)


def found(model, **settings):
    doubts = ac.simulate(model, stop_time=0.1, intervals=4, **settings).stats["doubts"]
    return {text for text in (ACROSS, TWISTED) if any(text in doubt for doubt in doubts)}


BEAMS = {
    "tangent": FlexibleBeam(elements=2, **BEAM),
    "one element": FlexibleBeam(elements=1, **BEAM),
    "pinned": FlexibleBeam(elements=2, reference="pinned", **BEAM),
    "volumes": SubstructuredBeam(volumes=4, **BEAM),
}
LOADS = {
    "force": ({"f": (0, 0, FORCE)}, ACROSS),
    "moment": ({"t": (0, MOMENT, 0)}, ACROSS),
    "torque": ({"t": (TORQUE, 0, 0)}, TWISTED),
}


@pytest.mark.parametrize("beam", BEAMS)
@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("at_b", [False, True])
@pytest.mark.filterwarnings("ignore::acausal.AcausalWarning")
def test_loads_that_would_deflect_it_noticeably_are_reported(beam, load, at_b):
    loads, text = LOADS[load]
    for factor, expected in ((0.97, set()), (-1.03, {text})):
        given = {name: tuple(factor * x for x in value) for name, value in loads.items()}
        assert found(Cantilever(beam=BEAMS[beam], at_b=at_b, **given)) == expected


@pytest.mark.parametrize("beam", BEAMS)
@pytest.mark.filterwarnings("ignore::acausal.AcausalWarning")
def test_own_weight_across_the_plane(beam):
    class Shelf(Model):
        g: Scalar = structural("gravity", default=9.81)
        world = World(g=g, n=(0, 0, 1))
        beam = BEAMS["tangent"]

        def connections(self):
            yield chain(self.world, self.beam)

    assert found(Shelf(beam=BEAMS[beam], g=0.97 * GRAVITY)) == set()
    assert found(Shelf(beam=BEAMS[beam], g=1.03 * GRAVITY)) == {ACROSS}


@pytest.mark.filterwarnings("ignore::acausal.AcausalWarning")
def test_a_beam_that_is_swung_across_its_plane():
    class Door(Model):
        """Accelerated about its y axis, with a mass at the tip: the load is m alpha L."""

        world, hinge = World(gravity=None), Revolute(n=(0, 1, 0), phi=fixed(0), w=fixed(0))
        beam, tip = FlexibleBeam(elements=1, **BEAM | {"rho": 1e-3}), Body(m=50)
        torque = WorldTorque(torque=(0, 1, 0))

        def connections(self):
            yield chain(self.world, self.hinge, self.beam, self.tip)
            yield connect(self.torque.frame_b, self.beam.frame_a)

    # Free to turn, nothing holds the root: the moment is that of the mass, M = -t at the root.
    at_limit = FORCE * L
    assert found(Door(torque=WorldTorque(torque=(0, 0.97 * at_limit, 0)))) == set()
    assert found(Door(torque=WorldTorque(torque=(0, 1.03 * at_limit, 0)))) == {ACROSS}


@pytest.mark.parametrize("axis", [(0, 0, 1), tuple(np.array([1, 2, 3]) / np.sqrt(14))])
@pytest.mark.filterwarnings("ignore::acausal.AcausalWarning")
def test_a_large_load_in_its_plane_is_not(axis):
    load = (-3 * FORCE, 20 * FORCE, 0)
    assert found(Cantilever(f=load, axis=axis, angle=1.1)) == set()


def test_the_warning_can_be_left_out_and_says_what_to_do():
    load = {"f": (0, 0, 5 * FORCE), "t": (5 * TORQUE, 0, 0)}
    with pytest.warns(ac.AcausalWarning) as said:
        assert found(Cantilever(**load)) == {ACROSS, TWISTED}
    assert all("use " in str(w.message) and "beam (FlexibleBeam)" in str(w.message) for w in said)
    silent = FlexibleBeam(elements=2, check_range=False, **BEAM)
    assert found(Cantilever(beam=silent, **load)) == set()
