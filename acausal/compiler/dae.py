"""The DAE for CasADi's integrators: in scaled time, optionally in scaled states."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.language.functions import time
from acausal.reduce import ReducedModel

# Scale of algebraic unknowns for integrators that cannot exclude them from the error test: it makes them negligible there.
UNSEEN = 1e10


def make_dae(
    reduced: ReducedModel, hoisted: tuple[ca.SX, ca.SX, ca.SX], quadratures: bool, moves: bool
) -> dict[str, ca.SX]:
    """Return the equations in scaled time s, t = t0 + s T.

    The parameters are t0, T, the hoisted expressions of parameters, and the constants.

    Parameters
    ----------
    reduced : ReducedModel
        The model.
    hoisted : tuple of casadi.SX
        Derivatives of the states, residuals and powers in one column; the hoisted symbols; their expressions.
    quadratures : bool
        Whether to integrate the powers.
    moves : bool
        Whether the projection of closed loops moves.
    """
    (column, values, _), nx, nz = hoisted, reduced.x.numel(), reduced.z.numel()
    column = ca.substitute(column, reduced.projections.moves, moves)
    s, t0, T = ca.SX.sym("s"), ca.SX.sym("t0"), ca.SX.sym("T")
    column = ca.substitute(column, time.sx, t0 + s * T)
    ode, alg, powers = ca.vertsplit(column, [0, nx, nx + nz, column.numel()])
    p = ca.vertcat(t0, T, values, reduced.constants)
    dae = {"x": reduced.x, "z": reduced.z, "p": p, "t": s, "ode": T * ode, "alg": alg}
    return {**dae, "quad": T * powers} if quadratures else dae


def in_sizes(dae: dict[str, ca.SX], nominal: np.ndarray) -> dict[str, ca.SX]:
    """Scale a DAE: states by their sizes, which become parameters, algebraic unknowns by large nominal values."""
    x, z, size = ca.SX.sym("x", dae["x"].numel()), ca.SX.sym("z", dae["z"].numel()), ca.SX.sym("size", dae["x"].numel())
    keys = [k for k in ("ode", "alg", "quad") if k in dae]
    written = ca.substitute([dae[k] for k in keys], [dae["x"], dae["z"]], [size * x, UNSEEN * ca.DM(nominal) * z])
    scaled = {**dae, **dict(zip(keys, written, strict=True)), "x": x, "z": z, "p": ca.vertcat(dae["p"], size)}
    return {**scaled, "ode": scaled["ode"] / size}
