"""FEBody(inertia="reconfigured"): the limit of short steps in reconfigured inertial frames, as a component of a scene."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed, part, structural
from acausal.study.effects.listing import effects_of
from components import Revolute, Spherical, World, WorldForce, WorldTorque
from components.fe import FEBody, FrameLoad, as_result, simulate_reconfigured
from models import FEPlate
from models.fe_plate import REST
from models.fe_plate import plate as plate_of
from tests.components.fe.moving import rod
from tests.components.fe.reconfigured.test_reconfigured import energy, lopsided, plate
from tests.reference.reconfigured_limit import LimitPlate

MESH = str(Path(__file__).parents[3] / "reference/fe/plate_fe_h25.npz")
FORCE, TORQUE = (300.0, -200.0, 500.0), (20.0, -30.0, 10.0)


class Plate(FEPlate):
    """`fe-plate` with it."""

    inertia: str = structural("inertia of the plate", default="reconfigured")

    @part
    def body(self):
        start: dict = {"angles_fixed": True, "r_0": REST, "v_0": REST, "w_a": fixed(tuple(self.spin))}
        reduced = plate_of(str(self.mesh), self.modes)
        return FEBody(reduced=reduced, damping_ratio=self.damping, inertia=self.inertia, **start)


class Thrown(Model):
    """A block without symmetry under weight, a force that follows it and a moment that does not."""

    inertia: str = structural("inertia of the block", default="reconfigured")
    modes: int = structural("number of modes", default=5)
    centrifugal: bool = structural("whether centrifugal forces act", default=True)
    coriolis: bool = structural("whether Coriolis forces act", default=True)
    world = World(n=(0, 0, -1), g=9.81)
    force, torque = WorldForce(force=FORCE, resolve_in_frame="frame_b"), WorldTorque(torque=TORQUE)

    @part
    def body(self):
        start: dict = {"r_0": fixed((1, 2, 3)), "v_0": fixed((3, -1, 2)), "w_a": fixed((30, -20, 40))}
        effects: dict = {name: getattr(self, name) for name in ("inertia", "modes", "centrifugal", "coriolis")}
        return FEBody(reduced=lopsided()[1], damping_ratio=0.05, angles_fixed=True, **effects, **start)

    def connections(self):
        yield connect(self.body.end, self.force.frame_b)
        yield connect(self.body.face, self.torque.frame_b)


def thrown(dt: float, stop: float, modes: int = 5) -> ac.Result:
    loads = [FrameLoad("end", force=FORCE, follower=True), FrameLoad("face", moment=TORQUE)]
    start = {"position": (1, 2, 3), "velocity": (3, -1, 2), "spin": (30, -20, 40), "gravity": (0, 0, -9.81)}
    body = lopsided()[1].first(modes)
    return as_result(simulate_reconfigured(body, loads, stop, dt, damping=0.05, **start))


@pytest.mark.parametrize("modes", [0, 5])
def test_limit_of_short_steps(modes):
    """All that a scene can put on a body: steps of order 4 come nearer with the power of 4.

    Coordinates that reach a hundred-thousandth of their size are known to a millionth of what they reach.
    """
    count, tolerance = 100, 1e-13
    stop = count * 0.3 / (2 * np.pi * lopsided()[1].frequencies[-1])
    exact = ac.simulate(Thrown(modes=modes), stop_time=stop, tolerance=tolerance, intervals=count)
    errors: list[list[float]] = []
    names = ("r_0", "w_a", "ref.R.T", "end.r_0", "end.v", "face.R.T", "face.R.w", *(("q", "qd") if modes else ()))
    for parts in (1, 2):
        found = thrown(stop / count / parts, stop, modes)
        pairs = ((found[f"body.{name}"][::parts], exact[f"body.{name}"]) for name in names)
        errors.append([np.abs(a - b).max() / np.abs(b).max() for a, b in pairs])
        if parts == 2:
            for name in ("a_0", "z_a", "end.a", "face.z", *(["qdd"] if modes else [])):
                a, b = found[f"body.{name}"][::2], exact[f"body.{name}"]
                bound = 1e-10 if name == "a_0" else 1e-4
                assert np.abs(a - b).max() < bound * np.abs(b).max(), name
    assert max(errors[1]) < 1e-4
    assert errors[1][0] < 1e-10  # the place of the centre of mass
    assert max(errors[1][1:3]) < 1e-9  # what the shape has little to do with
    if modes:
        q = names.index("q")
        assert np.log2(errors[0][q] / errors[1][q]) > 3.9
    floating = ac.simulate(
        Thrown(modes=modes, inertia="second_order"), stop_time=stop, tolerance=tolerance, intervals=count
    )
    gap = np.abs(floating["body.w_a"] - exact["body.w_a"]).max()
    assert gap < 1e-8 if not modes else gap > 100 * errors[1][1] * np.abs(exact["body.w_a"]).max()


def test_against_the_equations_written_apart():
    """By the one-step method, of which both take the same steps; those of IDAS differ where rounding does, and so its errors."""
    spin = (2, -6, 3)
    runs = [
        ac.simulate(model(mesh=MESH, spin=spin), stop_time=0.05, tolerance=1e-9, intervals=50, method="rosenbrock")
        for model in (Plate, LimitPlate)
    ]
    for name in ("w_a", "z_a", "q", "qdd", "P1.r_0", "P1.a"):
        found, expected = (run[f"body.{name}"] for run in runs)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


def test_error_of_the_method_and_error_of_the_step():
    """The scene tells the first, which steps cannot come nearer to the floating frame than."""
    spin = (7.4, 7.4, 7.4)
    limit, exact = (
        ac.simulate(
            Plate(mesh=MESH, spin=spin, inertia=inertia, load="none", damping=0.0),
            stop_time=0.04,
            tolerance=1e-9,
            intervals=40,
        )
        for inertia in ("reconfigured", "second_order")
    )
    steps = simulate_reconfigured(plate(), (), 0.04, 2.5e-5, spin=spin).w[::40]
    method = np.abs(limit["body.w_a"] - exact["body.w_a"]).max()
    assert method == pytest.approx(1.20e-7 * (7.4 * 3**0.5) ** 3, rel=0.05)  # docs/background/reconfigured.md
    assert np.abs(steps - limit["body.w_a"]).max() < 1e-3 * method
    assert np.abs(steps - exact["body.w_a"]).max() == pytest.approx(method, rel=1e-3)


def test_energy():
    """That of the inertial frame, which is kept up to the part of w x u that the modes do not hold; it is told by its rate."""
    spin = (2, -6, 3)
    model = Plate(mesh=MESH, spin=spin, load="none", damping=0.0)
    found = ac.simulate(model, stop_time=0.1, tolerance=1e-11, intervals=1000, energy=True)
    own = energy(simulate_reconfigured(plate(), (), 0.1, 1.25e-5, spin=spin))
    change = found.stats["energy_stored_change"]
    assert found.stats["energy_supplied"] == 0
    assert change == pytest.approx(own[-1] - own[0], rel=0.02)
    body, w, q = plate(), found["body.w_a"], found["body.q"]
    B = body.modal_products
    G = np.stack([B[:, :, j, i] - B[:, :, i, j] for i, j in ((1, 2), (2, 0), (0, 1))])
    rate = -np.einsum("tb,bc,cd,kde,tk,te->t", q, body.K, np.linalg.inv(body.M), G, w, q, optimize=True)
    lost = float(np.sum((rate[1:] + rate[:-1]) / 2 * np.diff(found.time)))
    assert change == pytest.approx(lost, rel=0.02)
    assert abs(change) < 1e-7 * own[0]


def test_energy_with_damping_and_loads():
    """Damping takes what it says; what loads bring is off by the levers of the deformation."""
    found = ac.simulate(Plate(mesh=MESH), stop_time=0.1, tolerance=1e-9, energy=True).stats
    gap = found["energy_stored_change"] - found["energy_supplied"] + found["energy_dissipated"]
    assert found["energy_dissipated"] > 0
    assert abs(gap) < 1e-2 * abs(found["energy_supplied"])


def test_effects_switch_what_they_say():
    stop, runs = 0.005, {}
    for name in ("all", "centrifugal", "coriolis"):
        model = Thrown(centrifugal=name != "centrifugal", coriolis=name != "coriolis")
        runs[name] = ac.simulate(model, stop_time=stop, tolerance=1e-10, intervals=20)["body.q"]
    size = np.abs(runs["all"]).max()
    differences = [np.abs(runs[name] - runs["all"]).max() / size for name in ("centrifugal", "coriolis")]
    assert all(1e-6 < d < 0.2 for d in differences)


def test_a_study_of_effects_leaves_it_alone():
    """It is another method, and no simpler body: nothing is tried that bodies on joints refuse."""
    (inertia,) = (e for e in effects_of(FEPlate(mesh=MESH)) if e.path == "body.inertia")
    assert inertia.tries == ("second_order", "first_order", "constant")
    (chosen,) = (e for e in effects_of(Plate(mesh=MESH)) if e.path == "body.inertia")
    assert chosen.tries == ("second_order", "first_order", "constant", "reconfigured")


class Held(Model):
    """A rod on a ball joint, or on a hinge."""

    hold: str = structural("its reference frame", default="mean-axis")
    joint: str = structural("the joint", default="ball", choices=("ball", "hinge", "none"))
    world = World()

    @part
    def pin(self):
        return Spherical(angles_fixed=True) if self.joint == "ball" else Revolute()

    @part
    def body(self):
        return FEBody(reduced=rod(self.hold), inertia="reconfigured")

    def connections(self):
        if self.joint != "none":
            yield chain(self.world, self.pin, self.body.frame_a)
        else:
            yield connect(self.world.frame_b, self.pin.frame_a)


@pytest.mark.parametrize("joint", ["ball", "hinge"])
def test_a_body_on_a_joint_is_refused(joint):
    with pytest.raises(ac.DeclarationError, match="needs a free body, but the connections constrain") as caught:
        ac.compile(Held(joint=joint))
    assert "body" in str(caught.value)


def test_a_body_with_a_held_frame_is_refused():
    with pytest.raises(ac.DeclarationError, match=r'the modes of a free body, but .*hold="mean-axis"'):
        ac.compile(Held(hold="frame_a", joint="none"))
