"""Effects of joints, bodies and world: closed forms of what they do, and counts of what is left without them."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import DeclarationError, Model, Scalar, chain, connect, fixed, parameter
from components import Body, Prismatic, Revolute, World, rotational

COUNTS = ("equations_flat", "equations_reduced", "operations", "jacobian_nonzeros")
INERTIA = 0.2
UNEQUAL = np.diag([1.0, 2.0, 3.0])


def counts(model: Model, **parameters) -> list[int]:
    report = ac.compile(model, parameters=parameters).report
    return [report[name] for name in COUNTS]


class Wheel(Model):
    """A body on a revolute joint."""

    world = World(gravity=None)
    joint = Revolute(phi=fixed(0.0), w=fixed(3.0), d=0.5)
    body = Body(m=1.0, I=np.diag([0.0, 0.0, INERTIA]))

    def connections(self):
        yield chain(self.world, self.joint, self.body)


class Carriage(Model):
    """A body on a prismatic joint."""

    world = World(gravity=None)
    joint = Prismatic(s=fixed(0.0), v=fixed(3.0), d=0.5)
    body = Body(m=INERTIA)

    def connections(self):
        yield chain(self.world, self.joint, self.body)


SPEEDS = {Wheel: "joint.w", Carriage: "joint.v"}


@pytest.mark.parametrize("model", [Wheel, Carriage])
def test_viscous_friction_decays(model):
    result = ac.simulate(model(), stop_time=1.0, tolerance=1e-9, energy=True)
    np.testing.assert_allclose(result[SPEEDS[model]], 3 * np.exp(-0.5 / INERTIA * result.time), atol=1e-6)
    lost = INERTIA * 9 / 2 * (1 - np.exp(-1.0 / INERTIA))
    assert result.stats["energy_dissipated"] == pytest.approx(lost, rel=1e-6)


class DryWheel(Wheel):
    joint = Revolute(phi=fixed(0.0), w=fixed(3.0), tau_dry=0.4)


class DryCarriage(Carriage):
    joint = Prismatic(s=fixed(0.0), v=fixed(3.0), f_dry=0.4)


@pytest.mark.parametrize(("model", "speed", "way"), [(DryWheel, "w", "phi"), (DryCarriage, "v", "s")])
def test_dry_friction_stops(model, speed, way):
    """Deceleration 2 until the stop at 1.5 s, after a way of 2.25; then creep far below the speed of the law."""
    result = ac.simulate(model(), stop_time=2.0, tolerance=1e-8, energy=True)
    sliding = result.time < 1.45
    np.testing.assert_allclose(result[f"joint.{speed}"][sliding], 3 - 2 * result.time[sliding], atol=1e-6)
    assert abs(result[f"joint.{speed}"][-1]) < 1e-6
    assert result[f"joint.{way}"][-1] == pytest.approx(2.25, abs=1e-4)
    assert result.stats["energy_dissipated"] == pytest.approx(INERTIA * 9 / 2, rel=1e-6)


def test_dry_friction_follows_its_law():
    result = ac.simulate(DryWheel(), stop_time=2.0, tolerance=1e-10, parameters={"joint.w_dry": 2.0})
    # d/dt sinh(w / w_dry) = -tau / (I w_dry) sinh(w / w_dry)
    expected = 2 * np.arcsinh(np.sinh(1.5) * np.exp(-0.4 / (INERTIA * 2) * result.time))
    np.testing.assert_allclose(result["joint.w"], expected, atol=1e-7)


class Driven(Model):
    """A shaft of inertia J that drives a body of equal inertia through an elastic drive."""

    compliance: Scalar = parameter("of the drive", unit="rad/(N.m)", default=0.01)
    world = World(gravity=None)
    joint = Revolute(phi=fixed(0.0), w=fixed(0.0), use_axis_flange=True, compliance=compliance)
    rotor = rotational.Inertia(J=INERTIA, phi=fixed(0.0), w=fixed(2.0))
    body = Body(m=1.0, I=np.diag([0.0, 0.0, INERTIA]))

    def connections(self):
        yield chain(self.world, self.joint, self.body)
        yield connect(self.rotor.flange_b, self.joint.axis)


def test_elastic_drive_oscillates():
    result = ac.simulate(Driven(), stop_time=1.0, tolerance=1e-10, energy=True)
    t, omega = result.time, np.sqrt(2 / (INERTIA * 0.01))
    twist = 2 / omega * np.sin(omega * t)
    np.testing.assert_allclose(result["rotor.phi"] - result["joint.phi"], twist, atol=1e-6)
    np.testing.assert_allclose(result["joint.tau"], twist / 0.01, atol=1e-4)
    np.testing.assert_allclose(result["rotor.phi"] + result["joint.phi"], 2 * t, atol=1e-7)
    assert abs(result.stats["energy_method"]) < 1e-6 * INERTIA * 2


class Slide(Model):
    """A body on an elastic drive whose other end stands still."""

    world = World(gravity=None)
    joint = Prismatic(s=fixed(0.1), v=fixed(0.0), use_axis_flange=True, compliance=0.02)
    body = Body(m=2.0)

    def connections(self):
        yield chain(self.world, self.joint, self.body)
        yield connect(self.joint.axis, self.joint.support)


def test_elastic_drive_holds_a_body():
    result = ac.simulate(Slide(), stop_time=1.0, tolerance=1e-10)
    np.testing.assert_allclose(result["joint.s"], 0.1 * np.cos(5 * result.time), atol=1e-7)


class RigidSlide(Slide):
    joint = Prismatic(use_axis_flange=True, compliance=0.02, elasticity=False)


def test_rigid_drive_holds_a_body_still():
    result = ac.simulate(RigidSlide(), stop_time=1.0, intervals=3)
    np.testing.assert_array_equal(result["joint.s"], 0.0)


class PlainWheel(Wheel):
    joint = Revolute(phi=fixed(0.0), w=fixed(3.0))


class BothFrictions(Wheel):
    joint = Revolute(phi=fixed(0.0), w=fixed(3.0), d=0.5, tau_dry=0.4)


def test_friction_off_leaves_nothing():
    plain = counts(PlainWheel())
    assert counts(BothFrictions(), **{"joint.friction": False}) == plain
    assert counts(PlainWheel(), **{"joint.friction": False}) == plain
    viscous, both = counts(Wheel()), counts(BothFrictions())
    assert viscous[2] > plain[2]
    assert both[2] > viscous[2]


class PlainDriven(Driven):
    """A rigid drive: the rotor turns with the body."""

    joint = Revolute(phi=fixed(0.0), w=fixed(0.0), use_axis_flange=True)


def test_elasticity_off_leaves_nothing():
    plain = counts(PlainDriven())
    assert counts(PlainDriven(), **{"joint.elasticity": False}) == plain
    elastic = counts(Driven())
    rigid = counts(Driven(), **{"joint.elasticity": False})
    assert rigid == plain
    assert rigid[1] < elastic[1]
    assert rigid[2] < elastic[2]


class FreeBody(Model):
    world = World(gravity=None)
    body = Body(
        m=3.0,
        I=UNEQUAL,
        r_0=fixed((0, 0, 0)),
        v_0=fixed((0, 0, 0)),
        w_a=fixed((1.0, 0.1, 1.2)),
        angles_fixed=True,
    )


def test_without_gyroscopic_torque_a_body_keeps_its_angular_velocity():
    on, off = counts(FreeBody()), counts(FreeBody(), **{"body.gyroscopic": False})
    assert off[2] < on[2]
    result = ac.simulate(FreeBody(), stop_time=2.0, parameters={"body.gyroscopic": False})
    np.testing.assert_allclose(result["body.w_a"], np.tile((1.0, 0.1, 1.2), (401, 1)), atol=1e-9)
    with_torque = ac.simulate(FreeBody(), stop_time=2.0)
    assert np.ptp(with_torque["body.w_a"], axis=0).max() > 0.1


def test_in_the_plane_there_is_no_gyroscopic_torque():
    assert counts(Wheel()) == counts(Wheel(), **{"body.gyroscopic": False})


class Falling(Model):
    world = World()
    body = Body(m=3.0, r_0=fixed((0, 0, 0)), v_0=fixed((0, 0, 0)), I=np.eye(3), w_a=fixed((0, 0, 0)), angles_fixed=True)


def test_gravity_off_leaves_nothing():
    on, off = counts(Falling()), counts(Falling(), **{"world.gravity": None})
    assert off[2] < on[2]


def test_compliance_needs_a_drive():
    class Wrong(Wheel):
        joint = Revolute(phi=fixed(0.0), w=fixed(3.0), compliance=0.1)

    with pytest.raises(DeclarationError, match=r"`compliance` of joint \(Revolute\).*use_axis_flange=True"):
        ac.compile(Wrong())
