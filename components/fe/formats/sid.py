"""Reduced bodies as standard input data of a flexible body (SID), the text that several multibody programs exchange."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np

from acausal import AcausalWarning
from acausal.result.files import whole
from components.fe.formats.sid_tree import DIGITS, Block, Taylor, index_order, read_tree, taylor
from components.fe.formats.text import number, wrong
from components.fe.reduced_body import Interface, ReducedBody

# w1^2, w2^2, w3^2, w1 w2, w2 w3, w1 w3: the columns of Oe.
PRODUCTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
AXIAL = np.zeros((3, 3, 3))  # axial(A)_i = e_ijk A_jk
AXIAL[[0, 1, 2], [1, 2, 0], [2, 0, 1]] = 1.0
AXIAL[[0, 1, 2], [2, 0, 1], [1, 2, 0]] = -1.0


def read_sid(path: str | Path, *, length: float = 1.0, mass: float = 1.0) -> ReducedBody:
    """Return the body that a SID file holds (O. Wallrapp, Mech. Struct. Mach. 22 (1994) 283-304).

    A SID is reduced already: there are no nodes and no matrices of a mesh in it. Its nodes become interfaces, and its
    coordinates q new ones, for which M is the unit matrix, unless it is so in the file. Of what the file says more than
    once (J and Gr, Ge beside Ct, Cr, Me, Oe) the second group is used. Stresses and loads at nodes are passed over.

    The unit of time is the second. The coordinates q have the file's unit of length, so that mode shapes are numbers.

    Parameters
    ----------
    path : str or Path
        The file.
    length : float
        Unit of length of the file in m. Places are multiplied by it; with the unit of mass, mdCM and Ct, J, Cr and Oe.
    mass : float
        Unit of mass of the file in kg. Me, Ke and De are multiplied by it.

    Returns
    -------
    ReducedBody
        Inertia of second order needs M1 of Cr and Oe.

    Raises
    ------
    DeclarationError
        If the file is cut off or none of this kind, a matrix has another size, a node is turned against the reference
        frame, or Oe holds more than inertia (geometric stiffness due to spin).
    """
    modal = _inner(path, read_tree(path))
    total, n = _modes(path, modal)
    nodes = [node for frame in modal.named("frame") for node in frame.named("node")]
    for node in nodes:
        _parts(path, node, ("origin", "phi", "psi"))
    order = index_order(path, nodes)
    shapes = {"mdCM": (3, 1), "J": (3, 3), "Ct": (n, 3), "Cr": (n, 3), "Me": (n, n), "Oe": (n, 6), "Ke": (n, n)}
    _parts(path, modal, tuple(shapes))
    given = {name: _matrix(path, modal.named(name)[0], order, shape, n) for name, shape in shapes.items()}
    damping = modal.named("De")
    D = _matrix(path, damping[0], order, (n, n), n).constant if damping else np.zeros((n, n))
    M, K = given["Me"].constant, given["Ke"].constant
    unit = np.abs(M * mass - np.eye(n)).max(initial=0.0) <= DIGITS
    T = np.eye(n) if unit else _orthonormal(path, M, K) / np.sqrt(mass)
    A, B = _moments(path, given, M)
    J = given["J"].constant
    return ReducedBody(
        mass=mass * total,
        first_moment=mass * length * given["mdCM"].constant[:, 0],
        second_moment=mass * length**2 * (np.trace(J) / 2 * np.eye(3) - J),
        modal_first=mass * given["Ct"].constant.T @ T,
        modal_second=mass * length * np.einsum("bij,bc->cij", A, T),
        modal_products=mass * np.einsum("bcij,bd,ce->deij", B, T, T, optimize=True),
        M=mass * T.T @ M @ T,
        K=mass * T.T @ K @ T,
        D=mass * T.T @ D @ T,
        interfaces=tuple(_interface(path, node, order, n, T, length) for node in nodes),
    )


def write_sid(body: ReducedBody, path: str | Path) -> None:
    """Write a body as a SID file, whole or not at all: SI, 17 digits, inertia of second order (M1 of Cr, Gr, Ge, Oe).

    Parameters
    ----------
    body : ReducedBody
        Frames without all rotations get no psi.
    path : str or Path
        File; one that exists is replaced when the new one is complete.
    """
    n, A, B = body.n, body.modal_second, body.modal_products
    none = np.zeros((n, 3, n))
    turning = np.einsum("ijk,bjk->bi", AXIAL, A), np.einsum("ijk,cbjk->cbi", AXIAL, B)
    P = body.second_moment
    trace = np.trace(A, axis1=1, axis2=2)[:, None, None] * np.eye(3)
    # -2 times the integrals of r~ phi_b~ = phi_b r' - (r.phi_b) E
    gyration = -2 * (A.swapaxes(1, 2) - trace)
    products = -2 * (B - np.trace(B, axis1=2, axis2=3)[:, :, None, None] * np.eye(3))
    matrices = {
        "mdCM": Taylor(body.first_moment[:, None], body.modal_first.T[:, :, None]),
        "J": Taylor(np.trace(P) * np.eye(3) - P, 2 * trace - A - A.swapaxes(1, 2)),
        "Ct": Taylor(body.modal_first.T, np.zeros((n, n, 3))),
        "Cr": Taylor(*turning),
        "Me": Taylor(body.M, np.zeros((n, n, n))),
        "Gr": Taylor(
            gyration.transpose(1, 0, 2).reshape(3, 3 * n), products.transpose(1, 2, 0, 3).reshape(n, 3, 3 * n)
        ),
        "Ge": Taylor(2 * turning[1].transpose(1, 0, 2).reshape(n, 3 * n), np.zeros((n, n, 3 * n))),
        "Oe": Taylor(_centrifugal(A), _centrifugal(B)),
        "ksigma": Taylor(np.zeros((n, 1)), np.zeros((n, n, 1))),
        "Ke": Taylor(body.K, np.zeros((n, n, n))),
        "De": Taylor(body.D, np.zeros((n, n, n))),
    }
    lines = ["part", "   new modal", "      refmod", f"         mass         = {body.mass:.17g}"]
    lines += [f"         nelastq      = {n}"]
    lines += [f"         ielastq({b + 1:4d}) = mode {b + 1}" for b in range(n)]
    lines += ["      end refmod", "      frame"]
    for frame in body.interfaces:
        psi = frame.rotation if frame.turns else np.zeros((3, n))
        lines += [f"         new node = {frame.name}", "            rframe       = body ref"]
        lines += Taylor(frame.place[:, None], frame.displacement.T[:, :, None]).lines("origin", " " * 12)
        lines += Taylor(frame.displacement, none).lines("phi", " " * 12)
        lines += Taylor(psi, none).lines("psi", " " * 12)
        lines += Taylor(np.eye(3), -np.einsum("ijk,kb->bij", AXIAL, psi)).lines("AP", " " * 12)
        lines += ["         end node"]
    lines += ["      end frame"]
    for name, matrix in matrices.items():
        lines += matrix.lines(name, " " * 6)
    with whole(path) as file:
        file.write("\n".join([*lines, "   end modal", "end part", ""]))


def _inner(path: str | Path, tree: Block) -> Block:
    parts = tree.named("part")
    modals = [modal for part in parts for modal in part.named("modal")]
    if len(modals) != 1:
        raise wrong(path, f"a SID holds one `new modal` inside of `part`, and this file {len(modals)}")
    return modals[0]


def _modes(path: str | Path, modal: Block) -> tuple[float, int]:
    """Mass and number of modes."""
    _parts(path, modal, ("refmod",))
    head = modal.named("refmod")[0]
    try:
        total, n = (number(head.settings[name][1]) for name in ("mass", "nelastq"))
    except (KeyError, ValueError):
        raise wrong(path, "refmod needs mass and nelastq, which are numbers", head.line) from None
    if not (total > 0 and 0 <= n == int(n)):
        raise wrong(path, f"a body has mass and a number of modes, not mass {total:g} and nelastq {n:g}", head.line)
    return total, int(n)


def _parts(path: str | Path, block: Block, names: tuple[str, ...]) -> None:
    for name in names:
        if len(block.named(name)) != 1:
            where = f"{block.name} {block.value}".strip()
            raise wrong(path, f"`{where}` has {len(block.named(name))} blocks `{name}` instead of one", block.line)


def _matrix(path: str | Path, block: Block, order: tuple[int, ...], shape: tuple[int, int], n: int) -> Taylor:
    found = taylor(path, block, order)
    if found.constant.shape != shape:
        size, needed = ("{} x {}".format(*pair) for pair in (found.constant.shape, shape))
        raise wrong(path, f"`{block.name}` is {size}, where {n} modes need {needed}", block.line)
    if len(found.linear) != n:  # without modes of its own
        return Taylor(found.constant, np.zeros((n, *shape)))
    return found


def _moments(path: str | Path, given: dict[str, Taylor], M: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A_b and B_bc, from how modes turn the body (Cr) and how its spin bends it (Oe)."""
    turn, spin = given["Cr"], given["Oe"]
    A = _from_parts(spin.constant, turn.constant)
    if given["J"].linear.any():
        expected = 2 * np.trace(A, axis1=1, axis2=2)[:, None, None] * np.eye(3) - A - A.swapaxes(1, 2)
        _same(path, expected, given["J"].linear, "M1 of J and M0 of Oe say different things about the modes")
    if not (spin.linear.any() and turn.linear.any()):
        text = f"{path}: Cr and Oe have no M1, so forces of inertia of second order in q are not known"
        warnings.warn(AcausalWarning(f'{text}: take inertia="first_order".'), stacklevel=4)
        return A, np.einsum("bc,ij->bcij", M, np.eye(3) / 3)
    B = _from_parts(spin.linear, turn.linear)
    why = "the trace of M1 of Oe differs from Me: Oe seems to hold geometric stiffness, which is not read"
    _same(path, np.trace(B, axis1=2, axis2=3), M, why)
    return A, B


def _from_parts(spin: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """The moments (..., 3, 3) of which `_centrifugal` and the axial vector are given."""
    trace = -spin[..., :3].sum(axis=-1) / 2
    moments = np.einsum("ijk,...i->...jk", AXIAL, turn) / 2
    for place, (i, j) in enumerate(PRODUCTS):
        part = spin[..., place] + (trace if i == j else 0.0)
        moments[..., i, j] += part / 2
        moments[..., j, i] += part / 2
    return moments


def _centrifugal(moments: np.ndarray) -> np.ndarray:
    """W : A for the products of w in the order of `PRODUCTS`, shape (..., 6)."""
    trace = np.trace(moments, axis1=-2, axis2=-1)
    columns = [moments[..., i, j] - trace if i == j else moments[..., i, j] + moments[..., j, i] for i, j in PRODUCTS]
    return np.stack(columns, axis=-1)


def _orthonormal(path: str | Path, M: np.ndarray, K: np.ndarray) -> np.ndarray:
    from scipy.linalg import eigh

    try:
        return eigh(K, M)[1]
    except np.linalg.LinAlgError:
        raise wrong(path, "Me is not positive definite") from None


def _same(path: str | Path, one: np.ndarray, other: np.ndarray, why: str) -> None:
    size = max(np.abs(one).max(initial=0.0), np.abs(other).max(initial=0.0))
    if np.abs(one - other).max(initial=0.0) > DIGITS * size:
        raise wrong(path, why)


def _interface(
    path: str | Path, node: Block, order: tuple[int, ...], n: int, T: np.ndarray, length: float
) -> Interface:
    place = _matrix(path, node.named("origin")[0], order, (3, 1), n).constant[:, 0]
    phi, psi = (_matrix(path, node.named(name)[0], order, (3, n), n).constant for name in ("phi", "psi"))
    for axes in node.named("AP"):
        if np.abs(_matrix(path, axes, order, (3, 3), n).constant - np.eye(3)).max() > DIGITS:
            raise wrong(path, f"node {node.value} is turned against the reference frame, which is not read", axes.line)
    name = node.value if node.value.isidentifier() else f"node_{node.value}"
    turns = bool(psi.any() or not phi.any())
    return Interface(name=name, place=length * place, displacement=phi @ T, rotation=psi @ T / length, turns=turns)
