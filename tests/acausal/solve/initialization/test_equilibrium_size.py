"""Static starts of long chains: the right place, by few factorisations, whatever the size."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
import scipy

import acausal as ac
from acausal import Model, chain, connect, guess, structural
from acausal.solve.initialization import minimum_norm_step, reduced_linearization
from components import BodyRod, Fixed, FixedRotation, Revolute, SubstructuredBeam, World, WorldForce


def leg(volumes: int) -> SubstructuredBeam:
    return SubstructuredBeam(
        length=1, E=2.1e11, rho=7800, A=5e-3, J=0.1 * 0.05**3 / 12, volumes=volumes, geometric_stiffness=True, beta=1e-3
    )


class Frame(Model):
    """Two legs at a right angle under a dead load that bends them round."""

    volumes: int = structural("volumes of each leg", default=4)
    world, load = World(gravity=None), WorldForce(force=(1e6, 0, 0))
    corner = FixedRotation(n=(0, 0, 1), angle=pi / 2)

    @ac.part
    def one(self):
        """Leg at the wall."""
        return leg(self.volumes)

    @ac.part
    def other(self):
        """Leg with the load."""
        return leg(self.volumes)

    def connections(self):
        yield chain(self.world, self.one, self.corner, self.other, self.load)


class Rope(Model):
    """Rods between two hooks."""

    links: int = structural("number of rods", default=30)
    world, end, hook = World(g=9.81), Revolute(), Fixed(r=(0.8, 0, 0))

    @ac.parts
    def joints(self):
        """Pins."""
        return [Revolute(phi=guess(-0.9 if k == 0 else 1.8 / (self.links - 1))) for k in range(self.links)]

    @ac.parts
    def rods(self):
        """Rods, 1 m in all."""
        return [BodyRod(r=(1.0 / self.links, 0, 0), m=1.0 / self.links) for _ in range(self.links)]

    def connections(self):
        yield chain(self.world, *(part for pair in zip(self.joints, self.rods, strict=True) for part in pair))
        yield connect(self.rods[-1].frame_b, self.end.frame_a)
        yield connect(self.end.frame_b, self.hook.frame_b)


@pytest.mark.parametrize("volumes", [4, 12, pytest.param(20, marks=pytest.mark.slow)])
def test_a_frame_bends_to_the_same_place(volumes: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Geometrically exact beams of another program: within some 1e-3 with 4 volumes, and by the square of their length."""
    calls = []
    own = reduced_linearization.Linearizer.linearized
    monkeypatch.setattr(
        reduced_linearization.Linearizer, "linearized", lambda self, at: calls.append(1) or own(self, at)
    )
    run = ac.simulate(Frame(volumes=volumes), stop_time=0.01, intervals=2, initial="steady")
    moved = run["other.frame_b.r_0"][:, :2] - 1
    np.testing.assert_allclose(moved[0], [0.858653, -0.914174], atol=0.006 / volumes**2)
    np.testing.assert_allclose(moved, moved[:1].repeat(3, axis=0), atol=1e-6)
    assert len(calls) < 400


@pytest.mark.parametrize("links", [10, pytest.param(40, marks=pytest.mark.slow)])
def test_a_rope_hangs_in_a_catenary(links: int) -> None:
    """A rope of length s over a span l sags by a (cosh(l / 2a) - 1), with 2 a sinh(l / 2a) = s; one of rods by nearly as much."""
    run = ac.simulate(Rope(links=links), stop_time=1e-3, intervals=2, initial="steady")
    middle = run[f"rods[{links // 2}].frame_a.r_0"]
    u = float(scipy.optimize.brentq(lambda u: np.sinh(u) / u - 1 / 0.8, 0.5, 2.0, xtol=1e-12))
    a = 0.4 / u
    np.testing.assert_allclose(middle[0, :2], [0.4, -a * (np.cosh(u) - 1)], atol=0.6 / links**2)
    np.testing.assert_allclose(middle, middle[:1].repeat(3, axis=0), atol=1e-6)


def test_orthogonal_factors_give_the_step_of_singular_values(monkeypatch: pytest.MonkeyPatch) -> None:
    random = np.random.default_rng(1)
    J = random.standard_normal((140, 120)) * 10.0 ** random.uniform(-4, 4, 120)
    value, way, scale = random.standard_normal(140), random.standard_normal(120), 10.0 ** random.uniform(-2, 2, 120)
    quick = minimum_norm_step.minimum_norm_step(value, J, way, scale)
    monkeypatch.setattr(minimum_norm_step, "_determined", lambda *_: None)
    slow = minimum_norm_step.minimum_norm_step(value, J, way, scale)
    np.testing.assert_allclose(quick[0], slow[0], rtol=1e-8)
    np.testing.assert_allclose(quick[1], slow[1], atol=1e-12)


def test_rows_that_leave_something_free_keep_to_singular_values() -> None:
    random = np.random.default_rng(2)
    J = random.standard_normal((140, 119)) @ random.standard_normal((119, 120))
    way = random.standard_normal(120)
    step, free = minimum_norm_step.minimum_norm_step(np.zeros(140), J, way, np.ones(120))
    null = np.linalg.svd(J)[2][-1]
    np.testing.assert_allclose(step, 0, atol=1e-12)
    np.testing.assert_allclose(free, null * (null @ way), atol=1e-9)
