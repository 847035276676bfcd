"""Steps in reconfigured inertial frames against the same method node by node, the reference files, and known motions."""

from __future__ import annotations

import signal
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from components.fe import FrameLoad, FrameMotion, Readings, as_result, reduce_body, simulate_reconfigured
from components.fe.reconfigured.free_modes import FreeModes
from components.fe.reconfigured.step_limits import limit
from models import FEPlate
from tests.components.fe import bodies
from tests.reference import inertial_frames
from tests.reference.reconfigured_limit import LimitPlate

DATA = Path(__file__).parents[3] / "reference/fe"
PLACES = {"P1": (-0.5, -0.025, 0), "end": (0.5, 0, 0)}
VARIANTS = ("paper", "corrected")


@cache
def plate(hold: str = "mean-axis", modes: int = 10):
    M, K, nodes = bodies.plate()
    frames = {name: [int(((nodes - place) ** 2).sum(axis=1).argmin())] for name, place in PLACES.items()}
    return reduce_body(M, K, nodes, frames=frames | {"face": bodies.face(nodes, 0, 0)}, hold=hold, modes=modes)


def fastest() -> float:
    return 2 * np.pi * plate().frequencies[-1]


def pulse(t: float) -> np.ndarray:
    return np.array([1, 0, 1]) * 50 / 2**0.5 * np.sin(np.pi * t / 0.1) * (t < 0.1)


@cache
def pushed(variant: str, dt: float = 1e-4) -> FrameMotion:
    return simulate_reconfigured(plate(), [FrameLoad("end", force=pulse)], 0.3, dt, variant=variant, damping=0.05)


@cache
def table(name: str) -> dict[str, np.ndarray]:
    found = np.genfromtxt(DATA / f"{name}.csv", delimiter=",", names=True, deletechars="")
    return {column: found[column] for column in found.dtype.names or ()}


def columns(name: str, quantity: str) -> np.ndarray:
    """A vector in SI."""
    found = table(name)
    keys = [key for key in found if key.startswith(quantity) and key[len(quantity)] in "123"]
    return np.stack([found[key] for key in keys], axis=1) * (1e-3 if "mm" in keys[0] else 1)


def shown(motion: FrameMotion) -> dict[str, np.ndarray]:
    return {
        "w": motion.w,
        "al": motion.al,
        "P1x": motion.place("P1"),
        "P1v": motion.velocity("P1"),
        "P1a": motion.acceleration("P1"),
    }


@pytest.mark.parametrize("variant", VARIANTS)
def test_node_by_node(variant):
    """In a general state, with the increments of all modes at all nodes."""
    body, steps, dt = plate(), 40, 1e-4
    random = np.random.default_rng(1)
    q, qd = 1e-3 * random.standard_normal(10), 0.1 * random.standard_normal(10)
    velocity, spin = random.standard_normal(3), 3 * random.standard_normal(3)
    push = FrameLoad("end", force=pulse)
    found = simulate_reconfigured(
        body, [push], steps * dt, dt, variant=variant, damping=0.05, velocity=velocity, spin=spin, q=q, qd=qd
    )
    M, _, _ = bodies.plate()
    assert body.nodal is not None
    squares = np.diag(body.K) / np.diag(body.M)
    loaded = int(((body.nodal.nodes + body.origin - PLACES["end"]) ** 2).sum(axis=1).argmin())
    nodes = inertial_frames.Nodes(
        M, body.nodal.nodes, body.nodal.modes.reshape(-1, 10), squares, 0.1 * np.sqrt(squares), loaded
    )
    carried = nodes.project(nodes.turn(inertial_frames.skew(spin), nodes.flexible @ q))[6:]
    start = np.concatenate([np.zeros(6), q]), np.concatenate([velocity, spin, qd + carried])
    method = inertial_frames.printed if variant == "paper" else inertial_frames.corrected
    expected = method(nodes, pulse, start, dt, steps)
    compared = {"O": found.r_0, "A": found.T, "q": found.amplitudes, "v": found.rates, "a": found.outputs[:, :16]}
    for name, values in compared.items():
        # A reduced body leaves out what is rounding of its integrals.
        assert np.abs(values - expected[name]).max() < 1e-8 * np.abs(expected[name]).max(), name


@cache
def lopsided(modes: int = 5):
    """A block with masses that differ from node to node: no integral vanishes, and its axes are not principal ones."""
    M, K, nodes = bodies.block()
    M = M.copy()
    M.setdiag(M.diagonal() + np.repeat(np.random.default_rng(0).uniform(0, 2, len(nodes)), 3))
    return M, reduce_body(
        M, K, nodes, frames={"end": [0], "face": bodies.face(nodes, 0, -1)}, hold="mean-axis", modes=modes
    )


@pytest.mark.parametrize("modes", [1, 5])
@pytest.mark.parametrize("variant", VARIANTS)
def test_node_by_node_without_symmetry(variant, modes):
    M, body = lopsided(modes)
    spin, dt, steps = np.array((30.0, -20.0, 40.0)), 0.2 / (2 * np.pi * body.frequencies[-1]), 50
    assert body.nodal is not None
    squares = np.diag(body.K) / np.diag(body.M)
    nodes = inertial_frames.Nodes(
        M, body.nodal.nodes, body.nodal.modes.reshape(-1, modes), squares, 0.1 * np.sqrt(squares), 0
    )

    def force(t):
        return np.array((2000 * np.cos(50 * t), -700.0, 500 + 1e5 * t))

    found = simulate_reconfigured(
        body, [FrameLoad("end", force=force)], steps * dt, dt, variant=variant, damping=0.05, spin=spin
    )
    method = inertial_frames.printed if variant == "paper" else inertial_frames.corrected
    start = np.zeros(6 + modes), np.concatenate([np.zeros(3), spin, np.zeros(modes)])
    expected = method(nodes, force, start, dt, steps)
    for name, values in {"O": found.r_0, "A": found.T, "q": found.amplitudes, "v": found.rates}.items():
        assert np.abs(values - expected[name]).max() < 1e-6 * np.abs(expected[name]).max(), name


@pytest.mark.parametrize("variant", VARIANTS)
def test_axes_of_the_world_do_not_matter(variant):
    """Attitude, velocity, weight and load turned alike: the same motion, seen from there."""
    turn = Rotation.from_rotvec((0.7, -1.9, 0.4)).as_matrix()
    _, body = lopsided()

    def run(R):
        return simulate_reconfigured(
            body,
            [FrameLoad("end", force=lambda t: R @ (300.0, 200 * np.sin(100 * t), -100))],
            0.01,
            1e-5,
            variant=variant,
            spin=(10, -20, 30),
            velocity=R @ (1, 2, 3),
            gravity=R @ (0, 0, -9.81),
            attitude=R.T,
        )

    plain, turned = run(np.eye(3)), run(turn)
    np.testing.assert_allclose(turned.r_0, plain.r_0 @ turn.T, rtol=0, atol=1e-12)
    np.testing.assert_allclose(turned.T, plain.T @ turn.T, rtol=0, atol=1e-10)
    # A rotation vector that goes on is none of another attitude: the method is of order 1 in both.
    bound = 1e-9 if variant == "corrected" else 1e-6
    assert np.abs(turned.q - plain.q).max() < bound * np.abs(plain.q).max()


@pytest.mark.parametrize("quantity", ["w", "al", "P1x", "P1v", "P1a"])
def test_as_printed(quantity):
    expected = columns("plate_halfsine_lit", f"lit_{quantity}")
    found = shown(pushed("paper"))[quantity][::40]
    assert np.abs(found - expected).max() < 1e-8 * np.abs(expected).max()


@pytest.mark.parametrize(("variant", "gap"), [("paper", 5e-6), ("corrected", 2.5e-6)])
def test_beside_the_floating_frame(variant, gap):
    found = shown(pushed(variant))
    assert np.abs(found["w"][::40] - columns("plate_halfsine_sym", "ffrf_w")).max() < 2.5e-5
    assert np.abs(found["P1x"][::40] - columns("plate_halfsine_sym", "ffrf_P1x")).max() < gap


@pytest.mark.parametrize(("variant", "order"), [("paper", 1.0), ("corrected", 4.0)])
def test_order(variant, order):
    """Differences of w and of a place where steps are halved, with a load that turns and a spin about all axes."""
    stop = 0.05

    def load(t):
        return 20.0, 5 * np.cos(30 * t), 30 * np.sin(50 * t)

    def end(share):
        dt = stop / round(stop * fastest() / share)
        found = simulate_reconfigured(
            plate(), [FrameLoad("end", force=load)], stop, dt, variant=variant, damping=0.05, spin=(2, -6, 3)
        )
        return found.w[-1], found.place("P1")[-1]

    runs = [end(share) for share in (0.4, 0.2, 0.1, 0.05)]
    for values in zip(*runs, strict=True):
        steps = [np.linalg.norm(a - b) for a, b in pairwise(values)]
        rates = np.log2(np.array(steps[:-1]) / steps[1:])
        print(variant, rates)
        if variant == "paper":
            assert abs(rates[-1] - order) < 0.03
        else:
            assert rates.min() > 3.9


def test_order_with_a_load_that_jumps_between_steps():
    def load(t):
        return (20, 5, 10 + 100 * t) if t < 0.02 else (0, -10, 0)

    def end(dt):
        push = FrameLoad("end", force=load)
        return simulate_reconfigured(plate(), [push], 0.05, dt, damping=0.05, spin=(2, -6, 3)).w[-1]

    runs = [end(dt) for dt in (1e-4, 5e-5, 2.5e-5)]
    assert np.log2(np.linalg.norm(runs[0] - runs[1]) / np.linalg.norm(runs[1] - runs[2])) > 3.8


@pytest.mark.parametrize(("variant", "expected"), [("paper", (2, 3, 6)), ("corrected", (1.846, 2.999, 5.970))])
def test_angular_acceleration_of_a_spin(variant, expected):
    found = simulate_reconfigured(plate(), (), 1e-3, 1e-4, variant=variant, spin=(3, -2, 1))
    np.testing.assert_allclose(found.al[0], expected, atol=5e-4)


@pytest.mark.parametrize(("rule", "least", "most"), [("moving", 0, 1e-6), ("modal", 0.142, 0.144)])
def test_embedded_acceleration_is_the_rigid_one_in_plane_motion(rule, least, most):
    found = pushed("paper").acceleration("P1", rule, embedded=True)[::40]
    assert least <= np.abs(found - columns("plate_halfsine_lit", "rigid_P1a")).max() < most


def test_acceleration_of_a_deformed_point():
    """Beside the floating frame: 2 w x u and what the modes do not hold count."""
    model = FEPlate(mesh=str(DATA / "plate_fe_h25.npz"))
    exact = ac.simulate(model, stop_time=0.3, tolerance=1e-9, intervals=300)
    expected = np.einsum("tij,ti->tj", exact["body.P1.R.T"], exact["body.P1.a"])
    for variant, least, most in (("paper", 1e-2, 2e-2), ("corrected", 0, 3e-4)):
        assert least <= np.abs(pushed(variant).acceleration("P1")[::10] - expected).max() < most
        assert np.abs(pushed(variant).acceleration("P1", "moving")[::10] - expected).max() < 3e-4


def energy(motion: FrameMotion) -> np.ndarray:
    body, v, q = motion.modes.body, motion.rates, motion.q
    forms = ((v[:, 3:6], motion.modes.inertia), (v[:, 6:], body.M), (q, body.K))
    moved = body.mass * (v[:, :3] ** 2).sum(axis=1)
    return (moved + sum(np.einsum("ti,ij,tj->t", x, A, x) for x, A in forms)) / 2


@pytest.mark.parametrize(
    ("spin", "dt", "expected"),
    [
        ((0.5, -2, 1), 2e-4, 9.4e-4),
        ((0.5, -2, 1), 1e-4, 4.7e-4),
        ((2, -6, 3), 2e-4, 8.5e-3),
        ((2, -6, 3), 1e-4, 4.1e-3),
    ],
)
def test_drift_of_the_energy(spin, dt, expected):
    """As printed with the square of the spin and with the step; corrected, what remains is less by a thousand times."""
    drift = {}
    for variant in VARIANTS:
        found = energy(simulate_reconfigured(plate(), (), 1.0, dt, variant=variant, spin=spin))
        drift[variant] = abs(found[-1] / found[0] - 1)
    np.testing.assert_allclose(drift["paper"], expected, rtol=0.02)
    assert drift["corrected"] < drift["paper"] / 1000


@pytest.mark.parametrize("rotation", ["accumulated", "restarted"])
@pytest.mark.parametrize("variant", VARIANTS)
def test_full_turn_without_a_jump(variant, rotation):
    readings = Readings(rotation=rotation) if variant == "paper" else None
    found = simulate_reconfigured(plate(), (), 0.12, 1e-4, variant=variant, readings=readings, spin=(0, 0, 60))
    turns = np.diff(np.unwrap(np.arctan2(found.T[:, 0, 1], found.T[:, 0, 0])))
    assert np.abs(turns - 6e-3).max() < 0.05 * 6e-3
    assert turns.sum() > 2 * np.pi


def test_tumbling_beside_the_floating_frame():
    """The gap is 6e-6 of the spin; see the next test for what it follows."""
    found = simulate_reconfigured(plate(), (), 0.3, 1e-4, spin=(2, -6, 3))
    assert np.abs(found.w[::40] - columns("plate_tumbling", "w")).max() < 1e-4
    assert np.abs(found.place("P1")[::40] - columns("plate_tumbling", "P1x")).max() < 5e-6


@pytest.mark.parametrize(("size", "expected"), [(3.2, 4.0e-6), (12.8, 2.6e-4)])
def test_gap_of_a_short_step_goes_with_the_cube_of_the_spin(size, expected):
    """Levers are those of the undeformed body, and w x u counts as far as the modes hold it."""
    spin = (size / 3**0.5,) * 3
    model = FEPlate(mesh=str(DATA / "plate_fe_h25.npz"), spin=spin, load="none", damping=0.0)
    exact = ac.simulate(model, stop_time=0.04, tolerance=1e-9, intervals=40)
    found = simulate_reconfigured(plate(), (), 0.04, 2.5e-5, spin=spin)
    gap = np.abs(found.w[::40] - exact["body.w_a"]).max()
    np.testing.assert_allclose(gap, expected, rtol=0.05)
    half = simulate_reconfigured(plate(), (), 0.04, 1.25e-5, spin=spin)
    assert np.abs(found.w - half.w[::2]).max() < 1e-3 * gap  # none of it comes from the step


def test_limit_of_short_steps():
    """An ordinary differential equation, integrated by another method: what differs from it goes with dt to the power of 4."""
    spin, stop = (2, -6, 3), 0.05
    model = LimitPlate(mesh=str(DATA / "plate_fe_h25.npz"), spin=spin)
    exact = ac.simulate(model, stop_time=stop, tolerance=1e-9, intervals=100)
    push, errors = FrameLoad("end", force=pulse), []
    for dt in (1e-4, 5e-5):
        found = simulate_reconfigured(plate(), [push], stop, dt, damping=0.05, spin=spin)
        every = round(stop / dt) // 100
        pairs = (found.w, exact["body.w_a"]), (found.place("P1"), exact["body.P1.r_0"]), (found.qdd, exact["body.qdd"])
        errors.append([np.abs(a[::every] - b).max() / np.abs(b).max() for a, b in pairs])
    assert (np.array(errors[1]) < (1e-8, 1e-6, 1e-3)).all()
    assert (np.log2(np.divide(*errors)) > 3.8).all()


@pytest.mark.parametrize(("damping", "stable", "unstable"), [(0.0, 2.80, 2.85), (0.05, 2.90, 3.0)])
def test_limit_of_stability(damping, stable, unstable):
    modes = FreeModes(plate(), np.full(10, damping))
    most, rate = limit(modes)
    assert stable < most * rate < unstable
    dt = stable / rate
    found = simulate_reconfigured(plate(), (), 4000 * dt, dt, damping=damping, q=1e-6)
    assert np.abs(found.q[-1]).max() <= 1e-6
    with pytest.raises(ac.DeclarationError, match=r"dt \* omega_max = .*, the limit is 2\.[89].* Use dt="):
        simulate_reconfigured(plate(), (), 40 * unstable / rate, unstable / rate, damping=damping)


def test_weight_and_place():
    """A body that is thrown: its centre of mass on a parabola, whatever it does beside."""
    g, v = np.array((0, 0, -9.81)), np.array((1.0, 2.0, 3.0))
    found = simulate_reconfigured(
        plate(), (), 0.2, 1e-4, gravity=g, velocity=v, position=(1, 2, 3), spin=(1, 2, 3), q=1e-4
    )
    t = found.time[:, None]
    np.testing.assert_allclose(found.r_0, (1, 2, 3) + v * t + g * t**2 / 2, atol=1e-12)


def test_velocities_and_accelerations_are_derivatives():
    found = pushed("corrected")
    for values, rates in (
        (found.place("P1"), found.velocity("P1")),
        (found.velocity("P1"), found.acceleration("P1")),
        (found.q, found.qd),
        (found.qd, found.qdd),
    ):
        steps = (values[2:] - values[:-2]) / 2e-4
        assert np.abs(steps - rates[1:-1])[20:900].max() < 0.02 * np.abs(rates).max()


def test_follower():
    """A force along an axis of the body, and the same force resolved in the world."""
    found = simulate_reconfigured(plate(), [FrameLoad("face", moment=(0, 0.1, 0), follower=True)], 0.05, 1e-4)
    world = simulate_reconfigured(plate(), [FrameLoad("face", moment=(0, 0.1, 0))], 0.05, 1e-4)
    np.testing.assert_allclose(found.w, world.w, atol=1e-9)  # the axis does not turn
    A = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1.0]])
    ahead = simulate_reconfigured(plate(), [FrameLoad("end", force=(1, 0, 2), follower=True)], 0.05, 1e-4, attitude=A)
    plain = simulate_reconfigured(plate(), [FrameLoad("end", force=(1, 0, 2), follower=True)], 0.05, 1e-4)
    np.testing.assert_allclose(ahead.r_0, plain.r_0 @ A, atol=1e-15)


REFUSED = [
    ({"body": "face"}, 'hold="mean-axis"'),
    ({"loads": [FrameLoad("tip", force=(0, 0, 1))]}, "no frame `tip`: it has P1, end, face"),
    ({"loads": FrameLoad("end")}, "loads must be a list"),
    ({"loads": [FrameLoad("end", moment=(0, 0, 1))]}, "cannot carry a moment"),
    ({"loads": [FrameLoad("end", force=lambda t: 1.0)]}, "vector of three numbers"),
    ({"dt": 1e-3}, r"unstable: dt \* omega_max = 3\.75"),
    ({"stop_time": 0.25e-4}, "not a multiple of the step"),
    ({"variant": "other"}, "'corrected', 'paper'"),
    ({"readings": Readings()}, 'applies to variant="paper" only'),
    ({"q": (1, 2)}, "one number or 10"),
    ({"spin": (1, 2)}, "spin at the start must be a vector of three numbers"),
    ({"damping": -0.1}, "must not be negative"),
    ({"attitude": np.ones((3, 3))}, "rotation matrix"),
]


@pytest.mark.parametrize(("given", "words"), REFUSED)
def test_refused(given, words):
    values = {"body": "mean-axis", "stop_time": 0.01, "dt": 1e-4, **given}
    with pytest.raises(ac.DeclarationError, match=words):
        simulate_reconfigured(plate(values.pop("body")), **values)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"rotation": "both"}, "`rotation` must be 'accumulated' or 'restarted'"),
        ({"points": ((1, 0, 0), (-2, 0, 0))}, "collinear"),
    ],
)
def test_refused_readings(given, words):
    with pytest.raises(ac.DeclarationError, match=words):
        Readings(**given)


def test_diverged():
    """Beyond its first frequency a body that spins is torn apart by what it does not stiffen by."""
    with pytest.raises(
        ac.SimulationError, match=r"diverges in step \d+.*dt \* omega_max = 0\.37.*rotates at up to"
    ) as caught:
        simulate_reconfigured(plate(), (), 2.0, 1e-4, spin=(0, 400, 0), q=1e-4)
    assert isinstance(caught.value.result, FrameMotion)
    assert np.isfinite(caught.value.result.q).all()


def test_interrupted():
    def interrupt(part, steps):
        if part > 0.5:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt) as caught:
        simulate_reconfigured(plate(), (), 0.3, 1e-4, progress=interrupt)
    reached: Any = caught.value
    assert 1500 < len(reached.result.time) < 1800
    np.testing.assert_array_equal(
        reached.result.w, simulate_reconfigured(plate(), (), 0.3, 1e-4).w[: len(reached.result.time)]
    )


@pytest.mark.parametrize("variant", VARIANTS)
def test_result_by_the_names_of_a_body(variant, tmp_path):
    """Rates of a frame that turns with the deformation are derivatives of its place and attitude."""
    follower = FrameLoad("face", force=(0, 3, 5), moment=(1, 0.1, 0.2), follower=True)
    motion = simulate_reconfigured(plate(), [follower], 0.02, 1e-5, variant=variant, damping=0.05, spin=(1, 2, 3))
    found = as_result(motion)
    T, w, v = (found[f"body.face.{name}"] for name in ("R.T", "R.w", "v"))
    rate = (T[2:] - T[:-2]) / 2e-5
    turned = -np.einsum("tij,tkj->tik", rate, T[1:-1])  # the matrix of w x
    assert np.abs(np.stack([turned[:, 2, 1], turned[:, 0, 2], turned[:, 1, 0]], axis=1) - w[1:-1]).max() < 1e-3
    moved = (found["body.face.r_0"][2:] - found["body.face.r_0"][:-2]) / 2e-5
    # As printed, rates are of the order 1, and w x u counts in the modes alone.
    bound = 1e-4 if variant == "corrected" else 1e-2
    assert np.abs(np.einsum("tij,tj->ti", T[1:-1], moved) - v[1:-1]).max() < bound * np.abs(v).max()
    if variant == "corrected":
        z = (w[2:] - w[:-2]) / 2e-5
        assert np.abs(z - found["body.face.z"][1:-1])[10:].max() < 1e-2 * np.abs(z).max()
    found.to_csv(tmp_path / "motion.csv")
    assert (tmp_path / "motion.csv").read_text().startswith("time,body.r_0[0]")
    np.testing.assert_array_equal(found["body.ref.R.w"], motion.w)
    np.testing.assert_array_equal(found["body.embedded.P1.r_0"][0], plate().interfaces[0].place)
    assert found.stats.steps == 2000
    assert ac.Result is type(found)


@pytest.mark.parametrize("variant", VARIANTS)
def test_warns_near_the_first_frequency(variant):
    """That is 154 rad/s; both methods differ in kind there."""
    with pytest.warns(ac.AcausalWarning, match="rotates at up to 100 rad/s, faster than half"):
        simulate_reconfigured(plate(), (), 1e-3, 1e-4, variant=variant, spin=(0, 0, 100))


def test_rigid():
    """Without modes: Newton and Euler, with all invariants."""
    found = simulate_reconfigured(plate().first(0), (), 1.0, 1e-3, spin=(1, 2, 3))
    J = found.modes.inertia
    twice = np.einsum("ti,ij,tj->t", found.w, J, found.w)
    assert abs(twice[-1] / twice[0] - 1) < 1e-12
    momentum = np.einsum("tij,ti->tj", found.T, found.w @ J)
    np.testing.assert_allclose(momentum, np.broadcast_to(J @ (1, 2, 3), momentum.shape), rtol=0, atol=1e-10)


@pytest.mark.parametrize(
    ("readings", "order"),
    [
        (Readings(increments="mapped"), None),
        (Readings(force="step"), 1.0),
        (Readings(middle="middle"), 1.0),
        (Readings(rigid_part="zeroed"), 1.0),
        (Readings(rotation="restarted"), 1.0),
        (Readings(points=((0, 1, 0), (0.6, 0, 0.8))), 1.0),
    ],
)
def test_readings_leave_the_order(readings, order):
    """Each changes the constant alone, but increments that are mapped back, whose order is near 1 from 0.9 to 1.6."""
    ends = [
        simulate_reconfigured(
            plate(),
            [FrameLoad("end", force=pulse)],
            0.05,
            dt,
            variant="paper",
            readings=readings,
            damping=0.05,
            spin=(2, -6, 3),
        ).w[-1]
        for dt in (5e-5, 2.5e-5, 1.25e-5)
    ]
    rate = np.log2(np.linalg.norm(ends[0] - ends[1]) / np.linalg.norm(ends[1] - ends[2]))
    assert 0.9 < rate < 1.7 if order is None else abs(rate - order) < 0.05
