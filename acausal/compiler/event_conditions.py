"""Event conditions of a model as numerical functions: indicators, time events, and the jumps that they trigger."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.call import Call
from acausal.compiler.function_calls import FunctionCalls
from acausal.compiler.rounding import terms
from acausal.compiler.set_valued_laws import SetValuedLaws
from acausal.compiler.time_conditions import functions, scheduled_times, time_comparisons, truth
from acausal.errors import DeclarationError
from acausal.flatten.discontinuities import Guard, Jump
from acausal.flatten.origin import Origin
from acausal.language.functions import time
from acausal.reduce import ReducedModel
from acausal.symbols import scalars, stacked


class EventConditions:
    """The guards of a model: those of its switches, then one for each `when`.

    Parameters
    ----------
    reduced : ReducedModel
        The model.
    start : casadi.Function
        Start values of states and algebraic unknowns, of parameters and time.

    Attributes
    ----------
    excess : casadi.SX
        Excess of each guard, in x, z, parameters, time and constants.
    timed : list of int
        Guards that compare time with parameters alone: their instants are known before the run.
    nonlinear : list of int
        The timed guards with a comparison that is nonlinear in time.
    watched : list of int
        All other guards: their excesses are event indicators.
    n_switches, n_discretes : int
        Number of switches and of discrete variables, in their order in the vector of constants.
    """

    def __init__(self, reduced: ReducedModel, start: ca.Function) -> None:
        changing = reduced.flat.discontinuities
        self.reduced, self.guards, self._start = reduced, changing.guards, start
        self._dependence = reduced.dependence
        self.n_switches = len(changing.switches)
        self.n_discretes = sum(int(symbol.numel()) for symbol, _ in changing.discretes)
        self.arguments = [reduced.x, reduced.z, reduced.p, time.sx, reduced.constants]
        self.excess = self._resolve([g.excess for g in self.guards])
        known = {s.element_hash() for s in scalars(ca.vertcat(*self.arguments))}
        for guard, excess in zip(self.guards, scalars(self.excess), strict=True):
            if any(s.element_hash() not in known for s in ca.symvar(excess)):
                raise DeclarationError(
                    f"{guard.origin}: the condition contains a derivative that occurs in no equation. Declare a variable for "
                    "it, such as a: Scalar = variable(...) with a == der(v), and compare that."
                )
        decided, nonlinear, compared = time_comparisons(reduced, [g.condition for g in self.guards])
        self.timed, rows, row = list[int](), list[tuple[int, bool, Origin]](), 0
        self.nonlinear = list[int]()
        self._open = list[tuple[int, int, bool]]()  # comparisons of watched guards: row, guard, inclusive
        for k, guard in enumerate(self.guards):
            kinds = [part.kind == "<=" for part in guard.condition.comparisons]
            own = range(row, row := row + len(kinds))
            if all(decided[r] for r in own):
                self.timed.append(k)
                self.nonlinear += [k] * any(nonlinear[r] for r in own)
                rows += [(r, inclusive, guard.origin) for r, inclusive in zip(own, kinds, strict=True)]
            else:
                self._open += [(r, k, inclusive) for r, inclusive in zip(own, kinds, strict=True)]
        self._all, self._decided = compared, [r for r, *_ in rows]
        self._compared = compared[[r for r, *_ in rows if not nonlinear[r]]]
        self._nonlinear = [(compared[r], inclusive, origin) for r, inclusive, origin in rows if nonlinear[r]]
        timed = set(self.timed)
        self.watched = [k for k in range(len(self.guards)) if k not in timed]

    def _resolve(self, entries: list[ca.SX], unprojected: bool = False) -> ca.SX:
        column = stacked(entries)
        return ca.densify(self.reduced.running.resolve(column, unprojected))

    @cached_property
    def calls(self) -> FunctionCalls:
        """The functions that are called at events."""
        discretes = self.reduced.constants[self.n_switches : self.n_switches + self.n_discretes]
        return FunctionCalls(self.guards, self._resolve, discretes)

    @cached_property
    def laws(self) -> SetValuedLaws:
        """The set-valued laws of the model."""
        return SetValuedLaws(self.reduced)

    @cached_property
    def breaks(self) -> Call:
        """Function of parameters: break times, one for each linear comparison of the timed guards."""
        p, excess = self.reduced.p, self._compared
        if not excess.numel():
            return Call(ca.Function("breaks", [p], [ca.SX(0, 1)]))
        at_zero = ca.substitute(excess, time.sx, 0)
        return Call(ca.Function("breaks", [p], [ca.densify(-at_zero / ca.jtimes(excess, time.sx, 1))]))

    @cached_property
    def curved(self) -> list[tuple[ca.Function, ca.Function, bool, Origin]]:
        """Comparisons of the timed guards that are nonlinear in time.

        For each: excess and its derivative as functions of parameters and time, whether the comparison includes equality,
        and its origin.
        """
        return [(*functions(self.reduced, excess), inclusive, origin) for excess, inclusive, origin in self._nonlinear]

    @cached_property
    def holds_at(self) -> Call:
        """Function of parameters, time and a span: truth value of each timed guard, NaN where it has no value.

        An excess with a root within the span of time counts as 0.
        """
        near, excess = ca.SX.sym("near"), self._all[self._decided]
        reach = ca.fabs(ca.jtimes(excess, time.sx, ca.SX(1))) * near
        parts = iter(scalars(ca.if_else(ca.fabs(excess) <= reach, 0, excess)))
        known = [ca.logic_or(e <= 0, e > 0) for e in scalars(self.excess[self.timed])]
        held = [
            ca.if_else(is_known, truth(self.guards[k].condition, parts), np.nan)
            for k, is_known in zip(self.timed, known, strict=True)
        ]
        given = [self.reduced.p, time.sx, near]
        return Call(ca.Function("holds_at", given, [ca.densify(stacked(held))]))

    @cached_property
    def scheduled(self) -> Call:
        """Function of parameters and constants: scheduled instants, where time passes a discrete variable."""
        return Call(ca.Function("scheduled", [self.reduced.p, self.reduced.constants], [self._scheduled[1]]))

    @cached_property
    def smooth(self) -> Call:
        """Function of parameters and constants: instants at which laws declared smooth switch, if linear in time."""
        r = self.reduced
        compared = r.running.resolve(stacked(promise.compared for promise in r.flat.discontinuities.promises))
        return Call(ca.Function("smooth", [r.p, r.constants], [scheduled_times(r, compared)[1]]))

    @property
    def scheduled_guards(self) -> list[tuple[int, bool]]:
        """For each entry of `scheduled`: the guard of the comparison, and whether the comparison includes equality."""
        return [self._open[k][1:] for k in self._scheduled[0]]

    @cached_property
    def clocked(self) -> list[bool]:
        """Whether each watched guard compares time with discrete variables alone, so that it changes at scheduled instants."""
        scheduled = Counter(k for k, _ in self.scheduled_guards)
        return [scheduled[k] == self._compared_in[k] for k in self.watched]

    @cached_property
    def _compared_in(self) -> Counter[int]:
        """Number of comparisons in each watched guard."""
        return Counter(k for _, k, _ in self._open)

    @cached_property
    def self_scheduling(self) -> list[int]:
        """Clocked guards with one comparison, with discrete variables that only they change: each schedules its next instant."""
        own = [{jump.discrete for jump in guard.jumps} for guard in self.guards]
        changed = Counter(discrete for jumps in own for discrete in jumps)
        constants = {s.element_hash(): k - self.n_switches for k, s in enumerate(scalars(self.reduced.constants))}
        excess, found = scalars(self.excess), []
        for k, clocked in zip(self.watched, self.clocked, strict=True):
            held = {constants[h] for h in (s.element_hash() for s in ca.symvar(excess[k])) if h in constants}
            # Switches have negative numbers here and so fail the subset test: they could make the condition false again.
            alone = held <= own[k] and all(changed[discrete] == 1 for discrete in held)
            if clocked and self._compared_in[k] == 1 and held and alone:
                found.append(k)
        return found

    @cached_property
    def _scheduled(self) -> tuple[list[int], ca.SX]:
        return scheduled_times(self.reduced, self._all[[row for row, *_ in self._open]])

    @cached_property
    def estimate(self) -> Call:
        """Function of parameters, time and a later time for timed guards: switches and discrete variables at start values."""
        r, later = self.reduced, ca.SX.sym("later")
        head = self._head()
        starts = self._start(r.p, time.sx) if head.numel() else ca.SX(0, 1)
        known = ca.SX.zeros(r.constants.numel())
        for k in self.timed:
            if k < self.n_switches:
                known[k] = head[k] = ca.substitute(head[k], time.sx, later)
        head = ca.substitute([head], [r.constants], [known])[0] if head.numel() else head
        head = ca.substitute([head], [ca.vertcat(r.x, r.z)], [starts])[0] if head.numel() else head
        return Call(ca.Function("estimate", [r.p, time.sx, later], [ca.densify(head)]))

    @cached_property
    def start(self) -> Call:
        """Function of x, z, parameters, time and constants: initial switches and discrete variables at these values."""
        return Call(ca.Function("start", self.arguments, [ca.densify(self._head())]))

    def _head(self) -> ca.SX:
        excesses = scalars(self.excess)[: self.n_switches]
        switches = [guard.condition.holds(e) for guard, e in zip(self.guards, excesses, strict=False)]
        discretes = [start for _, start in self.reduced.flat.discontinuities.discretes]
        return stacked([*switches, self._resolve(discretes)])

    @cached_property
    def continuous(self) -> Call:
        """Function that checks that differentiated expressions do not jump.

        Arguments: x, z, parameters, time and constants before the event, new constants, nominal changes of the unknowns and a
        time span. Results: the expressions with the new constants; how much the nominal changes and the span change each;
        and the size of its terms, see `rounding.terms`.
        """
        r = self.reduced
        new, unknowns = ca.SX.sym("new", r.constants.numel()), ca.vertcat(r.x, r.z)
        nominal, span = ca.SX.sym("nominal", unknowns.numel()), ca.SX.sym("span")
        entries = self._resolve(ca.substitute([e for e, _ in self._entries], [r.constants], [new]))
        size = ca.fabs(ca.jacobian(entries, unknowns)) @ nominal + ca.fabs(ca.jacobian(entries, time.sx)) * span
        rounded = terms([*self.arguments, new], entries)
        return Call(
            ca.Function("continuous", [*self.arguments, new, nominal, span], [entries, ca.densify(size), rounded])
        )

    @property
    def differentiated(self) -> list[Origin]:
        """Origin of each entry of `continuous`."""
        return [origin for _, origin in self._entries]

    @cached_property
    def _entries(self) -> list[tuple[ca.SX, Origin]]:
        return [(e, origin) for column, origin in self.reduced.continuous for e in scalars(column)]

    @cached_property
    def scale(self) -> Call:
        """Function of x, z, parameters, time, constants and nominal changes: nominal change of each watched excess."""
        J = ca.jacobian(self.excess[self.watched], ca.vertcat(self.reduced.x, self.reduced.z))
        nominal = ca.SX.sym("nominal", J.shape[1])
        return Call(ca.Function("scale", [*self.arguments, nominal], [ca.densify(ca.fabs(J) @ nominal)]))

    @cached_property
    def motion(self) -> tuple[ca.SX, ca.SX, ca.SX, ca.SX, ca.SX]:
        """How all watched excesses move, as of `motion_of`."""
        return self.motion_of(self.watched)

    def motion_of(self, some: Sequence[int]) -> tuple[ca.SX, ca.SX, ca.SX, ca.SX, ca.SX]:
        """Return g of some guards, g_t with z held, g_z, h_z and h_t, where h = 0 determines z: dg/dt = g_t - g_z h_z^-1 h_t."""
        r, excess = self.reduced, self.excess[list(some)]
        moving, seeds = ca.vertcat(r.x, time.sx), ca.vertcat(r.running.ode, 1)
        unknowns, equations = (k.tolist() for k in self._dependence.needed(self._dependence.inside(excess)))
        z, own = r.z[unknowns], r.running.alg[equations]
        direct, follows = (ca.densify(ca.jtimes(e, moving, seeds)) for e in (excess, own))
        return excess, direct, ca.jacobian(excess, z), ca.jacobian(own, z), follows

    @cached_property
    def needs(self) -> set[int]:
        """Algebraic unknowns on which the watched excesses and their rates depend."""
        return self._dependence.inside(ca.veccat(*self.motion))

    def jump(self, guard: int) -> tuple[Call, list[tuple[bool, int]]]:
        """Return the new values as a function of x, z, parameters, time and constants; and targets: (is a state, number)."""
        return self._jumps[guard]

    @cached_property
    def _jumps(self) -> dict[int, tuple[Call, list[tuple[bool, int]]]]:
        made: dict[int, Any] = {}
        for k, guard in enumerate(self.guards):
            if not guard.jumps:
                continue
            places = [self._place(guard, jump) for jump in guard.jumps]
            values = ca.vertcat(*[value for _, value in places])
            made[k] = Call(ca.Function("jump", self.arguments, [ca.densify(values)])), [at for at, _ in places]
        return made

    def _place(self, guard: Guard, jump: Jump) -> tuple[tuple[bool, int], ca.SX]:
        """Return the target of a jump, as in `jump`, and its value afterwards."""
        target, value = self._resolve([jump.target], unprojected=True), self._resolve([jump.value])
        if jump.discrete is not None:
            return (False, jump.discrete), value
        x = self.reduced.x
        J = ca.sparsify(ca.jacobian(target, ca.vertcat(x, *self.arguments[1:])))
        states = J.sparsity().get_triplet()[1]
        slopes: list[Any] = J.nonzeros()
        if len(states) != 1 or states[0] >= x.numel() or not slopes[0].is_constant():
            names = ", ".join(f"`{self.reduced.names[s]}`" for s in self.reduced.plan.states) or "there is none"
            raise DeclarationError(
                f"{guard.origin}: reinit({jump.target}, ...): {jump.target} cannot jump, because it follows from an equation. "
                f"Let a state jump, here {names}, or a discrete variable."
            )
        k = states[0]
        return (True, k), x[k] + (value - target) / slopes[0]

    def check(self) -> None:
        """Raise DeclarationError if a jump has no state or discrete variable as its target."""
        _ = self._jumps
