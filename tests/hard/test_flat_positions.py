"""Parallelograms through and from their flat position, where the constraints lose rank and the velocity alone decides."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Model, chain, fixed, guess, structural
from acausal.core import library
from components import BodyRod, Fixed, Revolute, World
from models import NFourBar
from tests.hard.measure import single_coordinate, within
from tests.reference import n_four_bar
from tests.shared import pairwise


class Parallelogram(Model):
    """Crank and rocker of 1 m, coupler and ground of 2 m, uniform rods of 1 kg for each metre, flat at the start."""

    gravity: float = structural("acceleration of gravity", default=9.81)
    angle: float = structural("angle of crank and rocker at the start", default=0.0)
    rates: tuple[float, float] = structural("speeds of crank and rocker at the start", default=(1.0, 1.0))
    given: bool = structural("whether the rocker's speed is given too", default=True)
    world, far = World(g=gravity), Fixed(r=(2, 0, 0))
    crank, rocker, coupler = BodyRod(r=(1, 0, 0), m=1), BodyRod(r=(1, 0, 0), m=1), BodyRod(r=(2, 0, 0), m=2)
    pin2 = Revolute()

    @ac.part
    def pin1(self):
        """Pin between crank and coupler."""
        return Revolute(phi=guess(-self.angle))

    @ac.part
    def foot1(self):
        """Bearing of the crank."""
        return Revolute(phi=fixed(self.angle), w=fixed(self.rates[0]))

    @ac.part
    def foot2(self):
        """Bearing of the rocker."""
        rate = {"w": fixed(self.rates[1])} if self.given else {}
        return Revolute(phi=guess(self.angle), **rate)

    def connections(self):
        yield chain(self.world, self.foot1, self.crank, self.pin1, self.coupler, self.pin2, self.rocker.frame_b)
        yield chain(self.far, self.foot2, self.rocker)


FLAT = pytest.mark.xfail(
    strict=True, reason="where branches cross, some of them cannot be followed through flat positions"
)


def swing(times: np.ndarray, angle: float, rate: float, gravity: float = 9.81) -> np.ndarray:
    """Angle from the x axis of the parallelogram, whose coupler only shifts: (2/3 + 2) th'' = -(1 + 2) g cos th."""

    def derivative(_: float, state: np.ndarray) -> list[float]:
        return [state[1], -gravity * np.cos(state[0]) * 3 / (2 / 3 + 2)]

    return solve_ivp(derivative, (0, times[-1]), [angle, rate], "DOP853", times, rtol=1e-12, atol=1e-13).y[0]


@pytest.mark.parametrize("angle", [0.0, pytest.param(np.pi, marks=[FLAT, pytest.mark.slow])])
@pytest.mark.parametrize("rate", [2.0, -1.0, 8.0])
@pytest.mark.parametrize("gravity", [0.0, 9.81])
def test_parallelogram_from_its_flat_position(angle, rate, gravity):
    """Equal speeds choose the branch on which the rods stay parallel; at 8 rad/s it turns through flat again and again."""
    model = Parallelogram(angle=angle, rates=(rate, rate), gravity=gravity)
    result = ac.simulate(model, stop_time=4.0, tolerance=1e-8, intervals=100)
    expected = swing(result.time, angle, rate, gravity)
    within("crank, rad", np.abs(result["foot1.phi"] - expected).max(), 1e-3)
    # The loop's gape, 1e-8, counts as its root in the angle between the branches where they meet.
    within("rocker less crank, rad", np.abs(result["foot2.phi"] - result["foot1.phi"]).max(), 1e-4)


@pytest.mark.parametrize("angle", [0.1, 1e-2, 1e-4])
def test_parallelogram_from_near_its_flat_position(angle):
    """One speed is enough, since the pose tells the branch; it moves away through flat at once and comes back."""
    model = Parallelogram(angle=angle, rates=(-1.0, 0.0), given=False)
    result = ac.simulate(model, stop_time=2.0, tolerance=1e-8, intervals=100)
    within("crank, rad", np.abs(result["foot1.phi"] - swing(result.time, angle, -1.0)).max(), 1e-3)
    within("rocker less crank, rad", np.abs(result["foot2.phi"] - result["foot1.phi"]).max(), 1e-4)


class Watched(Parallelogram):
    """The same, with something to happen."""

    turns: ac.Scalar = ac.discrete("half turns of the crank", start=0)

    def equations(self):
        yield ac.when(ac.cos(self.foot1.phi) < -0.9, ac.reinit(self.turns, self.turns + 1))


@pytest.mark.skipif(library() is None, reason="needs the core")
@pytest.mark.parametrize(("tolerance", "intervals", "kind"), pairwise([1e-3, 1e-6], [4, 400], [Parallelogram, Watched]))
def test_the_method_that_damps_tells_where_it_passed_a_flat_position(tolerance, intervals, kind):
    model, end = kind(angle=2.0, rates=(2.0, 2.0), gravity=0.0), 1.2
    with pytest.warns(ac.AcausalWarning, match="passes a singular configuration") as caught:
        result = ac.simulate(model, stop_time=end, tolerance=tolerance, intervals=intervals, method="rosenbrock")
    (text,) = [str(w.message) for w in caught]
    assert float(text.split("t = ")[1].split(" s")[0]) == pytest.approx((np.pi - 2) / 2, abs=2e-3)
    assert result.stats.doubts == [text]
    # Nor does it say so before, and the others keep to the branch.
    for method, until in (("rosenbrock", 0.5), ("auto", end), ("idas", end)):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            ac.simulate(model, stop_time=until, tolerance=tolerance, intervals=intervals, method=method)


def test_both_speeds_of_a_loop():
    """A condition too many that agrees with the others is taken."""
    model = Parallelogram(angle=0.5, rates=(1.0, 1.0))
    result = ac.simulate(model, stop_time=1.0, tolerance=1e-8, intervals=20)
    within("crank, rad", np.abs(result["foot1.phi"] - swing(result.time, 0.5, 1.0)).max(), 1e-5)


# tan(psi / 2) = -3 tan(phi / 2): the rods cross; from the cosine rule with the sides 1 and 2.
RATIO = -3.0


def crossed(phi: float | np.ndarray) -> float | np.ndarray:
    """Angle of the rocker of the antiparallelogram, continuous over whole turns."""
    c, s = np.cos(phi / 2), np.sin(phi / 2)
    return phi + 2 * np.arctan2((RATIO - 1) * s * c, c**2 + RATIO * s**2)


def crossed_inertia(phi: float) -> tuple[float, float]:
    """Twice the kinetic energy of the antiparallelogram at crank speed 1, and its derivative by the crank's angle.

    The loop |d| = 2 with the coupler d = 2 + exp(i psi) - exp(i phi) differentiates to Re(conj(d) d') = 0; the coupler
    turns with Im(conj(d) d') / |d|^2. The half angles give psi' = RATIO / (cos^2 + RATIO^2 sin^2).
    """
    c, s = np.cos(phi / 2), np.sin(phi / 2)
    below = c**2 + RATIO**2 * s**2
    slope, bend = RATIO / below, -RATIO * (RATIO**2 - 1) * s * c / below**2
    crank, rocker = np.exp(1j * phi), np.exp(1j * crossed(phi))
    coupler = 2 + rocker - crank
    first = 1j * slope * rocker - 1j * crank
    second = (1j * bend - slope**2) * rocker + crank
    turn, turning = np.imag(np.conj(coupler) * first) / 4, np.imag(np.conj(coupler) * second) / 4
    centre, centre_bend = (1j * crank + 1j * slope * rocker) / 2, (-crank + (1j * bend - slope**2) * rocker) / 2
    inertia = 1 / 3 + slope**2 / 3 + 2 * abs(centre) ** 2 + 2 * 4 / 12 * turn**2
    by_angle = 2 * slope * bend / 3 + 4 * np.real(np.conj(centre) * centre_bend) + 4 * 4 / 12 * turn * turning
    return float(inertia), float(by_angle)


def test_the_closed_form_of_the_antiparallelogram_closes():
    phi = np.linspace(-2, 2, 41)
    np.testing.assert_allclose(abs(2 + np.exp(1j * crossed(phi)) - np.exp(1j * phi)), 2, atol=1e-12)


@pytest.mark.parametrize("phi", [-2.0, -0.4, 0.0, 0.3, 1.0, 3.0])
def test_the_inertia_of_the_antiparallelogram_is_that_of_small_differences(phi):
    step = 1e-5
    ends = phi + step * np.array([-1, 1])
    crank, rocker = np.exp(1j * ends), np.exp(1j * crossed(ends))
    coupler = 2 + rocker - crank
    slope = np.ptp(crossed(ends)) / (2 * step)
    centre = abs(np.diff(crank + rocker)[0] / 2) / (2 * step)
    turn = np.angle(coupler[1] / coupler[0]) / (2 * step)
    inertia, by_angle = crossed_inertia(phi)
    assert inertia == pytest.approx(1 / 3 + slope**2 / 3 + 2 * centre**2 + 2 * 4 / 12 * turn**2, rel=1e-8)
    below, above = (crossed_inertia(end)[0] for end in ends)
    assert by_angle == pytest.approx((above - below) / (2 * step), abs=1e-7)


@FLAT
@pytest.mark.parametrize("rate", [1.0, -2.0])
def test_antiparallelogram_from_its_flat_position(rate):
    """Speeds in the ratio of the crossed branch choose that one."""
    model = Parallelogram(rates=(rate, RATIO * rate), gravity=0.0)
    result = ac.simulate(model, stop_time=6.0, tolerance=1e-8, intervals=100)
    within("rocker, rad", np.abs(result["foot2.phi"] - crossed(result["foot1.phi"])).max(), 1e-3)
    expected = single_coordinate(crossed_inertia, result.time, 0.0, rate)
    within("crank, rad", np.abs(result["foot1.phi"] - expected).max(), 1e-3)


def test_one_speed_does_not_choose_a_branch():
    with pytest.raises(ac.InitializationError, match=r"1 start value is missing[\s\S]*w=fixed"):
        ac.simulate(Parallelogram(given=False), stop_time=1.0)


class Many(NFourBar):
    """The scene, flat at the start."""

    @ac.parts
    def foot(self):
        """All speeds are equal: the rods stay parallel."""
        start = -np.pi / 2
        return [
            Revolute(phi=fixed(start), w=fixed(-1)),
            *(Revolute(phi=guess(start), w=fixed(-1)) for _ in range(self.N)),
        ]


@FLAT
@pytest.mark.parametrize("N", [1, 3])
def test_n_four_bar_from_its_flat_position(N):
    result = ac.simulate(Many(N=N), stop_time=3.0, tolerance=1e-8, intervals=60)
    inertia, moment = n_four_bar.inertia_and_moment(N)

    def derivative(_: float, state: np.ndarray) -> list[float]:
        return [state[1], -moment / inertia * 9.81 * np.cos(state[0])]

    th = solve_ivp(derivative, (0, 3.0), [0.0, -1.0], "DOP853", result.time, rtol=1e-12, atol=1e-13).y[0]
    for k in range(N + 1):
        within(f"upright {k}, rad", np.abs(result[f"foot[{k}].phi"] + np.pi / 2 - th).max(), 1e-3)
