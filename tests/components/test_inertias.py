"""Inertia tensors: impossible ones are refused, unusual ones taken with a warning, and only changed ones checked again."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import DeclarationError, Model, chain, fixed
from acausal.language.validity_statements import Requirement
from components import Body, BodyRod, BodyShape, Revolute, World


class Held(Model):
    world = World(gravity=None)
    hinge = Revolute(n=(1, 2, 3), phi=fixed(0), w=fixed(1))
    it = Body(m=1)

    def connections(self):
        yield chain(self.world, self.hinge, self.it)


def turned(I):
    """The tensor in other axes."""
    Q, _ = np.linalg.qr(np.array([[1.0, 2, 0.5], [-0.3, 1, 2], [0.7, 0.2, 1]]))
    return Q @ I @ Q.T


IMPOSSIBLE = [
    (-np.eye(3), "negative moment of inertia about x"),
    (np.diag([0.0, 0, -1]), "negative moment of inertia about z"),
    (turned(np.diag([1.0, 1, -0.5])), "negative (principal )?moment"),
    (np.array([[1, 1.1, 0], [1.1, 1, 0], [0, 0, 1]]), "negative principal moment"),
    (turned(np.diag([1.0, 3, -1e-10])), "negative principal moment"),
    (np.array([[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]), r"not symmetric: I\[0,1\] is 0.1 and I\[1,0\] is 0"),
    (np.array([[1, 0, 0], [0, 1, 0.2], [0, -0.2, 1]]), "not symmetric"),
]
UNUSUAL = [
    (np.diag([1.0, 1, 3]), "principal moment of 3 kg.m2 about z, more than the sum of the other two, 2 kg.m2"),
    (np.diag([1.0, 3, 1]), "principal moment of 3 kg.m2 about y, "),
    (np.diag([0.066, 0.086, 0.0125]), "principal moment of 0.086 kg.m2 about y, .* 0.0785 kg.m2"),
    (turned(np.diag([1.0, 1, 3])), r"principal moment of 3 kg.m2 about \("),
    (np.array([[1, 0.9, 0], [0.9, 1, 0], [0, 0, 1]]), r"principal moment of 1.9 kg.m2 about \(0.707, 0.707, 0\)"),
    (turned(np.diag([1.0, 3, 1e-14])), "more than the sum of the other two"),
]
POSSIBLE = [
    np.diag([1.0, 2, 3]),
    np.diag([0.0, 2, 2]),
    np.diag([0.0, 0, 1]),
    turned(np.diag([1.0, 2, 3])),
    turned(np.diag([0.0, 1, 1])),
    np.diag([0.333, 0.333, 0.667]),
]


@pytest.mark.parametrize(("I", "message"), IMPOSSIBLE)
def test_impossible_inertia(I, message):
    for body in (Body(m=1, I=I), BodyShape(r=(1, 0, 0), m=1, I=I), BodyRod(r=(1, 0, 0), m=1, I=I)):
        with pytest.raises(DeclarationError, match=message) as error:
            ac.compile(Held(it=body))
        assert "`it.I`" in str(error.value)
        assert "test_inertias.py:" in str(error.value)


@pytest.mark.parametrize(("I", "message"), UNUSUAL)
def test_unusual_inertia_is_taken_with_one_warning(I, message):
    for body in (Body(m=1, I=I), BodyShape(r=(1, 0, 0), m=1, I=I), BodyRod(r=(1, 0, 0), m=1, I=I)):
        with pytest.warns(ac.AcausalWarning, match=message) as warned:
            result = ac.simulate(ac.compile(Held(it=body)), stop_time=0.1)
        assert len(warned) == 1
        assert "`it.I`" in str(warned[0].message)
        assert "test_inertias.py:" in str(warned[0].message)
        np.testing.assert_allclose(result["hinge.w"], 1, atol=1e-9)


def test_unusual_inertias_of_a_robot_are_one_warning():
    class Arm(Model):
        world = World()
        shoulder, elbow = Revolute(phi=fixed(0), w=fixed(0)), Revolute(n=(0, 1, 0), phi=fixed(0), w=fixed(0))
        upper = BodyShape(r=(0.4, 0, 0), m=17.4, r_CM=(0.2, 0, 0), I=np.diag([0.13, 0.524, 0.3]))
        lower = Body(m=4.8, r_CM=(-0.0203, -0.0141, 0.07), I=np.diag([0.066, 0.086, 0.0125]))

        def connections(self):
            yield chain(self.world, self.shoulder, self.upper, self.elbow, self.lower)

    with pytest.warns(ac.AcausalWarning, match=r"`upper.I` .* about y[\s\S]*`lower.I` .* about y") as warned:
        ac.simulate(Arm(), stop_time=0.1)
    assert len(warned) == 1


def test_motion_with_an_unusual_inertia_is_that_of_its_moments():
    """A free body turns as Euler's equations say, whatever the moments; energy and momentum stay."""
    I = np.diag([0.066, 0.086, 0.0125])
    free = Body(m=1, I=I, angles_fixed=True, r_0=fixed((0, 0, 0)), v_0=fixed((0, 0, 0)), w_a=fixed((1, 2, 3)))

    class Free(Model):
        world, it = World(gravity=None), free

    with pytest.warns(ac.AcausalWarning, match="about y"):
        result = ac.simulate(Free(), stop_time=3, tolerance=1e-9)

    def euler(_, w):
        return np.linalg.solve(I, -np.cross(w, I @ w))

    right = solve_ivp(euler, (0, 3), (1, 2, 3), rtol=1e-11, atol=1e-11).y[:, -1]
    np.testing.assert_allclose(result["it.w_a"][-1], right, atol=1e-6)


@pytest.mark.parametrize("I", POSSIBLE)
def test_possible_inertia(I):
    ac.compile(Held(it=Body(m=1, I=I)))


def test_changed_inertia_is_checked_again():
    compiled = ac.compile(Held(it=Body(m=1, I=turned(np.diag([1.0, 2, 2.5])))))
    ac.simulate(compiled, stop_time=0.1, parameters={"it.I": turned(np.diag([1.0, 1, 1.5]))})
    with pytest.warns(ac.AcausalWarning, match="sum of the other two"):
        ac.simulate(compiled, stop_time=0.1, parameters={"it.I": turned(np.diag([1.0, 1, 2.5]))})
    with pytest.raises(DeclarationError, match=r"negative (principal )?moment"):
        ac.simulate(compiled, stop_time=0.1, parameters={"it.I": turned(np.diag([1.0, 1, -0.5]))})


def test_only_changed_inertias_are_checked(monkeypatch):
    class Two(Model):
        world = World(gravity=None)
        one, other = Revolute(phi=fixed(0), w=fixed(1)), Revolute(phi=fixed(0), w=fixed(1))
        first, second = Body(m=1, I=np.eye(3)), Body(m=1, I=np.eye(3))

        def connections(self):
            yield chain(self.world, self.one, self.first)
            yield chain(self.world, self.other, self.second)

    compiled, seen = ac.compile(Two()), []
    broken = Requirement.broken

    def counted(requirement, value):
        seen.append(str(requirement.subject))
        return broken(requirement, value)

    monkeypatch.setattr(Requirement, "broken", counted)
    for mass in (2.0, 3.0):
        ac.simulate(compiled, stop_time=0.1, parameters={"first.m": mass})
    assert not seen
    ac.simulate(compiled, stop_time=0.1, parameters={"second.I": 2 * np.eye(3)})
    assert set(seen) == {"second.I"}
    seen.clear()
    with pytest.raises(DeclarationError, match="negative"):
        ac.simulate(compiled, stop_time=0.1, parameters={"second.I": -np.eye(3)})
    with pytest.raises(DeclarationError, match="negative"):
        ac.simulate(compiled, stop_time=0.1, parameters={"second.I": -np.eye(3)})
