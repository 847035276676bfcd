"""Time events inside compound conditions: each comparison of time with parameters becomes a switch of its own.

A compound condition that also compares variables is an event indicator and located by sampling. A pulse in time could
begin and end between two samples, so its comparisons with time are separated: they change at break times, which are
known before the run, and the indicator is what these switches leave of the condition.
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
    """Find the comparisons that depend on time and parameters alone.

    Parameters
    ----------
    reduced : ReducedModel
        The model.
    conditions : iterable of Condition
        Conditions whose comparisons are classified, in order.

    Returns
    -------
    timed : list of bool
        Whether each comparison depends on time and parameters alone.
    nonlinear : list of bool
        Whether it is also nonlinear in time: its roots are then found by interval arithmetic.
    excess : casadi.SX
        The excesses of all comparisons, a column.
    """
    entries = [part.excess.sx for condition in conditions for part in condition.comparisons]
    if not entries:
        return [], [], ca.SX(0, 1)
    excess = reduced.running.resolve(ca.vertcat(*entries))
    free = {s.element_hash() for s in scalars(ca.vertcat(reduced.p, time.sx))}
    nonlinear = ca.which_depends(excess, time.sx, 2, True)
    timed = [
        all(s.element_hash() in free for s in ca.symvar(e)) and (not curved or all(map(bounded, functions(reduced, e))))
        for e, curved in zip(scalars(excess), nonlinear, strict=True)
    ]
    return timed, [t and curved for t, curved in zip(timed, nonlinear, strict=True)], excess


def functions(reduced: ReducedModel, excess: ca.SX) -> tuple[ca.Function, ca.Function]:
    """Return an excess and its time derivative as functions of parameters and time."""
    given = [reduced.p, time.sx]
    slope = ca.densify(ca.jacobian(excess, time.sx))
    return ca.Function("excess", given, [ca.densify(excess)]), ca.Function("slope", given, [slope])


def scheduled_times(reduced: ReducedModel, excess: ca.SX) -> tuple[list[int], ca.SX]:
    """Find comparisons that are linear in time with coefficients of parameters and constants alone, and their roots.

    Parameters
    ----------
    reduced : ReducedModel
        The model.
    excess : casadi.SX
        Excesses of comparisons, a column.

    Returns
    -------
    found : list of int
        Positions of these comparisons.
    instants : casadi.SX
        Their roots, in s.
    """
    free = {s.element_hash() for s in scalars(ca.vertcat(reduced.p, reduced.constants, time.sx))}
    nonlinear = ca.which_depends(excess, time.sx, 2, True) if excess.numel() else []
    moving = ca.which_depends(excess, time.sx, 1, True) if excess.numel() else []
    plain = [
        k
        for k, e in enumerate(scalars(excess))
        if moving[k] and not nonlinear[k] and all(s.element_hash() in free for s in ca.symvar(e))
    ]
    if not plain:
        return [], ca.SX(0, 1)
    chosen = excess[plain]
    return plain, ca.densify(-ca.substitute(chosen, time.sx, 0) / ca.jtimes(chosen, time.sx, 1))


def truth(condition: Condition, parts: Iterator[ca.SX]) -> ca.SX:
    """Return the truth value of a condition, 1 or 0, from the excesses of its comparisons in order."""
    if not isinstance(condition, Joined):
        return ca.SX(condition.holds(next(parts)))
    a, b = truth(condition.a, parts), truth(condition.b, parts)
    return a * b if condition.every else ca.fmax(a, b)


def split_time_comparisons(reduced: ReducedModel) -> ReducedModel:
    """Give every comparison with time in a condition that also compares variables a switch of its own."""
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
        own[id(guard)] = replace(guard, condition=_partial(guard.condition, own_switches).condition())
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
    """Return the switch of a comparison; equal comparisons share one."""
    number = distinct.number(condition.excess.sx, condition.kind)
    if number == len(switches):
        switches.append((ca.SX.sym("clock"), Guard(condition, guard.origin)))
    return switches[number][0]


@dataclass(frozen=True)
class _Partial:
    """A condition with the truth values of some comparisons known.

    `yes` is 1 where these decide that it holds, `no` where they decide that it does not; elsewhere `rest` decides.
    """

    yes: ca.SX
    no: ca.SX
    rest: Condition | None

    def condition(self) -> Condition:
        """Return the condition as one comparison."""
        assert self.rest is not None
        excess = ca.if_else(self.yes, -1, ca.if_else(self.no, 1, self.rest.excess.sx))
        return Condition(Expr(excess), self.rest.kind)


def _partial(condition: Condition, switches: dict[int, ca.SX]) -> _Partial:
    if not isinstance(condition, Joined):
        switch = switches.get(id(condition))
        return _Partial(ca.SX(0), ca.SX(0), condition) if switch is None else _Partial(switch, 1 - switch, None)
    a, b = _partial(condition.a, switches), _partial(condition.b, switches)
    every = condition.every
    yes = a.yes * b.yes if every else ca.fmax(a.yes, b.yes)
    no = ca.fmax(a.no, b.no) if every else a.no * b.no
    if a.rest is None or b.rest is None:
        return _Partial(yes, no, b.rest if a.rest is None else a.rest)
    # A decided operand that does not decide the whole leaves it to the other operand.
    silent_a, silent_b = (a.yes, b.yes) if every else (a.no, b.no)
    both = Joined(a.rest, b.rest, every)
    excess = ca.if_else(silent_a, b.rest.excess.sx, ca.if_else(silent_b, a.rest.excess.sx, both.excess.sx))
    return _Partial(yes, no, Condition(Expr(excess), both.kind))
