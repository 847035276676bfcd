"""Beams that move freely: balance, invariance, energy, full circles."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, connect, fixed, part, sin, structural, time
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
from tests.components.test_beam import MASS, RUBBER
from tests.reference import cantilever, floating_beam


class Oriented(Model):
    """A beam that swings about a hinge on a base turned anyhow, gravity turned alike."""

    angle = structural("turn", default=0.0)
    n = structural("axis of the turn", default=(1, 0, 0), shape=(3,))
    down = structural("direction of gravity", default=(0, -1, 0), shape=(3,))
    reference = structural("reference frame", default="tangent")
    world = World(n=down)
    base = FixedRotation(r=(1.0, 2.0, 3.0), n=n, angle=angle)
    hinge = Revolute(n=(0, 1, 1), phi=fixed(0.3), w=fixed(4.0))
    beam = FlexibleBeam(elements=2, reference=reference, alpha=0.5, beta=1e-3, **RUBBER)

    def connections(self):
        yield chain(self.world, self.base, self.hinge, self.beam)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
def test_a_beam_oriented_anywhere_moves_alike(reference):
    n = np.array([1.0, -2.0, 0.5]) / np.linalg.norm([1.0, -2.0, 0.5])
    turn = Rotation.from_rotvec(1.1 * n)
    how = {"stop_time": 0.5, "tolerance": 1e-8, "intervals": 20}
    plain = ac.simulate(Oriented(reference=reference), **how)
    turned = Oriented(reference=reference, angle=1.1, n=tuple(n), down=tuple(turn.apply([0, -1, 0])))
    turned = ac.simulate(turned, **how)
    assert np.abs(plain["beam.q"]).max() > 0.02
    np.testing.assert_allclose(turned["beam.q"], plain["beam.q"], atol=1e-6)
    np.testing.assert_allclose(turned["hinge.phi"], plain["hinge.phi"], atol=1e-6)
    base = np.array([1.0, 2.0, 3.0])
    moved = turn.apply(plain["beam.frame_b.r_0"] - base) + base
    np.testing.assert_allclose(turned["beam.frame_b.r_0"], moved, atol=1e-6)


# EA, EJ_z, EJ_y, GJ_t with J_y = J and J_t = J + J_y
STIFFNESS = tuple(RUBBER["E"] * x for x in (RUBBER["A"], RUBBER["J"], RUBBER["J"], 2 * RUBBER["J"] / 2.6))
HUB_MASS, HUB_INERTIA = 0.5, np.array([0.02, 0.03, 0.04])


class Free(Model):
    """A beam in space; a body at its root, massless or a hub, gives it the initial motion."""

    gravity = structural("kind of gravity", default=None)
    reference = structural("reference frame", default="tangent")
    spin = structural("angular velocity at the start", default=(2.0, 1.0, 3.0), shape=(3,))
    world = World(gravity=gravity)
    hub = structural("whether the root bears a hub", default=False)
    torsional_inertia = structural("inertia about the axis", default=5e-3)

    @part
    def beam(self):
        """The beam; without inertia about its axis, it cannot be elastic in torsion."""
        about = self.torsional_inertia
        return FlexibleBeam(elements=3, reference=self.reference, torsional_inertia=about, torsion=about > 0, **RUBBER)

    @part
    def handle(self):
        """The body at the root."""
        return Body(
            m=HUB_MASS * self.hub,
            I=np.diag(HUB_INERTIA) * self.hub,
            r_0=fixed((1.0, 2.0, 3.0)),
            v_0=fixed((0.1, 0.2, 0.3)),
            w_a=fixed(tuple(self.spin)),
            angles_fixed=True,
            angles_start=(0.3, 0.4, 0.5),
        )

    def connections(self):
        yield connect(self.handle.frame_a, self.beam.frame_a)


class Balance:
    """Momentum, angular momentum about the world's origin, energy and centre of mass of a run, by quadrature."""

    def __init__(self, result: ac.Result, reference: str, hub: bool = False, torsional: float = 5e-3) -> None:
        frame = "beam.frame_a" if reference == "tangent" else "beam.chord"
        tree, rates = result.tree, result["beam.qd"]
        free = tree.beam.free
        l, rho_A = RUBBER["length"], RUBBER["rho"] * RUBBER["A"]
        self.momentum, self.angular, self.energy, self.centre = [], [], [], []
        for k in range(result.time.size):
            T, r = result[f"{frame}.R.T"][k], result[f"{frame}.r_0"][k]
            v, w = result[f"{frame}.v"][k], result[f"{frame}.R.w"][k]
            q, qd = floating_beam.nodal(result["beam.node_deflection"][k]), np.zeros(24)
            qd[free] = rates[k]
            if reference == "pinned":  # the chord turns with the mean of both ends
                qd[5] = -qd[-1]
            momentum, angular = floating_beam.momenta(l, rho_A, 3, q, qd, v, w, torsional)
            T_h, r_h, v_h, w_h = (result[f"handle.{name}"][k] for name in ("frame_a.R.T", "r_0", "v_0", "w_a"))
            p_h = HUB_MASS * hub * v_h
            self.momentum.append(T.T @ momentum + p_h)
            turn_h = T_h.T @ (HUB_INERTIA * hub * w_h) + np.cross(r_h, p_h)
            self.angular.append(T.T @ angular + np.cross(r, T.T @ momentum) + turn_h)
            stretch, _ = floating_beam.momenta(l, rho_A, 3, q, q, np.zeros(3), np.zeros(3))
            beam_centre = r + T.T @ (stretch / MASS + [l / 2, 0, 0])
            self.centre.append((MASS * beam_centre + HUB_MASS * hub * r_h) / (MASS + HUB_MASS * hub))
            kinetic = floating_beam.kinetic_energy(l, rho_A, 3, q, qd, v, w, torsional)
            kinetic += floating_beam.micro_energy(l, rho_A, 3, qd, torsional)
            elastic = floating_beam.elastic_energy(l, STIFFNESS, 3, q)
            self.energy.append(kinetic + elastic + p_h @ v_h / 2 + hub * HUB_INERTIA @ w_h**2 / 2)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
def test_free_beam_tumbles(reference):
    result = ac.simulate(Free(reference=reference, hub=True), stop_time=1.0, tolerance=1e-8, intervals=20)
    assert np.abs(result["beam.node_deflection"]).max() > 0.02
    found = Balance(result, reference, hub=True)
    for name in ("momentum", "angular", "energy"):
        values = np.array(getattr(found, name))
        np.testing.assert_allclose(values, np.broadcast_to(values[0], values.shape), atol=2e-6, err_msg=name)
    centre = found.centre[0] + np.outer(result.time, found.momentum[0] / (MASS + HUB_MASS))
    np.testing.assert_allclose(found.centre, centre, atol=1e-6)
    np.testing.assert_allclose(np.sum(result["handle.frame_a.Q"] ** 2, axis=1), 1, atol=1e-6)


@pytest.mark.slow
def test_tangent_and_pinned_differ_by_the_second_order():
    """Both lack the shortening by bending, in different frames; axial forces act on it: (speed / frequency)^2 counts.

    At half the speed and twice the time deflections are a quarter, differences a sixteenth.
    """
    first = cantilever.frequency_roots(1)[0] ** 2  # EJ = rho A = length = 1
    differences, sizes, speeds = [], [], []
    for spin in (0.4, 0.8):
        ends = []
        for reference in ("tangent", "pinned"):
            model = Free(reference=reference, hub=True, torsional_inertia=0.0, spin=(2 * spin, spin, spin))
            result = ac.simulate(model, stop_time=0.4 / spin, tolerance=1e-9, intervals=4)
            ends.append(result["beam.frame_b.r_0"])
        sizes.append(np.linalg.norm(result["beam.node_deflection"][..., 1:3], axis=-1).max())
        differences.append(np.abs(ends[0] - ends[1]).max())
        speeds.append(np.sqrt(6) * spin)
    assert sizes[1] > 3 * sizes[0]
    assert all(d < size * (w / first) ** 2 for d, size, w in zip(differences, sizes, speeds, strict=True))
    assert 0 < differences[0] < differences[1] / 16


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
def test_spinning_about_its_own_axis(reference):
    """Nothing but the turn itself: the axis stays, the beam stays straight."""
    model = Free(reference=reference, spin=(7.0, 0.0, 0.0))
    result = ac.simulate(model, stop_time=1.0, tolerance=1e-9, intervals=10)
    np.testing.assert_allclose(result["handle.w_a"], np.tile([7.0, 0, 0], (11, 1)), atol=1e-7)
    np.testing.assert_allclose(result["beam.q"], 0, atol=1e-7)
    axis = result["beam.frame_b.r_0"] - result["beam.frame_a.r_0"]
    np.testing.assert_allclose(axis, np.tile(axis[0], (11, 1)), atol=1e-6)
    T = result["beam.frame_a.R.T"]
    y_turned = Rotation.from_rotvec(np.outer(7.0 * result.time, T[0, 0])).apply(T[0, 1].copy())
    np.testing.assert_allclose(T[:, 1], y_turned, atol=1e-5)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
def test_centre_of_mass_of_a_free_beam_falls_with_g(reference):
    result = ac.simulate(Free(reference=reference, gravity="uniform"), stop_time=0.5, tolerance=1e-8, intervals=10)
    found, t = Balance(result, reference), result.time[:, None]
    fall = found.centre[0] + t * found.momentum[0] / MASS + t**2 / 2 * [0, -9.80665, 0]
    np.testing.assert_allclose(found.centre, fall, atol=1e-6)


class Driven(Model):
    """A force that varies, damping, and gravity: every term of the power balance."""

    volumes = structural("volumes, 0: FlexibleBeam", default=0)
    reference = structural("reference frame", default="tangent")
    world = World()
    hinge = Revolute(n=(0, 1, 1), phi=fixed(0.3), w=fixed(4.0))
    load = WorldForce(force=(0.3 * sin(9 * time), 2 * sin(7 * time), 0.5))

    @part
    def beam(self):
        """The beam."""
        values = RUBBER | {"reference": self.reference, "alpha": 0.5, "beta": 1e-4}
        return SubstructuredBeam(volumes=self.volumes, **values) if self.volumes else FlexibleBeam(elements=2, **values)

    def connections(self):
        yield chain(self.world, self.hinge, self.beam)
        yield connect(self.load.frame_b, self.beam.frame_b)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
@pytest.mark.parametrize("volumes", [0, 2])
def test_power_balance(reference, volumes):
    model = Driven(reference=reference, volumes=volumes)
    stats = ac.simulate(model, stop_time=0.5, tolerance=1e-8, energy=True, intervals=5).stats
    assert abs(stats["energy_supplied"]) > 0.1
    assert stats["energy_dissipated"] > 1e-3
    assert abs(stats["energy_method"]) < 1e-5 * abs(stats["energy_supplied"])


class RolledUp(Model):
    """Cantilever with a moment at its end, in the static shape."""

    volumes = structural("volumes", default=8)
    moment = structural("end moment in N.m", default=0.0)
    world = World(gravity=None)

    @part
    def beam(self):
        """The beam."""
        return SubstructuredBeam(volumes=self.volumes, initial="static", **RUBBER)

    @part
    def torque(self):
        """The end moment."""
        return WorldTorque(torque=(0, 0, self.moment))

    def connections(self):
        yield chain(self.world, self.beam)
        yield connect(self.torque.frame_b, self.beam.frame_b)


def test_rolling_up_converges_to_the_circle():
    """Half a quarter circle; the error falls with the square of the volume, chord against arc."""
    EJ = RUBBER["E"] * RUBBER["J"]
    moment = np.pi / 4 * EJ
    x, y, _ = cantilever.rolled_up(1.0, EJ, moment)
    errors = []
    for volumes in (4, 8, 16):
        model = RolledUp(volumes=volumes, moment=moment)
        tip = ac.simulate(model, stop_time=1e-3, intervals=1)["beam.frame_b.r_0"][0]
        errors.append(np.hypot(tip[0] - x, tip[1] - y))
    assert errors[-1] < 1e-3
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 2, atol=0.2)


def test_node_deflection_of_a_substructured_beam_is_resolved_in_frame_a():
    model = RolledUp(volumes=16, moment=np.pi / 4 * RUBBER["E"] * RUBBER["J"])
    result = ac.simulate(model, stop_time=1e-3, intervals=1)
    s = np.linspace(0, 1, 17)
    x, y, angle = cantilever.rolled_up(s, 1.0, np.pi / 4)
    expected = np.column_stack([x - s, y, 0 * s, 0 * s, 0 * s, angle])
    np.testing.assert_allclose(result["beam.node_deflection"][0], expected, atol=1e-3)
