"""Reduced bodies as standard input data of a flexible body (SID), a text format for exchange of multibody programs."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from acausal.result.files import whole
from components.fe.formats.sid_tree import DIGITS, Block, Taylor, index_order, read_tree, taylor
from components.fe.formats.text import file_error, file_warning, number
from components.fe.reduction.interface import Interface
from components.fe.reduction.reduced_body import ReducedBody

# w1^2, w2^2, w3^2, w1 w2, w2 w3, w1 w3: the columns of Oe.
PRODUCTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
PACKED = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])  # indices in 11, 22, 33, 12, 13, 23
AXIAL = np.zeros((3, 3, 3))  # axial(A)_i = e_ijk A_jk
AXIAL[[0, 1, 2], [1, 2, 0], [2, 0, 1]] = 1.0
AXIAL[[0, 1, 2], [2, 0, 1], [1, 2, 0]] = -1.0


def read_sid(path: str | Path, *, length: float = 1.0, mass: float = 1.0) -> ReducedBody:
    """Read the reduced body of a SID file (O. Wallrapp, Mech. Struct. Mach. 22 (1994) 283-304).

    A SID is a reduced body, without the nodes and matrices of a mesh. Its nodes become interfaces. Its coordinates q
    are transformed to make M the unit matrix. Of redundant data (J, Gr, Ge and Ct, Cr, Me, Oe) the second group is
    used. The inertia of second order in q is unknown if Oe has no M1, or includes geometric stiffness due to spin: a
    warning says so, and the body has inertia of first order. Stresses and loads at nodes are ignored, as are lines
    above `part`.

    The unit of time must be the second. The coordinates q have the unit of length of the file, so that mode shapes are
    dimensionless.

    Parameters
    ----------
    path : str or Path
        The file.
    length : float
        Unit of length of the file in m. Scales positions and, with the unit of mass, mdCM, Ct, J, Cr and Oe.
    mass : float
        Unit of mass of the file in kg. Scales Me, Ke and De.

    Returns
    -------
    ReducedBody
        Its `second_order` tells whether the inertia is of second order.

    Raises
    ------
    DeclarationError
        If the file is truncated or not a SID, or a matrix has a wrong size.
    """
    modal = _inner(path, read_tree(path))
    total, n = _modes(path, modal)
    nodes = [node for frame in modal.named("frame") for node in frame.named("node")]
    for node in nodes:
        _parts(path, node, ("origin", "phi", "psi"))
    order = index_order(path, nodes)
    shapes = {"mdCM": (3, 1), "Ct": (n, 3), "Cr": (n, 3), "Me": (n, n), "Oe": (n, 6), "Ke": (n, n)}
    _parts(path, modal, (*shapes, "J"))
    given = {name: _matrix(path, modal.named(name)[0], order, shape, n) for name, shape in shapes.items()}
    given["J"] = _inertia(path, modal.named("J")[0], order, n)
    if found := modal.named("Ge"):
        given["Ge"] = taylor(path, found[0], order)
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
    """Write a body as a SID file in SI with 17 digits and inertia of second order (M1 of Cr, Gr, Ge, Oe).

    Parameters
    ----------
    body : ReducedBody
        Frames without all rotations get psi = 0.
    path : str or Path
        File. An existing file is replaced only when the new one is complete.
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
        lines += Taylor(frame.axes.T, _skew(psi) @ frame.axes.T).lines("AP", " " * 12)
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
        raise file_error(path, f"a SID needs one `new modal` inside `part`, but this file has {len(modals)}")
    return modals[0]


def _modes(path: str | Path, modal: Block) -> tuple[float, int]:
    """Return the mass and the number of modes."""
    _parts(path, modal, ("refmod",))
    head = modal.named("refmod")[0]
    try:
        total, n = (number(head.settings[name][1]) for name in ("mass", "nelastq"))
    except (KeyError, ValueError):
        raise file_error(path, "refmod needs the numbers mass and nelastq", head.line) from None
    if not (total > 0 and 0 <= n == int(n)):
        raise file_error(
            path, f"mass must be positive and nelastq an integer from 0, not {total:g} and {n:g}", head.line
        )
    return total, int(n)


def _parts(path: str | Path, block: Block, names: tuple[str, ...]) -> None:
    for name in names:
        if len(block.named(name)) != 1:
            where = f"{block.name} {block.value}".strip()
            raise file_error(path, f"`{where}` has {len(block.named(name))} blocks `{name}` instead of one", block.line)


def _matrix(path: str | Path, block: Block, order: tuple[int, ...], shape: tuple[int, int], n: int) -> Taylor:
    found = taylor(path, block, order)
    if found.constant.shape != shape:
        size, needed = ("{} x {}".format(*pair) for pair in (found.constant.shape, shape))
        raise file_error(path, f"`{block.name}` is {size}, but {n} modes need {needed}", block.line)
    if len(found.linear) != n:  # a constant matrix, nq = 0
        return Taylor(found.constant, np.zeros((n, *shape)))
    return found


def _inertia(path: str | Path, block: Block, order: tuple[int, ...], n: int) -> Taylor:
    """Return J, which the file has as 3 x 3 or as 6 x 1: 11, 22, 33, 12, 13, 23."""
    if taylor(path, block, order).constant.shape != (6, 1):
        return _matrix(path, block, order, (3, 3), n)
    packed = _matrix(path, block, order, (6, 1), n)
    return Taylor(packed.constant[PACKED, 0], packed.linear[:, PACKED, 0])


def _moments(path: str | Path, given: dict[str, Taylor], M: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the modal moments A_b and B_bc from Cr (antisymmetric parts) and Oe (symmetric parts).

    If Oe is incomplete or inconsistent, A_b takes its symmetric part from J, and that of B_bc is zero.
    """
    J, spin, turn, n = given["J"].linear, given["Oe"], given["Cr"], len(M)
    turned = turn.linear
    if not turned.any() and "Ge" in given and given["Ge"].constant.shape == (n, 3 * n):
        twice = given["Ge"].constant.reshape(n, n, 3).swapaxes(0, 1)
        turned = twice / 2 if _same(twice, -twice.swapaxes(0, 1)) else turned
    A, B = _from_parts(spin.constant, turn.constant), _from_parts(spin.linear, turned)
    why = "" if spin.linear.any() or not n else "Oe has no M1"
    if J.any() and not _same(2 * np.trace(A, axis1=1, axis2=2)[:, None, None] * np.eye(3) - A - A.swapaxes(1, 2), J):
        why = "M0 of Oe and M1 of J are inconsistent"
        symmetric = np.trace(J, axis1=1, axis2=2)[:, None, None] / 4 * np.eye(3) - J / 2
        A = symmetric + (A - A.swapaxes(1, 2)) / 2
    elif not why and not _same(np.trace(B, axis1=2, axis2=3), M):
        why = "the trace of M1 of Oe differs from Me; Oe seems to include geometric stiffness, which is not supported"
    if why:
        file_warning(
            path,
            f'{why}. Inertia forces of second order in q are unknown and omitted, as with inertia="first_order"',
        )
        B = (B - B.swapaxes(2, 3)) / 2
    return A, B


def _from_parts(spin: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """Return the moments (..., 3, 3) with these `_centrifugal` parts and axial vectors."""
    trace = -spin[..., :3].sum(axis=-1) / 2
    moments = np.einsum("ijk,...i->...jk", AXIAL, turn) / 2
    for place, (i, j) in enumerate(PRODUCTS):
        part = spin[..., place] + (trace if i == j else 0.0)
        moments[..., i, j] += part / 2
        moments[..., j, i] += part / 2
    return moments


def _centrifugal(moments: np.ndarray) -> np.ndarray:
    """Return W : A for the products of w in the order of `PRODUCTS`, shape (..., 6)."""
    trace = np.trace(moments, axis1=-2, axis2=-1)
    columns = [moments[..., i, j] - trace if i == j else moments[..., i, j] + moments[..., j, i] for i, j in PRODUCTS]
    return np.stack(columns, axis=-1)


def _orthonormal(path: str | Path, M: np.ndarray, K: np.ndarray) -> np.ndarray:
    from scipy.linalg import eigh

    try:
        return eigh(K, M)[1]
    except np.linalg.LinAlgError:
        raise file_error(path, "Me is not positive definite") from None


def _same(one: np.ndarray, other: np.ndarray) -> bool:
    size = max(np.abs(one).max(initial=0.0), np.abs(other).max(initial=0.0))
    return bool(np.abs(one - other).max(initial=0.0) <= DIGITS * size)


def _interface(
    path: str | Path, node: Block, order: tuple[int, ...], n: int, T: np.ndarray, length: float
) -> Interface:
    place = _matrix(path, node.named("origin")[0], order, (3, 1), n).constant[:, 0]
    phi, psi = (_matrix(path, node.named(name)[0], order, (3, n), n).constant for name in ("phi", "psi"))
    axes = np.eye(3)
    for block in node.named("AP"):
        turn = _matrix(path, block, order, (3, 3), n)
        if not _same(turn.constant, np.eye(3)):
            axes = turn.constant.T
            if not _same(axes @ turn.constant, np.eye(3)) or np.linalg.det(axes) < 0:
                raise file_error(path, f"AP of node {node.value} is not a rotation", block.line)
            if turn.linear.any() and not _same(_skew(psi) @ turn.constant, turn.linear):
                raise file_error(
                    path, f"M1 of AP of node {node.value} is not psi x AP; psi is in other axes", block.line
                )
    name = node.value if node.value.isidentifier() else f"node_{node.value}"
    turns = bool(psi.any() or not phi.any())
    return Interface(name, length * place, phi @ T, psi @ T / length, turns, axes)


def _skew(turns: np.ndarray) -> np.ndarray:
    """Return the matrices of v x for the columns v, shape (n, 3, 3)."""
    return -np.einsum("ijk,kb->bij", AXIAL, turns)
