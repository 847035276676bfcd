"""Constraints of parts that follow from one another: the motion, and how they share what works on them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import connect, fixed
from components import Body
from tests.acausal.flatten.test_loops_in_parts import Linkage
from tests.acausal.solve.wheels import (
    ACROSS,
    AHEAD,
    HALF,
    MASS,
    RADIUS,
    SPIN,
    WHEEL,
    Car,
    OneAxle,
    OnRails,
    Robot,
    Sleigh,
    Slipping,
    ThreeSkates,
    TwoSkates,
    Wheelset,
)


def run(model: ac.Model, stop_time: float = 1, **given: object) -> ac.Result:
    return ac.simulate(model, stop_time=stop_time, tolerance=1e-8, **given)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("model", "names"),
    [(Sleigh, ("skate",)), (TwoSkates, ("skate", "other")), (ThreeSkates, ("skate", "other", "middle"))],
)
def test_skates_side_by_side_share_one_force(model: type[ac.Model], names: Sequence[str]) -> None:
    result, t = run(model()), np.linspace(0, 1, 401)
    np.testing.assert_allclose(result["x.s"], np.sin(2 * t) / 2, atol=1e-6)
    np.testing.assert_allclose(result["y.s"], (1 - np.cos(2 * t)) / 2, atol=1e-6)
    for name in names:  # m v w = 2 N towards the centre, equal parts being the least
        np.testing.assert_allclose(result[f"{name}.f"], 2 / len(names), rtol=1e-6)


@pytest.mark.parametrize("method", ["idas", "rosenbrock"])
def test_any_method_does(method: str) -> None:
    result = run(TwoSkates(), method=method)
    np.testing.assert_allclose(result["skate.f"] + result["other.f"], 2, rtol=1e-5)
    assert result["x.s"][-1] == pytest.approx(np.sin(2) / 2, abs=1e-5)


def test_the_report_names_what_was_dropped() -> None:
    def dropped(model: ac.Model) -> list[str]:
        return [one["constraint"].partition(",")[0] for one in run(model).stats["redundant_in_parts"]]

    assert dropped(Sleigh()) == []
    assert dropped(TwoSkates()) == ["other (Skate)"]
    assert dropped(ThreeSkates()) == ["other (Skate)", "middle (Skate)"]
    assert dropped(OnRails()) == ["skate (Skate)"]
    assert [one.partition(" ")[0] for one in dropped(Wheelset())] == ["two"]


def test_a_skate_that_holds_nothing_is_no_error() -> None:
    result = run(OnRails())
    np.testing.assert_allclose(result["x.s"], np.linspace(0, 1, 401), atol=1e-9)
    np.testing.assert_array_equal(result["skate.f"], 0)


def test_axles_that_meet_in_one_point_stay_redundant() -> None:
    result = run(Car())
    curvature = 0.8 * result.time**3
    np.testing.assert_allclose(result["turn.w"], curvature * result["x.v"] / np.cos(result["turn.phi"]), atol=1e-6)
    back, (left, right) = result["one.f"] + result["two.f"], (result["steer_left.phi"], result["steer_right.phi"])
    front = result["three.f"] * np.cos(left) + result["four.f"] * np.cos(right)
    speed = np.hypot(result["x.v"], result["y.v"])
    np.testing.assert_allclose(back + front, speed * result["turn.w"], atol=1e-5)  # m v w to the side
    energy = speed**2 / 2 + 0.1 * result["turn.w"] ** 2 / 2
    np.testing.assert_allclose(energy, 0.5, rtol=1e-5)


class OneWithArm(Sleigh):
    arm = Linkage()

    def connections(self):
        yield from super().connections()
        yield connect(self.turn.frame_b, self.arm.base)


class TwoWithArm(TwoSkates):
    """A closed loop on a sleigh with a redundant skate."""

    arm = Linkage()

    def connections(self):
        yield from super().connections()
        yield connect(self.turn.frame_b, self.arm.base)


def test_a_loop_beside_redundant_skates_changes_nothing() -> None:
    one, two = run(OneWithArm()), run(TwoWithArm())
    for name in ("x.s", "y.s", "turn.phi", "arm.j1.phi"):
        np.testing.assert_allclose(one[name], two[name], atol=1e-6)
    np.testing.assert_allclose(two["skate.f"], two["other.f"], rtol=1e-6)
    np.testing.assert_allclose(two["skate.f"] + two["other.f"], one["skate.f"], atol=1e-5)


def test_a_rigid_wheelset_rolls_straight_on() -> None:
    result = run(Wheelset())
    np.testing.assert_allclose(result["axle.frame_a.r_0"][-1], [1.2, RADIUS, 0], atol=1e-7)
    weights = result["one.force"] + result["two.force"]
    np.testing.assert_allclose(weights, np.tile([0, 2 * 9.81, 0], (len(weights), 1)), atol=1e-6)


def test_both_wheels_in_one_part_share_what_works_on_them() -> None:
    result = run(OneAxle())
    np.testing.assert_allclose(result["axle.frame_a.r_0"][-1], [1.2, RADIUS, 0], atol=1e-6)
    np.testing.assert_allclose(result["wheels.left"], result["wheels.right"], atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(result["wheels.left"], axis=1), 9.81, rtol=1e-6)
    assert np.max(np.abs(result["wheels.left"][:, 2])) < 1e-8, "across the wheels nothing acts"


def test_the_form_of_the_equations_does_not_matter() -> None:
    one, other = run(Robot()), run(Robot(one=Slipping(), two=Slipping()))  # type: ignore[call-arg]
    np.testing.assert_allclose(one["chassis.frame_a.r_0"], other["chassis.frame_a.r_0"], atol=1e-6)
    both = [r["one.force"] + r["two.force"] for r in (one, other)]
    np.testing.assert_allclose(both[0], both[1], atol=1e-4)
    assert len(other.stats["redundant_in_parts"]) == 1


class Circle(Robot):
    chassis = Body(
        m=MASS,
        I=((0.12, 0, 0), (0, 0.2, 0), (0, 0, 0.1)),
        r_0=fixed((0, RADIUS, 0)),
        v_0=fixed((1.2, 0, 0)),
        w_a=fixed((0, 1.5, 0)),
        angles_fixed=True,
    )
    one, two = Slipping(), Slipping()


def test_others_are_dropped_where_those_that_were_become_independent() -> None:
    """The constraints are resolved in the world: sideways is another one after a quarter of a turn."""
    result = run(Circle(), stop_time=3)
    angle = 1.5 * result.time
    np.testing.assert_allclose(result["chassis.frame_a.r_0"][:, 0], 0.8 * np.sin(angle), atol=1e-4)
    side = np.linalg.norm(result["one.force"] + result["two.force"], axis=1)
    np.testing.assert_allclose(side, (MASS + 2 * WHEEL) * 1.2 * 1.5, rtol=1e-4)


def test_a_robot_on_two_wheels_moves_as_the_equivalent_sleigh() -> None:
    """Chaplygin's sleigh: M v' = m d w^2, I w' = -m d v w."""
    mass = MASS + 2 * WHEEL + 2 * SPIN / RADIUS**2
    inertia = 0.2 + MASS * AHEAD**2 + 2 * (WHEEL * HALF**2 + ACROSS) + 2 * SPIN * HALF**2 / RADIUS**2

    def rates(_: float, state: np.ndarray) -> list[float]:
        angle, _, _, v, w = state
        pull = MASS * AHEAD
        return [w, v * np.cos(angle), -v * np.sin(angle), pull * w**2 / mass, -pull * v * w / inertia]

    result = run(Robot(), stop_time=3)
    right = solve_ivp(rates, (0, 3), [0, 0, 0, 1.2, 0.8], rtol=1e-11, atol=1e-12, t_eval=result.time).y
    np.testing.assert_allclose(result["chassis.frame_a.r_0"][:, [0, 2]], right[1:3].T, atol=1e-5)
    np.testing.assert_allclose(result["chassis.frame_a.R.w"][:, 1], right[4], atol=1e-5)
    v, w = result["chassis.frame_a.v"][:, 0], result["chassis.frame_a.R.w"][:, 1]
    np.testing.assert_allclose(mass * v**2 + inertia * w**2, mass * 1.2**2 + inertia * 0.8**2, rtol=1e-5)
    # Both wheels carry the same side force.
    angle = right[0]
    side = [result[f"{name}.force"] @ np.eye(3) for name in ("one", "two")]
    across = [f[:, 0] * np.sin(angle) + f[:, 2] * np.cos(angle) for f in side]
    np.testing.assert_allclose(across[0], across[1], atol=1e-4)
