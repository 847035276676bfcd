"""Equations of a model as tapes, as the core integrates them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from acausal.core.tape import Tape, make_tape
from acausal.instructions import READABLE
from acausal.symbols import dense


@dataclass(frozen=True, eq=False)
class Equations:
    """Equations x' = f, 0 = g of states and algebraic unknowns, and what is integrated besides, as tapes.

    Attributes
    ----------
    nx, nz, np, nc : int
        Numbers of states, algebraic unknowns, parameters and constants of a segment.
    values, slopes, powers, kinks : Tape
        f and g; entries of their Jacobian, and their derivatives by time where they depend on it; at most two powers; next
        times, after the time, at which f and g have kinks.
    start, row, diagonal : arrays of int
        Sparsity of the Jacobian in columns, and the places in it of the diagonal of the states.
    """

    nx: int
    nz: int
    np: int
    nc: int
    values: Tape
    slopes: Tape
    powers: Tape | None
    kinks: Tape | None
    start: np.ndarray
    row: np.ndarray
    diagonal: np.ndarray


def make_equations(
    x: ca.SX, z: ca.SX, t: ca.SX, p: ca.SX, c: ca.SX, ode: ca.SX, alg: ca.SX, kinks: ca.SX | None = None
) -> Equations:
    """Return equations as tapes.

    Parameters
    ----------
    x, z, t, p, c : casadi.SX
        States, algebraic unknowns, time, parameters and constants of a segment.
    ode, alg : casadi.SX
        Derivatives of the states, and residuals.
    kinks : casadi.SX, optional
        Next times, after t, at which they have kinks.
    """
    nx, nz = x.numel(), z.numel()
    y, F = ca.vertcat(x, z), ca.vertcat(dense(ode), dense(alg))
    J = ca.jacobian(F, y)
    own = ca.Sparsity.triplet(nx + nz, nx + nz, list(range(nx)), list(range(nx)))
    pattern = J.sparsity() + own
    entries = ca.project(J, pattern).nz[:]
    by_time = ca.jacobian(F, t)
    slopes = ca.vertcat(entries, dense(by_time)) if by_time.nnz() else entries
    arguments = [x, z, t, p, c]

    start, row = (np.array(part, dtype=np.int32) for part in (pattern.colind(), pattern.row()))
    diagonal = np.array([pattern.get_nz(k, k) for k in range(nx)], dtype=np.int32)
    return Equations(
        *(nx, nz, p.numel(), c.numel()),
        *(_tape("values", arguments, F), _tape("slopes", arguments, slopes), None),
        None if kinks is None or not kinks.numel() else _tape("kinks", arguments, kinks),
        *(start, row, diagonal),
    )


def _tape(name: str, arguments: Sequence[ca.SX], column: ca.SX) -> Tape:
    return make_tape(ca.Function(name, list(arguments), [dense(column)], READABLE), early=(3, 4))
