"""SID: what is written is read again, in any unit and any order of indices; the matrices are those of the equations."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from acausal import AcausalWarning, DeclarationError
from components.fe import ReducedBody, box, read_sid, reduce_body, write_sid
from components.fe.formats.sid_tree import ORDERS, index_order, read_tree, taylor
from tests.components.fe.samples import scaled_sid

BODY = reduce_body(
    *box((0.1, 0.02, 0.03), (3, 1, 1), "hex8", E=7e10, nu=0.33, rho=2700),
    frames={"root": [0, 1, 2, 3], "tip": [12, 13, 14, 15], "edge": [12, 13], "point": [14]},
    hold="root",
    modes=4,
    damping=0.01,
)
ARRAYS = ("first_moment", "second_moment", "modal_first", "modal_second", "modal_products", "M", "K", "D")
MAPS = ("place", "displacement", "rotation", "axes")
# What happens to the text of a file, and a part of the message.
WRONG = {
    "empty": (lambda s: "", "the file is empty"),
    "binary": (lambda s: "\0\1" * 50, "this is a binary file"),
    "foreign": (lambda s: "hello\n", "line 1: a SID block"),
    "cut": (lambda s: s[: len(s) // 2], "truncated|not a finite number|a SID block|is outside"),
    "cut_at_a_line": (lambda s: s[: s.index("         end node")], "it ends inside `node`"),
    "two_bodies": (lambda s: s + s, "one `new modal` inside `part`, but this file has 2"),
    "no_mass": (lambda s: re.sub(r"\n *mass .*", "", s), "refmod needs the numbers"),
    "mass": (lambda s: re.sub(r"mass *= .*", "mass = -1", s), "mass must be positive"),
    "word": (lambda s: re.sub(r"m0\( *1, *1\) = .*", "m0(1,1) = x", s), "is `x`, not a finite number"),
    "nan": (lambda s: re.sub(r"m0\( *1, *1\) = .*", "m0(1,1) = nan", s), "not a finite number"),
    "outside": (lambda s: s.replace("m0(   1,   1)", "m0(   9,   1)", 1), "is outside origin, which is 3 x 1"),
    "zero": (lambda s: s.replace("m0(   1,   1)", "m0(   0,   1)", 1), "is outside origin"),
    "huge": (lambda s: s.replace("nrow         = 3", "nrow = 999999999", 1), "too large for a reduced body"),
    "rows": (lambda s: s.replace("nrow         = 3", "nrow = x", 1), "needs an integer nrow, not `x`"),
    "no_block": (lambda s: re.sub(r"      Oe\n.*?end Oe\n", "", s, flags=re.S), "`modal` has 0 blocks `Oe`"),
    "size": (lambda s: s.replace("nelastq      = 4", "nelastq = 3"), "is .*, but 3 modes need"),
    "end": (lambda s: s.replace("end phi", "end psi", 1), "`end phi` is expected here, not `end psi`"),
    "ends": (lambda s: s + "end part\n", "a block is expected here"),
    "moving": (lambda s: re.sub(r"(tip\n(?:.*\n)*?.*m1\(.*\) =) .*", r"\1 77", s, count=1), "differs from m0 of `phi`"),
}  # fmt: skip


@pytest.fixture
def text(tmp_path: Path) -> str:
    write_sid(BODY, tmp_path / "body.sid")
    return (tmp_path / "body.sid").read_text()


def compare(found: ReducedBody, digits: float) -> None:
    assert found.mass == pytest.approx(BODY.mass, rel=1e-14)
    for name in ARRAYS:
        size = np.abs(getattr(BODY, name)).max()
        assert np.abs(getattr(found, name) - getattr(BODY, name)).max() <= digits * size, name
    assert [i.name for i in found.interfaces] == [i.name for i in BODY.interfaces]
    for one, other in zip(found.interfaces, BODY.interfaces, strict=True):
        for name in MAPS:
            if name != "rotation" or other.turns:
                size = np.abs(getattr(other, name)).max()
                assert np.abs(getattr(one, name) - getattr(other, name)).max() <= digits * size, name
        assert one.turns == (other.turns or not other.displacement.any())


def test_round_trip(tmp_path: Path, text: str) -> None:
    compare(read_sid(tmp_path / "body.sid"), 1e-15)


@pytest.mark.parametrize("order", ORDERS)
def test_indices_in_any_order(tmp_path: Path, text: str, order: tuple[int, ...]) -> None:
    """Row, mode, column are written; other programs write row, column, mode, or the mode first."""

    def turned(match: re.Match) -> str:
        row, mode, column = match.groups()
        given = ["", "", ""]
        for place, index in zip(order, (row, column, mode), strict=True):
            given[place] = index
        return f"m1({', '.join(given)})"

    path = tmp_path / "other.sid_fem"
    path.write_text(re.sub(r"m1\( *(\d+), *(\d+), *(\d+)\)", turned, text))
    compare(read_sid(path), 1e-15)


def test_units_exponents_and_comments(tmp_path: Path, text: str) -> None:
    path = tmp_path / "body.sid"
    path.write_text(scaled_sid(text, 1e-3, 1e3).replace("e-", "D-") + "! the end\n")
    compare(read_sid(path, length=1e-3, mass=1e3), 1e-14)


def test_modes_of_another_size(tmp_path: Path, text: str) -> None:
    """A body of a tenth of the mass and stiffness: its M is not the unit matrix in the file, but is made so."""
    path = tmp_path / "light.sid"
    path.write_text(text)
    light = read_sid(path, mass=0.1)
    assert np.abs(light.M - np.eye(4)).max() < 1e-14
    assert light.frequencies == pytest.approx(BODY.frequencies, rel=1e-12)
    assert light.effective_mass == pytest.approx(0.1 * BODY.effective_mass, abs=1e-15)
    assert np.diag(light.D) == pytest.approx(np.diag(BODY.D), rel=1e-12)
    assert np.abs(light.interfaces[1].displacement) == pytest.approx(
        np.abs(BODY.interfaces[1].displacement) * np.sqrt(10)
    )


def test_matrices_are_those_of_the_equations(tmp_path: Path, text: str) -> None:
    """All of a SID that is not read, against integrals over point masses: gyroscopic terms, and J for a deformed body."""
    rng = np.random.default_rng(3)
    m, r, phi = rng.uniform(1, 2, 9), rng.normal(size=(9, 3)), rng.normal(size=(9, 3, 2))
    A, B = np.einsum("k,ki,kjb->bij", m, r, phi), np.einsum("k,kib,kjc->bcij", m, phi, phi)
    M = np.einsum("k,kib,kic->bc", m, phi, phi)
    body = ReducedBody(
        m.sum(),
        m @ r,
        np.einsum("k,ki,kj->ij", m, r, r),
        np.einsum("k,kib->ib", m, phi),
        A,
        B,
        M,
        np.eye(2),
        np.eye(2) * 0,
    )
    write_sid(body, tmp_path / "points.sid")
    modal = read_tree(tmp_path / "points.sid").parts[0].parts[0]
    given = {
        part.name: taylor(tmp_path / "points.sid", part, ORDERS[0]) for part in modal.parts if part.name[0] in "mJCGOM"
    }
    q, qd, w = rng.normal(size=2), rng.normal(size=2), rng.normal(size=3)
    now = {name: t.constant + np.einsum("bij,b->ij", t.linear, q) for name, t in given.items()}
    x, v = r + phi @ q, phi @ qd
    inertia = np.einsum("k,kij->ij", m, (x**2).sum(axis=1)[:, None, None] * np.eye(3) - x[:, :, None] * x[:, None])
    second = np.einsum("b,c,bcij->ij", q, q, np.trace(B, axis1=2, axis2=3)[:, :, None, None] * np.eye(3) - B)
    assert now["J"] + second == pytest.approx(inertia)  # a SID stops at first order
    coriolis = 2 * np.cross(w, v)
    products = np.array([w[0] ** 2, w[1] ** 2, w[2] ** 2, w[0] * w[1], w[1] * w[2], w[0] * w[2]])
    assert now["Gr"].reshape(3, 2, 3) @ w @ qd == pytest.approx(m @ np.cross(x, coriolis))
    assert now["Ge"].reshape(2, 2, 3) @ w @ qd == pytest.approx(np.einsum("k,kib,ki->b", m, phi, coriolis))
    assert now["Oe"] @ products == pytest.approx(np.einsum("k,kib,ki->b", m, phi, np.cross(w, np.cross(w, x))))
    assert now["Cr"].T @ qd == pytest.approx(m @ np.cross(x, v))
    assert now["Ct"].T @ qd == pytest.approx(m @ v)
    assert now["mdCM"][:, 0] == pytest.approx(m @ x)


def test_without_second_order(tmp_path: Path, text: str) -> None:
    lines, block = [], ""
    for line in text.splitlines():
        block = line.strip() if line.strip() in ("Cr", "Oe", "Me") else block
        if not (block in ("Cr", "Oe") and "m1(" in line):
            lines.append(line)
    path = tmp_path / "first.sid"
    path.write_text("\n".join(lines) + "\n")
    with pytest.warns(AcausalWarning, match=r"Oe has no M1. .* omitted, as with inertia="):
        found = read_sid(path)
    assert found.modal_second == pytest.approx(BODY.modal_second, rel=1e-12, abs=1e-18)
    assert np.abs(found.K - BODY.K).max() < 1e-9 * BODY.K.max()


@pytest.mark.parametrize("case", WRONG)
def test_wrong_files(tmp_path: Path, text: str, case: str) -> None:
    change, message = WRONG[case]
    path = tmp_path / "wrong.sid"
    path.write_text(change(text))
    with pytest.raises(DeclarationError, match=message):
        read_sid(path)


def test_axes_that_are_no_rotation(tmp_path: Path, text: str) -> None:
    path = tmp_path / "turned.sid"
    path.write_text(re.sub(r"(AP\n(?:.*\n){7}.*m0\( *1, *2\) =) .*", r"\1 0.5", text))
    with pytest.raises(DeclarationError, match=r"AP of node .* is not a rotation"):
        read_sid(path)
    assert index_order(path, []) == ORDERS[0]
