"""Comparisons of time with parameters inside joined conditions: each switches by the clock, at a break time.

A condition that also compares other things is watched, but what the clock decides in it must not be left to a search: a
pulse may begin and end between two looks. So each such comparison becomes a switch of its own, whose instants are
break times, and the condition is watched with what these switches leave of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import casadi as ca

from acausal.compiler.intervals import bounded
from acausal.flatten.discontinuities import Guard
from acausal.language.condition import Condition, Joined
from acausal.language.expression import Expr
from acausal.language.functions import time
from acausal.reduce import ReducedModel
from acausal.symbols import Distinct, scalars


def time_comparisons(reduced: ReducedModel, conditions: Iterable[Condition]) -> tuple[list[bool], list[bool], ca.SX]:
    """Return which comparisons hold time and parameters alone, which of these are curved, and their excesses, a column.

    The instants of the others are known from parameters, those of curved ones can be found reliably.

    Parameters
    ----------
    reduced : ReducedModel
        The model.
    conditions : iterable of Condition
        Of their comparisons, in order.
    """
    entries = [part.excess.sx for condition in conditions for part in condition.comparisons]
    if not entries:
        return [], [], ca.SX(0, 1)
    excess = reduced.running.resolve(ca.vertcat(*entries))
    free = {s.element_hash() for s in scalars(ca.vertcat(reduced.p, time.sx))}
    bent = ca.which_depends(excess, time.sx, 2, True)
    timed = [
        all(s.element_hash() in free for s in ca.symvar(e)) and (not curved or all(map(bounded, functions(reduced, e))))
        for e, curved in zip(scalars(excess), bent, strict=True)
    ]
    return timed, [t and curved for t, curved in zip(timed, bent, strict=True)], excess


def functions(reduced: ReducedModel, excess: ca.SX) -> tuple[ca.Function, ca.Function]:
    """Functions of parameters and time: an excess, and its derivative."""
    given = [reduced.p, time.sx]
    slope = ca.densify(ca.jacobian(excess, time.sx))
    return ca.Function("excess", given, [ca.densify(excess)]), ca.Function("slope", given, [slope])


def planned_times(reduced: ReducedModel, excess: ca.SX) -> tuple[list[int], ca.SX]:
    """Return which comparisons are linear in time, with factors of parameters and constants alone, and when they change.

    Parameters
    ----------
    reduced : ReducedModel
        The model.
    excess : casadi.SX
        Of comparisons, a column.
    """
    free = {s.element_hash() for s in scalars(ca.vertcat(reduced.p, reduced.constants, time.sx))}
    bent = ca.which_depends(excess, time.sx, 2, True) if excess.numel() else []
    moving = ca.which_depends(excess, time.sx, 1, True) if excess.numel() else []
    plain = [
        k
        for k, e in enumerate(scalars(excess))
        if moving[k] and not bent[k] and all(s.element_hash() in free for s in ca.symvar(e))
    ]
    if not plain:
        return [], ca.SX(0, 1)
    chosen = excess[plain]
    return plain, ca.densify(-ca.substitute(chosen, time.sx, 0) / ca.jtimes(chosen, time.sx, 1))


def truth(condition: Condition, parts: Iterator[ca.SX]) -> ca.SX:
    """Return 1 where a condition holds and 0 elsewhere; `parts` are the excesses of its comparisons, in order."""
    if not isinstance(condition, Joined):
        return ca.SX(condition.holds(next(parts)))
    a, b = truth(condition.a, parts), truth(condition.b, parts)
    return a * b if condition.every else ca.fmax(a, b)


def split_time_comparisons(reduced: ReducedModel) -> ReducedModel:
    """Return the model with a switch for every comparison with time in a condition that is not decided by time alone."""
    flat = reduced.flat
    joined = [guard for guard in flat.discontinuities.guards if isinstance(guard.condition, Joined)]
    timed, _, excess = time_comparisons(reduced, [guard.condition for guard in joined])
    known, switches, own = iter(zip(timed, scalars(excess), strict=True)), list[tuple[ca.SX, Guard]](), {}
    distinct = Distinct()
    for guard in joined:
        parts = [(part, *next(known)) for part in guard.condition.comparisons]
        if all(t for _, t, _ in parts) or not any(t for _, t, _ in parts):
            continue
        own_switches = {
            id(part): _switch(Condition(Expr(e), part.kind), guard, switches, distinct) for part, t, e in parts if t
        }
        own[id(guard)] = replace(guard, condition=_what_is_left(guard.condition, own_switches).condition())
    if not own:
        return reduced
    kept = flat.discontinuities
    n = len(kept.switches)
    guards = [own.get(id(guard), guard) for guard in kept.guards]
    changed = replace(
        kept,
        switches=(*kept.switches, *(switch for switch, _ in switches)),
        guards=(*guards[:n], *(guard for _, guard in switches), *guards[n:]),
    )
    return replace(reduced, flat=replace(flat, discontinuities=changed))


def _switch(condition: Condition, guard: Guard, switches: list[tuple[ca.SX, Guard]], distinct: Distinct) -> ca.SX:
    """Return the switch of a comparison, the same for the same comparison."""
    number = distinct.number(condition.excess.sx, condition.kind)
    if number == len(switches):
        switches.append((ca.SX.sym("clock"), Guard(condition, guard.origin)))
    return switches[number][0]


@dataclass(frozen=True)
class _Left:
    """What switches leave of a condition: where it certainly holds, where it certainly does not, and what decides else."""

    yes: ca.SX
    no: ca.SX
    rest: Condition | None

    def condition(self) -> Condition:
        """Return it as one comparison."""
        assert self.rest is not None
        excess = ca.if_else(self.yes, -1, ca.if_else(self.no, 1, self.rest.excess.sx))
        return Condition(Expr(excess), self.rest.kind)


def _what_is_left(condition: Condition, switches: dict[int, ca.SX]) -> _Left:
    if not isinstance(condition, Joined):
        switch = switches.get(id(condition))
        return _Left(ca.SX(0), ca.SX(0), condition) if switch is None else _Left(switch, 1 - switch, None)
    a, b = _what_is_left(condition.a, switches), _what_is_left(condition.b, switches)
    every = condition.every
    yes = a.yes * b.yes if every else ca.fmax(a.yes, b.yes)
    no = ca.fmax(a.no, b.no) if every else a.no * b.no
    if a.rest is None or b.rest is None:
        return _Left(yes, no, b.rest if a.rest is None else a.rest)
    # A part that is settled without settling the whole does not matter.
    silent_a, silent_b = (a.yes, b.yes) if every else (a.no, b.no)
    both = Joined(a.rest, b.rest, every)
    excess = ca.if_else(silent_a, b.rest.excess.sx, ca.if_else(silent_b, a.rest.excess.sx, both.excess.sx))
    return _Left(yes, no, Condition(Expr(excess), both.kind))
