"""Bodies from FE matrices in place of beams: on the hub, and as coupler in closed loops."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import acausal as ac
from acausal import chain, connect
from components import FixedRotation, FixedTranslation
from components.fe import FEBody, ReducedBody, box, reduce_body, rigid
from models import FourBar, SliderCrank, SpinUp
from tests.components.fe.moving import ends
from tests.reference import cantilever


@cache
def bar(
    length: float,
    area: float,
    J: float,
    E: float,
    rho: float,
    elements: int,
    modes: int,
    basis: str = "held",
    welded: bool = False,
) -> ReducedBody:
    """A bar of hex20 whose height follows from J / A; the modulus and the density give it the stiffness and mass of the beam."""
    height, width = np.sqrt(12 * J / area), 0.06
    scale = area / (height * width)
    M, K, nodes = box((length, height, width), (elements, 1, 1), "hex20", E=E * scale, nu=0.0, rho=rho * scale)
    frames = {name: rigid(at) for name, at in ends(nodes).items()} if welded else ends(nodes)
    return reduce_body(M, K, nodes, frames=frames, hold="frame_a", modes=modes, basis=basis)


HUB = (8.0, 7.299e-5, 8.214e-9, 6.895e10, 2767.0)


class OnHub(SpinUp):
    """The beam of the scene as 40 elements."""

    @ac.part
    def beam(self):
        return FEBody(reduced=bar(*HUB, 40, 10), check_range=False)


def test_spin_up_is_that_of_a_linear_body():
    """Without stiffening; the true beam deflects by 0.2804 m."""
    result = ac.simulate(OnHub(omega=2.0), stop_time=20.0, tolerance=1e-8)
    assert result["tip_deflection"].min() == pytest.approx(-0.3436, abs=1e-4)


class InARow(SpinUp):
    """The beam as several bodies, each in a frame of its own."""

    bodies = ac.structural("number of bodies", default=2)

    @ac.parts
    def links(self):
        length, *section = HUB
        body = bar(length / self.bodies, *section, 40 // self.bodies, 6, "craig-bampton", welded=True)
        return [FEBody(reduced=body, check_range=False) for _ in range(self.bodies)]

    @ac.part
    def beam(self):
        return FixedTranslation(r=(0, 0, 0))

    def connections(self):
        yield chain(self.world, self.hub, *self.links, self.beam)
        yield connect(self.drive.flange, self.hub.axis)


def test_bodies_in_a_row_stiffen_as_the_true_beam():
    found = []
    for bodies in (2, 4, 8):
        result = ac.simulate(InARow(bodies=bodies, omega=2.0), stop_time=20.0, tolerance=1e-6)
        found.append(abs(result["tip_deflection"].min() + 0.2804))
    assert found[2] < 2e-3
    assert found[0] > 2 * found[1] > 4 * found[2]


@pytest.mark.parametrize(("elements", "share"), [(40, 1.5e-3), (80, 5e-5)])
def test_frequencies_in_the_plane_are_those_of_the_beam(elements, share):
    length, area, J, E, rho = HUB
    exact = cantilever.bending_frequencies(length, rho * area, E * J, 3) / (2 * np.pi)
    found = bar(*HUB, elements, 10).frequencies
    nearest = [found[np.argmin(np.abs(found - f))] for f in exact]
    np.testing.assert_allclose(nearest, exact, rtol=share)


class Coupled(SliderCrank):
    """The rod of the slider-crank as 16 elements, its crank rigid."""

    crank = ac.effect("elasticity of the crank", default="rigid", choices=("rigid",))
    hold = ac.structural("frame that is the reference frame", default="frame_a")

    @ac.part
    def rod_bar(self):
        return FEBody(reduced=coupler(self.hold))

    def equations(self):
        yield from (self.crank_angle == self.bearing.phi, self.slider_position == self.guide.s)
        yield from (self.rod_tip_deflection == 0, self.rod_mid_deflection == 0)


@cache
def coupler(hold: str) -> ReducedBody:
    area, J, length = 0.7854e-4, 4.909e-10, 0.304
    height, width = np.sqrt(12 * J / area), 0.01
    scale = area / (height * width)
    M, K, nodes = box((length, height, width), (16, 1, 1), "hex20", E=5e7 * scale, nu=0.0, rho=2770.0 * scale)
    return reduce_body(M, K, nodes, frames=ends(nodes), hold=hold, modes=6)


@pytest.mark.parametrize("hold", ["frame_a", "mean-axis"])
def test_coupler_of_the_slider_crank(hold):
    """Without a hint, it moves as the linear beam of the scene does."""
    beam = ac.simulate(SliderCrank(crank="rigid", rod_volumes=1), stop_time=0.7, tolerance=1e-5)
    found = ac.simulate(Coupled(hold=hold), stop_time=0.7, tolerance=1e-5)
    np.testing.assert_allclose(found["slider_position"], beam["slider_position"], atol=1e-4)


class FEFourBar(FourBar):
    """The coupler of the four-bar as a bar of bricks between its ends."""

    b2 = None

    @ac.part
    def before(self):
        return FixedRotation(n=(0, 0, 1), angle=np.arctan2(1.1, 0.1))

    @ac.part
    def coupler(self):
        M, K, nodes = box((np.hypot(0.1, 1.1), 0.05, 0.05), (12, 1, 1), "hex8", E=7e10, nu=0.3, rho=7700.0)
        return FEBody(reduced=reduce_body(M, K, nodes, frames=ends(nodes), hold="frame_a", modes=4))

    @ac.part
    def after(self):
        return FixedRotation(n=(0, 0, 1), angle=-np.arctan2(1.1, 0.1))

    def connections(self):
        through = (self.before, self.coupler, self.after)
        yield chain(self.world, self.j1, self.b1, self.j2, *through, self.j4, self.b4.frame_b)
        yield chain(self.world, self.b3, self.j3, self.b4)
        yield connect(self.j1.support, self.damper.flange_a)
        yield connect(self.damper.flange_b, self.j1.axis)


def test_coupler_of_the_four_bar():
    """A stiff one moves nearly as the rigid one of the same size and density."""
    rigid = ac.simulate(FourBar(), stop_time=1.5, tolerance=1e-6)
    found = ac.simulate(FEFourBar(), stop_time=1.5, tolerance=1e-6)
    np.testing.assert_allclose(found["j1_phi"], rigid["j1_phi"], atol=3e-3)
    assert np.abs(found["j1_phi"] - rigid["j1_phi"]).max() > 1e-4
