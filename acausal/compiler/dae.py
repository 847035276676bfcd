"""The DAE as an integrator takes it: in scaled time, and in states over their sizes."""

from __future__ import annotations

import casadi as ca

from acausal.language.functions import time
from acausal.reduce import ReducedModel

# Size of algebraic unknowns in the error test of a method that cannot leave them out.
UNSEEN = 1e10


def make_dae(
    reduced: ReducedModel, hoisted: tuple[ca.SX, ca.SX, ca.SX], quadratures: bool, moves: bool
) -> dict[str, ca.SX]:
    """Write the equations in s, where time is t0 + s T; t0, T, what follows from parameters and constants are parameters.

    Parameters
    ----------
    reduced : ReducedModel
        The model.
    hoisted : tuple of casadi.SX
        Derivatives of the states, residuals and powers in one column; what of it follows from parameters alone.
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


def in_sizes(dae: dict[str, ca.SX]) -> dict[str, ca.SX]:
    """Write a DAE in states over their sizes, which become parameters, and algebraic unknowns over a large number."""
    x, z, size = ca.SX.sym("x", dae["x"].numel()), ca.SX.sym("z", dae["z"].numel()), ca.SX.sym("size", dae["x"].numel())
    keys = [k for k in ("ode", "alg", "quad") if k in dae]
    written = ca.substitute([dae[k] for k in keys], [dae["x"], dae["z"]], [size * x, UNSEEN * z])
    scaled = {**dae, **dict(zip(keys, written, strict=True)), "x": x, "z": z, "p": ca.vertcat(dae["p"], size)}
    return {**scaled, "ode": scaled["ode"] / size}
