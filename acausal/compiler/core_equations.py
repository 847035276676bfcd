"""The equations of a model as tapes of the core."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
import numpy as np

from acausal.compiler.compiled_model import CompiledModel
from acausal.compiler.memo import memoized
from acausal.core import Equations, Square, Tape, laws_of, make_equations, make_square, make_tape
from acausal.instructions import READABLE
from acausal.language.functions import time
from acausal.symbols import dense


@memoized
def core_equations(compiled: CompiledModel, moves: bool) -> Equations:
    """Return the integrated equations as tapes.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    moves : bool
        Whether the projection of closed loops moves.
    """
    r = compiled.reduced
    arguments = (r.x, r.z, time.sx, r.p, r.constants)
    ode, alg = (ca.substitute(column, r.projections.moves, moves) for column in (r.running.ode, r.running.alg))
    return make_equations(*arguments, ode, alg, r.kinks)


@memoized
def laws_of_time(compiled: CompiledModel, moves: bool) -> Tape | None:
    """Return the subexpressions of the equations that depend on time, p and constants alone; None if there are none.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    moves : bool
        Whether the projection of closed loops moves.
    """
    return laws_of(core_equations(compiled, moves).values, 2, (3, 4))


@memoized
def core_square(compiled: CompiledModel, wanted: tuple[int, ...]) -> Square:
    """Return the square system, of p, constants, x, z and time, of algebraic unknowns and all on which they depend.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    wanted : tuple of int
        Algebraic unknowns.
    """
    r, (unknowns, equations) = compiled.reduced, compiled.dependence.needed(wanted)
    return make_square([r.p, r.constants, r.x, r.z, time.sx], 2, r.running.alg[equations.tolist()], 3, unknowns)


@memoized
def core_motion(compiled: CompiledModel) -> tuple[Square | None, Tape]:
    """Return the watched excesses and their rates, of p, constants, x, z, time and the rates of some algebraic unknowns.

    Returns
    -------
    square : Square or None
        The equations of these rates; None if there are no such unknowns.
    tape : Tape
        Watched excesses, then their rates.
    """
    r = compiled.reduced
    return make_motion([r.p, r.constants, r.x, r.z, time.sx], compiled.guards.motion)


def make_motion(arguments: list[ca.SX], parts: Sequence[ca.SX]) -> tuple[Square | None, Tape]:
    """Return excesses and their rates as `core_motion` does.

    Parameters
    ----------
    arguments : list of casadi.SX
        Parameters, constants, states, algebraic unknowns and time.
    parts : sequence of casadi.SX
        As of `EventConditions.motion_of`.
    """
    excess, direct, by_z, inner, follows = parts
    rates = ca.SX.sym("rates", by_z.shape[1])
    arguments = [*arguments, rates]
    column = dense(ca.vertcat(excess, direct + by_z @ rates)) if excess.numel() else ca.SX(0, 1)
    tape = make_tape(ca.Function("watched", arguments, [column], READABLE), early=(0, 1))
    if not rates.numel():
        return None, tape
    return make_square(arguments, 2, inner @ rates + follows, 5, np.arange(rates.numel())), tape
