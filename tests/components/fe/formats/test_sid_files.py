"""Forms of SID files that other programs write: a packed J, headlines, few modes, and an Oe that is not inertia alone."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import casadi as ca
import numpy as np
import pytest

from acausal import AcausalWarning, Expr, as_expr
from components.fe import ReducedBody, box, read_sid, reduce_body, write_sid
from components.fe.body.modal_inertia import ModalInertia

STEEL = {"E": 2.1e11, "nu": 0.3, "rho": 7850.0}
BODY = reduce_body(
    *box((0.1, 0.02, 0.03), (3, 1, 1), "hex8", **STEEL),
    frames={"root": [0, 1, 2, 3], "tip": [12, 13, 14, 15]},
    hold="root",
    modes=4,
)
SIX = {(1, 1): 1, (2, 2): 2, (3, 3): 3, (1, 2): 4, (1, 3): 5, (2, 3): 6}


def lines_of(text: str, name: str) -> tuple[int, int]:
    """Where the block of a matrix of the body begins and ends."""
    found = re.search(rf"(?ms)^ {{6}}{name}$.*?end {name}$", text)
    assert found
    return found.span()


def changed(text: str, name: str, change: Callable[[str], str]) -> str:
    begin, end = lines_of(text, name)
    return text[:begin] + change(text[begin:end]) + text[end:]


def packed(block: str) -> str:
    """J as 6 x 1: 11, 22, 33, 12, 13, 23."""
    lines = []
    for line in block.splitlines():
        entry = re.fullmatch(r" *m([01])\(([\d, ]+)\) = (.*)", line)
        if entry:
            i, *mode, j = (int(word) for word in entry[2].split(","))
            if (i, j) in SIX:
                lines.append(f"m{entry[1]}({SIX[i, j]},{''.join(f'{b},' for b in mode)} 1) = {entry[3]}")
        else:
            lines.append(line.replace("nrow         = 3", "nrow = 6").replace("ncol         = 3", "ncol = 1"))
    return "\n".join(lines)


def read(tmp_path: Path, text: str) -> ReducedBody:
    (tmp_path / "a.sid").write_text(text)
    return read_sid(tmp_path / "a.sid")


@pytest.fixture
def text(tmp_path: Path) -> str:
    write_sid(BODY, tmp_path / "body.sid")
    return (tmp_path / "body.sid").read_text()


def alike(one: ReducedBody, other: ReducedBody) -> None:
    for name in ("second_moment", "modal_first", "modal_second", "modal_products", "M", "K"):
        a, b = getattr(one, name), getattr(other, name)
        assert np.abs(a - b).max() <= 1e-14 * np.abs(b).max(), name


@pytest.mark.parametrize(
    "head", ["", "  3   4  : No. nodes, No. modes: a rod\n", "a rod\nof = steel, end\n! see part 2\n"]
)
@pytest.mark.parametrize("change", [str, packed])
def test_packed_inertia_and_headlines(tmp_path: Path, text: str, head: str, change: Callable[[str], str]) -> None:
    alike(read(tmp_path, head + changed(text, "J", change)), BODY)


@pytest.mark.parametrize("modes", [1, 2, 3])
@pytest.mark.parametrize("first", [0, 1])
def test_few_modes(tmp_path: Path, modes: int, first: int) -> None:
    """One mode turns no other one, so that M1 of Cr is 0 by nature; Oe is read all the same."""
    some = slice(first, first + modes)
    body = ReducedBody(
        mass=BODY.mass,
        first_moment=BODY.first_moment,
        second_moment=BODY.second_moment,
        modal_first=BODY.modal_first[:, some],
        modal_second=BODY.modal_second[some],
        modal_products=BODY.modal_products[some, some],
        **{name: getattr(BODY, name)[some, some] for name in "MKD"},
    )
    write_sid(body, tmp_path / "a.sid")
    found = read_sid(tmp_path / "a.sid")
    alike(found, body)
    assert found.second_order


def test_modes_in_one_direction(tmp_path: Path) -> None:
    """Points that move along z alone: no mode turns another one."""
    rng = np.random.default_rng(5)
    m, r, shapes = rng.uniform(1, 2, 9), rng.normal(size=(9, 3)), rng.normal(size=(9, 2))
    phi = shapes[:, None, :] * np.array([0, 0, 1.0])[:, None]
    B = np.einsum("k,kib,kjc->bcij", m, phi, phi)
    M = np.trace(B, axis1=2, axis2=3)
    P, A = np.einsum("k,ki,kj->ij", m, r, r), np.einsum("k,ki,kjb->bij", m, r, phi)
    body = ReducedBody(m.sum(), m @ r, P, np.einsum("k,kib->ib", m, phi), A, B, M, M * 100, M * 0)
    write_sid(body, tmp_path / "a.sid")
    found = read_sid(tmp_path / "a.sid")
    assert found.second_order
    assert np.trace(found.modal_products, axis1=2, axis2=3) == pytest.approx(np.eye(2), abs=1e-12)
    assert np.abs(found.modal_products[..., :2, :]).max() < 1e-14


def test_turning_from_ge(tmp_path: Path, text: str) -> None:
    """Ge says again what M1 of Cr says."""
    bare = changed(text, "Cr", lambda block: re.sub(r"\n *m1\(.*", "", block))
    alike(read(tmp_path, bare), BODY)


def kinetic(body: ReducedBody, order: str) -> float:
    rng = np.random.default_rng(2)
    values = [1e-2 * rng.normal(size=body.n), rng.normal(size=body.n), rng.normal(size=3), rng.normal(size=3)]
    symbols = [ca.SX.sym(f"s{k}", value.size) for k, value in enumerate(values)]
    q, qd, v, w = (Expr(symbol, shape=(symbol.numel(),)) for symbol in symbols)
    energy = as_expr(ModalInertia(body, q, qd, qd, order).kinetic_energy(v, w))
    return float(ca.Function("energy", symbols, [energy.sx])(*values))


def stiffened(block: str) -> str:
    """M1 of Oe with a part that grows with the square of the spin, as geometric stiffness does."""
    return re.sub(r"(m1\( *1, *1, *[12]\)) = (\S+)", lambda m: f"{m[1]} = {float(m[2]) - 3:.17g}", block)


DOUBTS = {
    "geometric stiffness": ("Oe", stiffened, "Oe seems to include geometric stiffness"),
    "no M1": ("Oe", lambda block: re.sub(r"\n *m1\(.*", "", block), "Oe has no M1"),
    "another M0": ("Oe", lambda block: re.sub(r"(m0\( *2, *1\)) = .*", r"\1 = 77", block), "M0 of Oe and M1 of J are"),
}


@pytest.mark.parametrize("case", DOUBTS)
def test_oe_that_disagrees(tmp_path: Path, text: str, case: str) -> None:
    """A warning, and inertia of first order: the same kinetic energy as that of the body itself of first order."""
    name, change, message = DOUBTS[case]
    with pytest.warns(AcausalWarning, match=f"a.sid: .*{message}.* omitted, as with inertia=.first_order") as caught:
        found = read(tmp_path, changed(text, name, change))
    assert caught[0].filename == __file__
    assert not found.second_order
    assert np.abs(found.modal_second - BODY.modal_second).max() < 1e-14 * np.abs(BODY.modal_second).max()
    first = kinetic(BODY, "first_order")
    assert kinetic(found, "second_order") == pytest.approx(first, rel=1e-13)
    assert abs(kinetic(BODY, "second_order") - first) > 1e-9 * first
    write_sid(found, tmp_path / "again.sid")
    with pytest.warns(AcausalWarning, match="Oe has no M1"):
        alike(read_sid(tmp_path / "again.sid"), found)
