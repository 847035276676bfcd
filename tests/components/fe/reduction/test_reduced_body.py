"""Reduced bodies as values: equal by what the equations use, small in a pickle, whole in a file."""

from __future__ import annotations

import copy
import os
import pickle
from dataclasses import replace

import numpy as np
import pytest

import acausal as ac
from components.fe import Interface, NodalField, ReducedBody, reduce_body
from tests.components.fe.bodies import HINGE, TIP, rod


@pytest.fixture(scope="module")
def body():
    M, K, nodes = rod()
    return reduce_body(M, K, nodes, frames={"hinge": HINGE, "tip": [TIP]}, hold="hinge", modes=40, damping=0.01)


def test_equal_by_what_the_equations_use(body):
    same = replace(body, nodal=None)
    assert same == body
    assert hash(same) == hash(body)
    assert repr(same) == repr(body)
    assert body.digest[:12] in repr(body)
    assert body != "body"
    nudged = body.modal_first.copy()
    nudged[0, 1] += 1e-12
    tip = body.interfaces[1]
    for other in (
        replace(body, modal_first=nudged),
        replace(body, D=2 * body.D),
        replace(body, mass=body.mass * (1 + 1e-15)),
        replace(body, interfaces=(body.interfaces[0], replace(tip, name="end"))),
        replace(body, interfaces=(body.interfaces[0], replace(tip, turns=True))),
        replace(body, interfaces=body.interfaces[::-1]),
        body.first(39),
    ):
        assert other != body
        assert repr(other) != repr(body)
    assert replace(body, first_moment=-0.0 * body.first_moment) == replace(body, first_moment=0.0 * body.first_moment)


def test_what_a_worker_is_sent(body):
    sent = pickle.dumps(body)
    assert len(sent) < 1_000_000
    there = pickle.loads(sent)
    assert there == body
    assert there.nodal is None
    assert body.nodal is not None
    assert copy.deepcopy(body) is body
    assert copy.copy(body) is body


def test_arrays_are_never_changed(body):
    with pytest.raises(ValueError, match="read-only"):
        body.K[0, 0] = 1.0
    with pytest.raises(AttributeError):
        body.mass = 1.0
    given = np.eye(3)
    frame = Interface("a", np.zeros(3), given, given)
    given[0, 0] = 5.0
    assert frame.displacement[0, 0] == 1.0


@pytest.mark.parametrize("n", [0, 1, 9, 40])
def test_first_modes(body, n):
    few = body.first(n)
    assert few.n == n
    assert few.modal_products.shape == (n, n, 3, 3)
    np.testing.assert_array_equal(few.K, body.K[:n, :n])
    np.testing.assert_array_equal(few.interfaces[1].displacement, body.interfaces[1].displacement[:, :n])
    assert few.nodal.modes.shape == (54, 3, n)
    assert few.first(n) == few
    M, K, nodes = rod()
    if n:
        own = reduce_body(M, K, nodes, frames={"hinge": HINGE, "tip": [TIP]}, hold="hinge", modes=n, damping=0.01)
        np.testing.assert_allclose(own.modal_products, few.modal_products, atol=1e-9)


@pytest.mark.parametrize("n", [-1, 41, 2.0, True, None, "3"])
def test_modes_that_are_not_there(body, n):
    with pytest.raises(ac.DeclarationError, match="must be an integer from 0 to 40"):
        body.first(n)


@pytest.mark.parametrize("nodal", [True, False])
def test_files_hold_all(body, tmp_path, nodal):
    path = tmp_path / "rod.npz"
    path.write_text("what was there before")
    body.save(path, nodal=nodal)
    there = ReducedBody.load(path)
    assert there == body
    assert (there.nodal is not None) == nodal
    if nodal:
        np.testing.assert_array_equal(there.nodal.modes, body.nodal.modes)
        np.testing.assert_array_equal(there.nodal.nodes, body.nodal.nodes)
    assert os.listdir(tmp_path) == ["rod.npz"]
    few = body.first(0)
    few.save(tmp_path / "none.npz")
    assert ReducedBody.load(tmp_path / "none.npz") == few


def test_elements_are_kept(body, tmp_path):
    field = NodalField(body.nodal.nodes, body.nodal.modes, {"hexahedron": np.arange(16).reshape(2, 8)})
    replace(body, nodal=field).save(tmp_path / "rod.npz")
    there = ReducedBody.load(tmp_path / "rod.npz").nodal
    np.testing.assert_array_equal(there.cells["hexahedron"], field.cells["hexahedron"])


def test_a_file_is_written_whole_or_not_at_all(body, tmp_path, monkeypatch):
    path = tmp_path / "rod.npz"
    body.first(3).save(path)

    def full(file, **_):
        file.write(b"half of it")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez_compressed", full)
    with pytest.raises(ac.ExportError, match=r"cannot write .*rod\.npz: No space left"):
        body.save(path)
    monkeypatch.undo()
    assert ReducedBody.load(path) == body.first(3)
    assert os.listdir(tmp_path) == ["rod.npz"]


@pytest.mark.parametrize("part", [0.0, 0.01, 0.3, 0.9, 0.999])
def test_truncated_files(body, tmp_path, part):
    path = tmp_path / "rod.npz"
    body.save(path)
    content = path.read_bytes()
    path.write_bytes(content[: int(part * len(content))])
    with pytest.raises(ac.DeclarationError, match=r"rod\.npz is not a reduced-body file"):
        ReducedBody.load(path)


def test_damaged_files(body, tmp_path):
    path = tmp_path / "rod.npz"
    body.first(5).save(path)
    content = bytearray(path.read_bytes())
    rng = np.random.default_rng(0)
    for _ in range(60):
        spoilt = content.copy()
        spoilt[rng.integers(len(content))] ^= 0xFF
        path.write_bytes(spoilt)
        try:
            there = ReducedBody.load(path)
        except ac.DeclarationError:
            continue
        assert there == body.first(5)


def test_foreign_files(tmp_path):
    path = tmp_path / "other.npz"
    np.savez(path, K=np.eye(3))
    with pytest.raises(ac.DeclarationError, match="is not a reduced-body file"):
        ReducedBody.load(path)
    np.savez(path, K=np.array([{"a": 1}], dtype=object))
    with pytest.raises(ac.DeclarationError, match="is not a reduced-body file"):
        ReducedBody.load(path)
    path.write_text("hello")
    with pytest.raises(ac.DeclarationError, match="is not a reduced-body file"):
        ReducedBody.load(path)
    np.save(tmp_path / "one.npy", np.eye(3))
    with pytest.raises(ac.DeclarationError, match="is not a reduced-body file"):
        ReducedBody.load(tmp_path / "one.npy")
    with pytest.raises(ac.DeclarationError, match="there is no reduced-body file"):
        ReducedBody.load(tmp_path / "none.npz")
    with pytest.raises(ac.DeclarationError, match="is not a reduced-body file"):
        ReducedBody.load(tmp_path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"K": np.eye(3)}, r"K of a reduced body must have shape \(2, 2\), not \(3, 3\)"),
        ({"modal_first": np.zeros(2)}, "three rows x, y, z"),
        (
            {"second_moment": np.full((3, 3), np.nan)},
            "second_moment of a reduced body contains numbers that are not finite",
        ),
        (
            {"interfaces": [Interface("a", np.zeros(3), np.zeros((3, 2)), np.zeros((3, 2)))] * 2},
            "must have different names: a, a",
        ),
        (
            {"interfaces": [Interface("a", np.zeros(3), np.zeros((3, 1)), np.zeros((3, 1)))]},
            "number of modes of a differs",
        ),
        ({"nodal": NodalField(np.zeros((4, 3)), np.zeros((4, 3, 1)))}, "number of modes of nodal differs"),
    ],
)
def test_bodies_that_cannot_be(body, change, message):
    with pytest.raises(ac.DeclarationError, match=message):
        replace(replace(body.first(2), interfaces=(), nodal=None), **change)


def test_interfaces_that_cannot_be():
    with pytest.raises(ac.DeclarationError, match=r"rotation of interface 'a' must have shape \(3, 2\), not \(3, 1\)"):
        Interface("a", np.zeros(3), np.zeros((3, 2)), np.zeros((3, 1)))
    with pytest.raises(ac.DeclarationError, match="place of interface 'a'"):
        Interface("a", np.zeros(2), np.zeros((3, 2)), np.zeros((3, 2)))
