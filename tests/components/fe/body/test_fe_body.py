"""FEBody in motion: against the Lagrangian, and what no force may change."""

from __future__ import annotations

import warnings
from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed, part, piecewise, structural, time
from components import Body, BodyShape, Revolute, Spherical, World, WorldForce, WorldTorque
from components.fe import FEBody, Interface, ReducedBody, box, reduce_body
from tests.benchmarks.fe import Lopsided
from tests.components.fe.moving import RUBBER, SIZE, ends, momenta, rod
from tests.reference.two_bricks import TwoBricks, turned

FORCE, TORQUE, GRAVITY = (30.0, -20.0, 45.0), (3.0, 5.0, -2.0), np.array([0.4, -0.7, -0.2])


class Bricks(Model):
    """The two bricks in their random state, with a load on a frame that turns with the deformation."""

    seed = structural("of the state", default=0)
    world = World(n=tuple(GRAVITY), g=9.0)
    force, torque = WorldForce(force=FORCE), WorldTorque(torque=TORQUE)

    @part
    def body(self):
        bricks, maps = loaded(self.seed)
        state = {
            "r_0": bricks.state["x"],
            "v_0": bricks.state["v"],
            "w_a": bricks.motion()[4],
            "q": bricks.q,
            "qd": bricks.qd,
        }
        start: dict = {name: fixed(tuple(value)) for name, value in state.items()}
        angles: dict = {"angles_start": tuple(bricks.state["angles"]), "angles_fixed": True}
        reduced = ReducedBody(**bricks.moments(), interfaces=(Interface("tip", *maps),))
        return FEBody(reduced=reduced, initial="free", **start, **angles)

    def connections(self):
        yield connect(self.body.tip, self.force.frame_b)
        yield connect(self.body.tip, self.torque.frame_b)


def loaded(seed: int):
    """Bricks, and place and maps of a frame on them."""
    bricks, rng = TwoBricks(4, seed), np.random.default_rng(seed)
    return bricks, (rng.normal(size=3), rng.normal(size=(3, 4)), rng.normal(size=(3, 4)))


def applied(bricks: TwoBricks, maps) -> np.ndarray:
    """Generalized forces of the load: of its virtual work, with the rotation of the frame from angle and axis."""
    place, displacement, rotation = (ca.DM(x) for x in maps)
    y, yd = ca.SX.sym("y", 10), ca.SX.sym("yd", 10)
    A, theta = turned(y[3:6]), rotation @ y[6:]
    size = ca.norm_2(theta)
    angle, S = 2 * ca.atan(size / 2), ca.skew(theta / size)
    T = A @ (ca.SX.eye(3) + ca.sin(angle) * S + (1 - ca.cos(angle)) * S @ S)
    spin = ca.reshape(ca.jtimes(ca.vec(T), y, yd), 3, 3) @ T.T
    w = ca.vertcat(spin[2, 1], spin[0, 2], spin[1, 0])
    at = y[:3] + A @ (place + displacement @ y[6:])
    work = ca.jacobian(at, y).T @ ca.DM(FORCE) + ca.jacobian(w, yd).T @ ca.DM(TORQUE)
    s = bricks.state
    values = np.r_[s["x"], s["angles"], bricks.q], np.r_[s["v"], s["rates"], bricks.qd]
    return np.array(ca.Function("work", [y, yd], [work])(*values)).ravel()


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_accelerations_are_those_of_the_lagrangian(seed):
    bricks, maps = loaded(seed)
    result = ac.simulate(Bricks(seed=seed), stop_time=1e-6, intervals=1)
    bricks.state["second"] = np.zeros(3)
    _, G, _, z, *_ = bricks.motion()
    bricks.state["acceleration"] = result["body.a_0"][0]
    bricks.state["second"] = np.linalg.solve(G, result["body.z_a"][0] - z)
    bricks.qdd = result["body.qdd"][0]
    needed = bricks.forces(9.0 * GRAVITY / np.linalg.norm(GRAVITY))
    np.testing.assert_allclose(needed, applied(bricks, maps), rtol=0, atol=1e-12 * np.abs(needed).max())


class Free(Model):
    """A rod in a frame held at its end, spun about three axes."""

    hold = structural("frame that is the reference frame", default="frame_a")
    world = World(gravity=None)

    @part
    def body(self):
        start: dict = {"r_0": fixed((0.2, 0.1, -0.3)), "v_0": fixed((0.5, -1.0, 0.7)), "w_a": fixed((4.0, -3.0, 5.0))}
        return FEBody(reduced=rod(self.hold), angles_start=(0.3, 0.2, -0.5), angles_fixed=True, **start)


@pytest.mark.parametrize("hold", ["frame_a", "frame_b"])
def test_free_body_keeps_its_momenta(hold):
    result = ac.simulate(Free(hold=hold), stop_time=0.2, tolerance=1e-9, intervals=40, energy=True)
    assert np.abs(result["body.q"]).max() > 1e-4
    for momentum in momenta(rod(hold), result, frame=hold):
        np.testing.assert_allclose(momentum - momentum[0], 0, atol=1e-10 * np.linalg.norm(momentum[0]))
    assert abs(result.stats["energy_method"]) < 1e-9


class OnBall(Model):
    """A rod on a ball joint, with a load that turns with its other end."""

    turned = structural("whether its other end is on the joint", default=False)
    hold = structural("frame that is the reference frame", default="frame_a")
    world = World()
    joint = Spherical(angles_fixed=True, w_rel_a=fixed((3.0, -2.0, 4.0)))
    force = WorldForce(force=(1.5, -1.0, 1.2), resolve_in_frame="frame_b")
    torque = WorldTorque(torque=(0.06, 0.09, -0.06), resolve_in_frame="frame_b")

    @part
    def body(self):
        return FEBody(reduced=rod(self.hold))

    def connections(self):
        near, far = self.body.frame_a, self.body.frame_b
        if self.turned:
            near, far = far, near
        yield chain(self.world, self.joint, near)
        yield from (connect(far, self.force.frame_b), connect(far, self.torque.frame_b))


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("hold", ["frame_a", "frame_b", "mean-axis"])
def test_energy_on_a_ball_joint(hold, turned):
    # The energies of IDAS, which runs without the core begin with, are up to 50 times the tolerance off.
    result = ac.simulate(OnBall(hold=hold, turned=turned), stop_time=0.3, tolerance=1e-11, energy=True)
    stats = result.stats
    assert abs(stats["energy_supplied"]) > 0.01
    assert stats["energy_stored_change"] == pytest.approx(stats["energy_supplied"], abs=1e-9)


def test_without_modes_it_is_the_rigid_body():
    reduced = rod()
    centre = reduced.first_moment / reduced.mass
    P = reduced.second_moment - reduced.mass * np.outer(centre, centre)
    place = reduced.interfaces[1].place

    class Pair(Model):
        rigid = structural("whether it is a BodyShape", default=False)
        world, joint = World(), Spherical(angles_fixed=True, w_rel_a=fixed((3.0, -2.0, 4.0)))
        force = WorldForce(force=(0.5, -0.3, 0.4), resolve_in_frame="frame_b")

        @part
        def body(self):
            if not self.rigid:
                return FEBody(reduced=reduced, modes=0)
            I = np.trace(P) * np.eye(3) - P
            return BodyShape(r=tuple(place), m=reduced.mass, r_CM=tuple(centre), I=I)

        def connections(self):
            yield chain(self.world, self.joint, self.body, self.force)

    found = [ac.simulate(Pair(rigid=rigid), stop_time=0.5, tolerance=1e-9) for rigid in (True, False)]
    np.testing.assert_allclose(found[1]["body.frame_b.r_0"], found[0]["body.frame_b.r_0"], atol=1e-8)


class OnPoint(Model):
    """A rod that hangs on the world, with a part at one node."""

    kind = structural("what joins the part", default="ball")
    world = World()

    @part
    def body(self):
        M, K, nodes = box(SIZE, (4, 1, 1), "hex8", **RUBBER)
        frames = {"root": ends(nodes)["frame_a"], "corner": [len(nodes) - 1]}
        return FEBody(reduced=reduce_body(M, K, nodes, frames=frames, hold="root", modes=4), check_range=False)

    @part
    def joint(self):
        return (
            Spherical(angles_fixed=True, w_rel=fixed((0, 0, 0)))
            if self.kind == "ball"
            else Revolute(phi=fixed(0), w=fixed(0))
        )

    @part
    def load(self):
        return Body(m=0.1, r_CM=(0.05, 0.02, 0.03), I=1e-4 * np.eye(3))

    def connections(self):
        yield connect(self.world.frame_b, self.body.root)
        yield chain(self.body.corner, self.joint, self.load)


def test_a_point_takes_a_ball_joint():
    result = ac.simulate(OnPoint(), stop_time=0.1, tolerance=1e-7, energy=True)
    assert np.abs(result["body.corner.t"]).max() == 0
    assert abs(result.stats["energy_method"]) < 1e-7


def test_a_point_carries_no_moment():
    with pytest.raises(ac.InitializationError) as told:
        ac.simulate(OnPoint(kind="hinge"), stop_time=0.1)
    for words in ("body (FEBody)", "`corner`", "one node", "Spherical"):
        assert words in str(told.value)


def test_a_moment_that_comes_later_is_told():
    class Later(OnPoint):
        joint = None
        load = WorldTorque(torque=(0, 0, piecewise((1e-3, time > 0.05), 0)))

        def connections(self):
            yield connect(self.world.frame_b, self.body.root)
            yield connect(self.body.corner, self.load.frame_b)

    with pytest.warns(ac.AcausalWarning, match="`corner` has one node or collinear nodes"):
        ac.simulate(Later(), stop_time=0.1)


class Falling(Model):
    world = World()
    body = FEBody(
        reduced="rod.npz", r_0=fixed((0, 0, 0)), v_0=fixed((0, 0, 0)), w_a=fixed((0, 0, 0)), angles_fixed=True
    )


def test_a_body_may_be_a_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rod().save("rod.npz")
    rod(modes=3).save("other.npz")
    given = ac.simulate(Falling(), stop_time=0.1, intervals=2)
    assert given["body.q"].shape == (3, 6)
    other = ac.simulate(Falling(), stop_time=0.1, intervals=2, parameters={"body.reduced": "other.npz"})
    assert other["body.q"].shape == (3, 3)
    np.testing.assert_allclose(given["body.r_0"][-1], (0, -9.80665 * 0.1**2 / 2, 0), atol=1e-9)
    (tmp_path / "rod.npz").unlink()
    with pytest.raises(ac.DeclarationError, match="there is no reduced-body file"):
        ac.simulate(Falling(), stop_time=0.1)


def test_more_modes_than_there_are():
    with pytest.raises(ac.DeclarationError, match="at most 6"):
        ac.compile(Free(), parameters={"body.modes": 7})


class Held(Model):
    """A rod that is clamped in the world."""

    world = World()
    body = FEBody(reduced=rod(), check_range=False)

    def connections(self):
        yield connect(self.world.frame_b, self.body.frame_a)


def test_stiffness_and_damping_are_parameters():
    compiled = ac.compile(Held(), parameters={"body.damping_ratio": 0.1})
    for factor in (1.0, 4.0):
        values = ac.linearize(compiled, parameters={"body.stiffness": factor}).eigenvalues
        rates = np.sort(np.abs(values))[::2]
        np.testing.assert_allclose(rates, np.sqrt(factor) * 2 * np.pi * rod().frequencies, rtol=1e-3)
        np.testing.assert_allclose(-values.real / np.abs(values), 0.1, rtol=1e-3)


@pytest.mark.parametrize("initial", ["undeformed", "static"])
def test_state_at_the_start(initial):
    result = ac.simulate(Held(), parameters={"body.initial": initial}, stop_time=0.5, tolerance=1e-9)
    sag = result["body.frame_b.r_0"][:, 1]
    if initial == "static":
        assert np.ptp(sag) < 1e-8
        assert sag[0] < -1e-3
    else:
        assert sag[0] == pytest.approx(0, abs=1e-15)
        assert np.ptp(sag) > 1e-3


class Spun(Model):
    """A rod in mean axes, free, about an axis across it."""

    share = structural("of the first frequency", default=0.6)
    told = structural("whether it is told", default=True)
    world = World(gravity=None)

    @part
    def body(self):
        reduced = rod("mean-axis")
        start: dict = {"r_0": fixed((0, 0, 0)), "v_0": fixed((0, 0, 0)), "angles_fixed": True}
        w = (0, 0, self.share * 2 * np.pi * reduced.frequencies[0])
        return FEBody(reduced=reduced, check_range=self.told, w_a=fixed(w), **start)


def test_a_fast_spin_is_told():
    with pytest.warns(ac.AcausalWarning, match="it turns faster than half of its first frequency"):
        ac.simulate(Spun(), stop_time=0.01)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ac.simulate(Spun(share=0.4), stop_time=0.01)
        ac.simulate(Spun(told=False), stop_time=0.01)
        # Four times the stiffness, twice the frequency.
        ac.simulate(Spun(), stop_time=0.01, parameters={"body.stiffness": 4})


def test_modes_without_stiffness_have_no_frequency_to_near():
    soft = replace(rod("mean-axis"), K=np.zeros((6, 6)))
    ac.simulate(Spun(), stop_time=0.01, parameters={"body.reduced": soft})


def test_operations_depend_on_the_modes_alone():
    """With their Jacobian, of a body without symmetry."""
    compiled = ac.compile(Lopsided(modes=20))
    assert compiled.report["operations"] <= 130 * 20**2
