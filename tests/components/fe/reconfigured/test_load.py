"""Loads at frames and nodes of a free body, and what is refused."""

from __future__ import annotations

import pickle
import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import acausal as ac
from components.fe import FrameLoad, NodalResult, Readings, as_result, reduce_body, simulate_reconfigured
from components.fe.elements.faces import area_weights
from tests.components.fe import bodies
from tests.components.fe.reconfigured.test_reconfigured import PLACES, lopsided, plate, pulse


def node(place: Any) -> int:
    _, _, nodes = bodies.plate()
    return int(((nodes - place) ** 2).sum(axis=1).argmin())


def run(*loads: FrameLoad, body: Any = None, **given: Any) -> Any:
    return simulate_reconfigured(body or plate(), loads, 0.02, 1e-4, spin=(1, -2, 3), **given)


@pytest.mark.parametrize("follower", [False, True])
@pytest.mark.parametrize("variant", ["corrected", "paper"])
def test_a_node_is_the_frame_at_that_node(variant, follower):
    at_frame = run(FrameLoad("end", force=pulse, follower=follower), variant=variant)
    at_node = run(FrameLoad(node=node(PLACES["end"]), force=pulse, follower=follower), variant=variant)
    for name in ("r_0", "w", "q", "rates"):
        expected = getattr(at_frame, name)
        np.testing.assert_allclose(getattr(at_node, name), expected, rtol=0, atol=1e-9 * np.abs(expected).max())


def test_a_node_without_a_frame():
    """Against a frame made for it, and the motion there, far off all axes of the body."""
    M, K, nodes = bodies.block()
    body = reduce_body(M, K, nodes, frames={"other": [1], "point": [7]}, hold="mean-axis", modes=5)
    dt = 0.2 / (2 * np.pi * body.frequencies[-1])
    found, expected = (
        simulate_reconfigured(body, [load], 100 * dt, dt, spin=(3, 4, 5))
        for load in (FrameLoad(node=7, force=(1, 2, 3)), FrameLoad("point", force=(1, 2, 3)))
    )
    assert np.abs(found.q - expected.q).max() < 1e-9 * np.abs(expected.q).max()
    nodal = NodalResult(as_result(found), "body", body)
    np.testing.assert_allclose(nodal.position([7])[:, 0], found.place("point"), rtol=0, atol=1e-9)


def test_nodes_share_a_force_as_an_averaging_frame_does():
    _, body = lopsided()
    _, _, nodes = bodies.block()
    face = bodies.face(nodes, 0, -1)
    dt = 0.2 / (2 * np.pi * body.frequencies[-1])
    areas = area_weights(face, nodes, nodes.cells)
    assert areas is not None
    shares = [
        FrameLoad(node=int(k), force=np.array((1.0, 2, 3)) * a) for k, a in zip(face, areas / areas.sum(), strict=True)
    ]
    found, expected = (
        simulate_reconfigured(body, loads, 50 * dt, dt) for loads in (shares, [FrameLoad("face", force=(1, 2, 3))])
    )
    assert np.abs(found.q - expected.q).max() < 1e-9 * np.abs(expected.q).max()
    np.testing.assert_allclose(found.w, expected.w, rtol=1e-9, atol=1e-12 * np.abs(expected.w).max())


def test_a_couple_of_nodes_is_a_moment():
    """Two forces on the ends of a rigid plate that turn with it, against the moment that they are."""
    P1, end = node(PLACES["P1"]), node(PLACES["end"])
    nodal = plate().nodal
    assert nodal is not None
    force, rigid = np.array((0.0, 1.0, 2.0)), plate().first(0)
    sides = [FrameLoad(node=at, force=sign * force, follower=True) for at, sign in ((end, 1), (P1, -1))]
    couple = run(*sides, body=rigid)
    turning = np.cross(nodal.nodes[end] - nodal.nodes[P1], force)
    moment = run(FrameLoad("face", moment=turning, follower=True), body=rigid)
    np.testing.assert_allclose(couple.w, moment.w, rtol=0, atol=1e-12 * np.abs(moment.w).max())


@pytest.mark.parametrize(
    ("load", "words"),
    [
        (FrameLoad(force=(0, 0, 1)), "either a frame or a node"),
        (FrameLoad("end", node=3, force=(0, 0, 1)), "either a frame or a node"),
        (FrameLoad(node=1755, force=(0, 0, 1)), "no node 1755; nodes are numbered 0 to 1754"),
        (FrameLoad(node=-1, force=(0, 0, 1)), "no node -1"),
        (FrameLoad(node=1.0, force=(0, 0, 1)), "row of the nodes, counted from 0, not 1.0"),  # type: ignore[arg-type]
        (FrameLoad(node=True, force=(0, 0, 1)), "counted from 0, not True"),
        (FrameLoad(node=3, moment=(0, 0, 1)), "node 3 has no rotation and cannot carry a moment"),
        (FrameLoad(17, force=(0, 0, 1)), "no frame 17: it has P1, end, face"),  # type: ignore[arg-type]
        (FrameLoad("end", force=None), "vector of three numbers, not None"),  # type: ignore[arg-type]
        (FrameLoad("end", force=(0, 0)), r"vector of three numbers, not \(0, 0\)"),
        (FrameLoad("end", force=[1, [2], 3]), "vector of three numbers"),  # type: ignore[list-item]
        (FrameLoad("end", force=(0, 0, np.nan)), "force at `end` is not finite$"),
        (FrameLoad("end", force=lambda t: (0, 0, np.inf if t > 0.01 else 0)), r"not finite at t = 0\.01 s"),
        (FrameLoad("end", force=lambda t: None), "not None at t = "),
        (FrameLoad("end", force=lambda t: 0.0 if t > 0.01 else (0, 0, 1)), r"three numbers, not 0\.0 at t = 0\.01 s"),
        (FrameLoad("end", force=(0, 0, 1), follower="no"), "True or False, not 'no'"),  # type: ignore[arg-type]
        (FrameLoad("end", force=(0, 0, 1), breaks=(np.nan,)), "breaks of the load at `end` must be times in s"),
        (FrameLoad("end", force=(0, 0, 1), breaks="now"), "breaks of the load at `end` must be times in s"),  # type: ignore[arg-type]
    ],
)
def test_refused(load, words):
    with pytest.raises(ac.DeclarationError, match=words):
        run(load)


def test_a_body_without_modes_at_nodes():
    """As one that came from another process: the call that gives it a frame there."""
    sent = pickle.loads(pickle.dumps(plate()))
    with pytest.raises(ac.DeclarationError, match=r'no nodal modes.*frames=\{"point": \[17\]\}.*FrameLoad\("point"'):
        run(FrameLoad(node=17, force=(0, 0, 1)), body=sent)
    assert np.array_equal(run(FrameLoad("end", force=pulse), body=sent).w, run(FrameLoad("end", force=pulse)).w)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"dt": "x"}, "the step must be a positive, finite number of s, not 'x'"),
        ({"dt": np.full(1, 1e-4)}, "the step must be a positive"),
        ({"stop_time": None}, "the stop time must be a positive, finite number of s, not None"),
        ({"dt": 1e-14}, "more than the limit of 1e.09"),
        ({"attitude": "x"}, "rotation matrix"),
        ({"attitude": np.full((3, 3), np.nan)}, "rotation matrix"),
        ({"variant": "paper", "readings": {"force": "step"}}, "readings must be Readings"),
        ({"damping": (0.05,) * 9}, "damping ratios of 10 modes must be one number or 10"),
        ({"gravity": 9.81}, "gravity must be a vector of three numbers, not 9.81"),
        ({"gravity": (0, 0, np.nan)}, "gravity is not finite$"),
        ({"position": (1, 2)}, r"position at the start must be a vector of three numbers, not \(1, 2\)"),
    ],
)
def test_wrong_arguments(given, words):
    with pytest.raises(ac.DeclarationError, match=words):
        simulate_reconfigured(plate(), (), **{"stop_time": 0.01, "dt": 1e-4, **given})


def test_modes_that_are_rigid_motion_are_told_from_soft_ones():
    """As of a mast with a stiff foot: its first frequency is far below the last."""
    body = plate()
    K = body.K.copy()
    K[0, 0] = 1e-9 * K.max()
    simulate_reconfigured(replace(body, K=K), (), 1e-3, 1e-4)
    for share in (0.0, -1e-12, 1e-14):
        K[0, 0] = share * K.max()
        with pytest.raises(ac.DeclarationError, match="is a rigid-body motion"):
            simulate_reconfigured(replace(body, K=K), (), 1e-3, 1e-4)
    moves, turns = body.modal_first.copy(), body.modal_second.copy()
    moves[0, 2], turns[3, 0, 1] = 0.1, turns[3, 0, 1] + 0.1
    for wrong in ({"modal_first": moves}, {"modal_second": turns}):
        with pytest.raises(ac.DeclarationError, match=r'its modes contain rigid motion: .*hold="mean-axis"'):
            simulate_reconfigured(replace(body, **wrong), (), 1e-3, 1e-4)


def test_wrong_points_of_a_reading():
    for points in (((1, 0), (0, 1, 0)), "ab"):
        with pytest.raises(ac.DeclarationError, match="`points` must be two directions"):
            Readings(points=points)  # type: ignore[arg-type]


@pytest.mark.parametrize("stop_time", [0.01, 0.03, 0.07, 0.3, 1.0])
@pytest.mark.parametrize("dt", [2e-3, 1e-3, 8e-4, 3e-4])
def test_a_step_that_is_proposed_works(dt, stop_time):
    """Whether the one asked for is unstable or no part of the run."""
    try:
        simulate_reconfigured(plate(), (), stop_time, dt)
    except ac.DeclarationError as error:
        proposed = float(str(error).split("dt=")[1].split()[0])
        found = simulate_reconfigured(plate(), (), stop_time, proposed)
        assert found.time[-1] == pytest.approx(stop_time, rel=1e-12)


def test_a_rigid_body_that_diverges_names_its_turn():
    with pytest.raises(ac.SimulationError, match=r"the body rotates at \d+ rad/s, .* rad in a step of 0\.01 s"):
        simulate_reconfigured(plate().first(0), (), 10.0, 1e-2, spin=(1e3, 2e3, 3e3))


def test_a_break_inside_of_a_step_of_one_size_is_told():
    push = FrameLoad("end", force=pulse, breaks=[0.01005])
    with pytest.warns(ac.AcausalWarning, match=r"breaks at t = 0\.01005 s, inside a step of 0\.0001 s"):
        run(push)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run(FrameLoad("end", force=pulse, breaks=[0.01, -1, 5]))
