"""Scenes with closed loops against published values and independent solutions; every loop stays closed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import chain, connect
from components import RevolutePlanarLoopConstraint
from models import Bricard, CarAxis, FourBar, FourBarSpatial, Governor, NFourBar, SliderCrank, Squeezer
from tests.reference import bricard, car_axis, four_bar, four_bar_spatial, governor, n_four_bar, slider_crank, squeezer


def planar(result: ac.Result, *arms: tuple[complex, str]) -> np.ndarray:
    """Sum of links of the plane as complex numbers, each turned by the angles of the joints before it."""
    angle, total = np.zeros(len(result.time)), np.zeros(len(result.time), complex)
    for link, joint in arms:
        angle = angle + result[f"{joint}.phi"]
        total = total + link * np.exp(1j * angle)
    return total


def four_bar_gap(result: ac.Result) -> Any:
    tip = planar(result, (0.4, "j1"), (0.1 + 1.1j, "j2"))
    return tip - (-0.15 + 1j) - planar(result, (0.65 + 0.1j, "j3"))


def spatial_gap(result: ac.Result) -> Any:
    q = [result[f"{name}.phi"] for name in ("j1", "j3", "j4", "j5")]
    q += [-result["rev1.phi"], -result["rev.phi"], -(result["j2.s"] + 0.2)]
    loop = four_bar_spatial.loop()
    return [loop.gap(np.concatenate([row, np.zeros(7)])) for row in np.array(q).T]


def bricard_gap(result: ac.Result) -> Any:
    q = [result[f"joint[{k}].phi"] for k in range(6)]
    loop = bricard.loop()
    return [loop.gap(np.concatenate([row, np.zeros(6)])) for row in np.array(q).T]


def squeezer_gap(result: ac.Result) -> Any:
    q = np.array([result[name] for name in result.outputs]).T
    return [squeezer.loops(row, np.zeros(7))[0] for row in q]


def parallel_gap(result: ac.Result) -> Any:
    tips = [planar(result, (1j, f"foot[{i}]")) + i for i in range(len(result.tree.foot))]
    couplers = [planar(result, (1j, f"foot[{i}]"), (1, f"pin[{2 * i}]")) + i for i in range(len(tips) - 1)]
    return np.array(couplers) - tips[1:]


def slider_gap(result: ac.Result) -> Any:
    return planar(result, (0.152, "bearing"), (0.304, "pin")) - result["guide.s"]


def axis_gap(result: ac.Result) -> Any:
    return car_axis.violation(result.time, np.array([result[n] for n in result.outputs]).T)


def crank_reference(times: np.ndarray, **machine: float) -> np.ndarray:
    model = slider_crank.SliderCrank(**machine)
    th = model.simulate(times)[:, 0]
    return np.column_stack([th, model.slider_position(th), 0 * th, 0 * th])


@dataclass(frozen=True)
class Case:
    """A run of a scene: how it is made, its reference, how far its loops gape, and the largest error."""

    make: Callable[[], ac.Model]
    stop: float
    reference: Callable[[np.ndarray], Any]
    gap: Callable[[ac.Result], Any] | None
    error: float
    tolerance: float = 1e-8
    intervals: int = 40


RIGID: dict[str, Any] = {"crank": "rigid", "rod": "rigid"}
LOADED: dict[str, Any] = {"slider_mass": 0.05, "gravity": 9.81}
CASES = {
    "four-bar": Case(FourBar, 5.0, four_bar.FourBar().simulate, four_bar_gap, 1e-4),
    "four-bar-spatial": Case(FourBarSpatial, 2.0, four_bar_spatial.simulate, spatial_gap, 1e-4, intervals=20),
    "bricard": Case(Bricard, 10.0, bricard.point, bricard_gap, 1e-5, intervals=20),
    "squeezer": Case(Squeezer, 0.03, lambda t: squeezer.simulate(t)[:, :7], squeezer_gap, 1e-7, 1e-11),
    "governor": Case(Governor, 10.0, lambda t: governor.simulate(t)[:, :3], None, 1e-5),
    "car-axis": Case(CarAxis, 3.0, lambda t: car_axis.simulate(t)[:, :4], axis_gap, 1e-8, 1e-11),
    "slider-crank": Case(lambda: SliderCrank(**RIGID), 1.6, crank_reference, slider_gap, 1e-5),
    "slider-crank, loaded": Case(
        lambda: SliderCrank(**RIGID, **LOADED), 1.6, lambda t: crank_reference(t, **LOADED), slider_gap, 1e-5
    ),
}
for N in (1, 2, 5, 10):
    CASES[f"n-four-bar, N={N}"] = Case(
        lambda N=N: NFourBar(N=N),
        10.0,
        lambda t, N=N: np.column_stack(n_four_bar.upper_end(t, N)),
        parallel_gap,
        1e-3,
    )
LONG = ("n-four-bar, N=5", "n-four-bar, N=10", "slider-crank, loaded")
NAMES = {name: pytest.param(name, marks=pytest.mark.slow if name in LONG else ()) for name in CASES}
every = pytest.mark.parametrize("name", list(NAMES.values()))


@cache
def run(name: str) -> ac.Result:
    case = CASES[name]
    return ac.simulate(
        case.make(), stop_time=case.stop, tolerance=case.tolerance, intervals=case.intervals, energy=True
    )


ANGLES = ("beta", "theta", "gamma", "phi", "delta", "omega", "epsilon")
SQUEEZED = {
    "beta": 15.81077119629904,
    "theta": -15.75637105984298,
    "gamma": 0.04082224013073101,
    "phi": -0.5347301163226948,
    "delta": 0.5244099658805304,
    "epsilon": 1.048080741042263,
}
# Time, largest |error| / max(1, |value|), values.
Published = tuple[float, float, dict[str, float]]
PUBLISHED: dict[str, tuple[Published, ...]] = {
    "four-bar": ((1.0, 1e-3, {"j1_phi": -1.821068}), (2.0, 1e-3, {"j1_phi": -3.624443})),
    "four-bar-spatial": ((1.0, 1e-3, {"j1_phi": 7.802134, "j1_w": 9.361588}),),
    "bricard": (
        (0.0, 1e-9, {"x": 1.0, "y": -1.0, "z": 0.0}),
        (1.0, 1e-3, {"x": 0.274481319, "y": -0.886707939, "z": -0.462330003}),
        (10.0, 1e-3, {"x": 0.999730987, "y": -0.999999964, "z": -0.000268976}),
    ),
    "n-four-bar, N=2": ((10.0, 1e-3, {"b0_x": 0.328458111538, "b0_y": 0.944518538179}),),
    "governor": (
        (0.0, 1e-12, {"s": 0.5, "rod_angle": np.pi / 6, "shaft_angle": 0.0}),
        (0.5, 1e-3, {"s": 0.743249425}),
        (10.0, 1e-3, {"s": 0.619623}),
    ),
    "squeezer": ((0.0, 1e-12, dict(zip(ANGLES, squeezer.START, strict=True))), (0.03, 1e-6, SQUEEZED)),
    "car-axis": (
        (0.0, 1e-12, {"xl": 0.0, "yl": 0.5, "xr": 1.0, "yr": 0.5}),
        (3.0, 1e-7, {"xl": 0.0493455784275403, "yl": 0.496989460230171}),
        (3.0, 1e-7, {"xr": 1.04174252488542, "yr": 0.373911027265361}),
    ),
}


@pytest.mark.parametrize("name", PUBLISHED)
def test_published_values(name):
    result = run(name)
    for at, bound, values in PUBLISHED[name]:
        row = int(np.argmin(np.abs(result.time - at)))
        assert result.time[row] == pytest.approx(at, abs=1e-12)
        for output, value in values.items():
            assert result[output][row] == pytest.approx(value, abs=bound * max(1, abs(value))), output


@every
def test_reference(name):
    case, result = CASES[name], run(name)
    expected = np.asarray(case.reference(result.time))
    for k, output in enumerate(result.outputs):
        error = np.abs(result[output] - expected[:, k]) / np.maximum(1, np.abs(expected[:, k]))
        assert error.max() < case.error, output


@pytest.mark.parametrize("name", [NAMES[name] for name, case in CASES.items() if case.gap])
def test_loops_stay_closed(name):
    case = CASES[name]
    assert case.gap is not None
    assert np.abs(case.gap(run(name))).max() <= 10 * case.tolerance


EXCHANGED = {"four-bar": 22, "bricard": 29, "squeezer": 0.5, "governor": 237, "car-axis": 3e-4, "slider-crank": 0.01}


@every
def test_energy_is_kept(name):
    """What the method itself loses is little of what the motion exchanges."""
    scene, _, N = name.partition(", N=")
    exchanged = 15 * int(N) if N else EXCHANGED[scene.removesuffix("-spatial").removesuffix(", loaded")]
    assert abs(run(name).stats["energy_method"]) < 1e-5 * exchanged


def test_angular_momentum_of_the_governor():
    result = run("governor")
    inertia = governor.spin_inertia(result["rod_angle"])[0]
    np.testing.assert_allclose(inertia * result["bearing.w"], inertia[0] * 2 * np.pi, rtol=1e-6)
    np.testing.assert_allclose(result["hinge1.phi"], result["hinge2.phi"], atol=1e-6)


class ByConstraint(FourBar):
    """The same four-bar, closed by the joint that Modelica's users know."""

    j4 = RevolutePlanarLoopConstraint()


def test_four_bar_closed_by_a_planar_constraint():
    result = ac.simulate(ByConstraint(), stop_time=2.0, tolerance=1e-8, intervals=20)
    expected = four_bar.FourBar().simulate(result.time)
    np.testing.assert_allclose(result["j1_phi"], expected[:, 0], atol=1e-4)
    assert np.abs(four_bar_gap(result)).max() <= 1e-7


class Backwards(FourBar):
    """The same four-bar, connected from the other side: the loop is closed elsewhere."""

    def connections(self):
        yield chain(self.world, self.b3, self.j3, self.b4)
        yield connect(self.b4.frame_b, self.j4.frame_b)
        yield connect(self.j4.frame_a, self.b2.frame_b)
        yield connect(self.b2.frame_a, self.j2.frame_b)
        yield connect(self.j2.frame_a, self.b1.frame_b)
        yield connect(self.b1.frame_a, self.j1.frame_b)
        yield connect(self.j1.frame_a, self.world.frame_b)
        yield connect(self.j1.support, self.damper.flange_a)
        yield connect(self.damper.flange_b, self.j1.axis)


def test_order_of_connections_does_not_matter():
    result = ac.simulate(Backwards(), stop_time=2.0, tolerance=1e-8, intervals=20)
    expected = four_bar.FourBar().simulate(result.time)
    np.testing.assert_allclose(result["j1_phi"], expected[:, 0], atol=1e-4)


@pytest.mark.parametrize(("crank", "rod"), [("rigid", "elastic"), ("elastic", "rigid")])
def test_stiff_slider_crank_is_the_rigid_one(crank, rod):
    """Crank 10 times, rod 200 times as stiff in bending and stretch."""
    parameters = {f"{n}_bar.E": 1e10 for n, kind in (("crank", crank), ("rod", rod)) if kind == "elastic"}
    model = SliderCrank(crank=crank, rod=rod, crank_elements=1, rod_elements=1)
    result = ac.simulate(model, stop_time=0.6, tolerance=1e-5, intervals=12, parameters=parameters)
    expected = crank_reference(result.time)
    np.testing.assert_allclose(result["crank_angle"], expected[:, 0], atol=1e-3)
    np.testing.assert_allclose(result["slider_position"], expected[:, 1], atol=1e-4)
    assert np.abs(result["rod_tip_deflection"]).max() < 1e-4


def test_slider_crank_refuses_elements_that_do_not_fill_the_volumes():
    with pytest.raises(ac.DeclarationError, match="must divide rod_elements"):
        ac.compile(SliderCrank(rod_elements=9, rod_volumes=4))


@pytest.mark.slow
def test_elastic_slider_crank():
    """Little differs from the rigid one; one frame and four volumes of the same elements differ in stiffness alone."""
    how = {"stop_time": 0.5, "tolerance": 1e-4, "intervals": 50}
    rigid = ac.simulate(SliderCrank(**RIGID), **how)
    one = ac.simulate(SliderCrank(crank="rigid"), **how)
    four = ac.simulate(SliderCrank(crank="rigid", rod_volumes=4), **how)
    both = ac.simulate(SliderCrank(), **how)
    for result in (one, four, both):
        np.testing.assert_allclose(result["slider_position"], rigid["slider_position"], atol=5e-3)
        assert 1e-4 < np.abs(result["rod_mid_deflection"]).max() < 5e-3
        assert result["slider_position"][0] == pytest.approx(0.456, abs=1e-12)
    np.testing.assert_allclose(four["rod_mid_deflection"], one["rod_mid_deflection"], atol=2e-4)
