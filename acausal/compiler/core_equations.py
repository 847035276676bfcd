"""The equations of a model as tapes of the core."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.compiler.compiled_model import CompiledModel
from acausal.compiler.memo import memoized
from acausal.compiler.set_valued_laws import MODE
from acausal.core import Equations, Sampled, Square, Tape, laws_of, make_equations, make_square, make_tape, with_powers
from acausal.instructions import READABLE
from acausal.language.functions import time


@memoized
def core_equations(compiled: CompiledModel, works: bool, moves: bool) -> Equations:
    """Return the integrated equations as tapes.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    works : bool
        Whether to integrate the powers.
    moves : bool
        Whether the projection of closed loops moves.
    """
    r = compiled.reduced
    arguments = (r.x, r.z, time.sx, r.p, r.constants)
    if works:
        powers = ca.substitute(compiled.powers, r.projections.moves, moves)
        return with_powers(core_equations(compiled, False, moves), arguments, powers)
    ode, alg = (ca.substitute(column, r.projections.moves, moves) for column in (r.running.ode, r.running.alg))
    return make_equations(*arguments, ode, alg)


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
    return laws_of(core_equations(compiled, False, moves).values, 2, (3, 4))


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
    r, (excess, direct, by_z, inner, follows) = compiled.reduced, compiled.guards.motion
    rates = ca.SX.sym("rates", by_z.shape[1])
    arguments = r.p, r.constants, r.x, r.z, time.sx, rates
    column = ca.vertcat(excess, direct + by_z @ rates)
    tape = make_tape(ca.Function("watched", list(arguments), [ca.densify(column)], READABLE), early=(0, 1))
    if not rates.numel():
        return None, tape
    return make_square(arguments, 2, inner @ rates + follows, 5, np.arange(rates.numel())), tape


@memoized
def core_sampled(compiled: CompiledModel, works: bool, moves: bool) -> Sampled | None:
    """Return the model for the fast loop over scheduled events of the core; None if it does not apply.

    It needs states and scheduled events, and no differentiated expression that could jump.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    works, moves : bool
        As in `core_equations`.
    """
    r, guards = compiled.reduced, compiled.guards
    if not compiled.nx or guards.differentiated or not guards.scheduled_guards:
        return None
    moving, watched = core_motion(compiled)
    given = r.x, r.z, r.p, time.sx, r.constants
    nominal = ca.SX.sym("nominal", compiled.nx + compiled.nz)
    values, to, jump = list[ca.SX](), list[int](), [0]
    for guard in guards.watched:
        if guards.guards[guard].jumps:
            call, places = guards.jump(guard)
            values.append(call.function(*given))
            to += [-1 - place if is_state else guards.n_switches + place for is_state, place in places]
        jump.append(len(to))
    scheduled = guards.scheduled.function(r.p, r.constants)
    column = ca.vertcat(guards.scale.function(*given, nominal), *values, scheduled)
    arguments = [r.p, r.constants, r.x, r.z, time.sx, nominal]
    acts = make_tape(ca.Function("acts", arguments, [ca.densify(column)], READABLE))
    c, project = compiled.constraints, None
    if c.size:
        project = make_tape(ca.Function("project", arguments[:-1], [c.coordinates.function(*given)], READABLE))
    energetic, energies = list[int](), None
    if works:
        column = ca.vertcat(compiled.powers, compiled.energy)
        energies = make_tape(ca.Function("energies", arguments[:-1], [ca.densify(column)], READABLE), early=(0, 1))
        energetic = compiled.dependence.needed(compiled.dependence.inside(column))[0].tolist()
    modes = set(guards.laws.places[:, MODE].tolist())

    def decides(guard: int) -> bool:
        return guard < guards.n_switches or any(jump.discrete in modes for jump in guards.guards[guard].jumps)

    everything = tuple(range(compiled.nz))
    needed = tuple(compiled.dependence.needed(guards.needs)[0].tolist())
    return Sampled(
        core_equations(compiled, False, moves),
        core_square(compiled, everything) if everything else None,
        core_square(compiled, needed) if needed else None,
        moving,
        core_square(compiled, tuple(energetic)) if energetic else None,
        energies,
        watched,
        acts,
        is_switch=np.array([decides(guard) for guard in guards.watched], dtype=np.int32),
        is_clocked=np.array(guards.clocked, dtype=np.int32),
        jump=np.array(jump, dtype=np.int32),
        to=np.array(to, dtype=np.int32),
        project=project,
        coordinate=np.array(c.places, dtype=np.int32),
        multiplier=c.multipliers.astype(np.int32),
    )
