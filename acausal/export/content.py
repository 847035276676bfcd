"""The model as a file that the library of an FMU reads, see docs/model-file.md."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.constants import Constants
from acausal.core import StoredModel, make_equations, make_square, make_tape
from acausal.core.model_file import floats, ints, tape_bytes
from acausal.export.beginning import Beginning
from acausal.export.given import Given
from acausal.export.limits import Limit, limits
from acausal.language.functions import time
from acausal.solve.initialization.assembly import levels
from acausal.solve.initialization.coordinate_partitioning import choose_projection, closing_scales
from acausal.solve.initialization.independent_constraints import closure_of
from acausal.solve.integrate.one_step import are_rates, sizes
from acausal.solve.problem import Problem
from acausal.symbols import dense, picked, scalars, stacked

VERSION = 5


def watched(compiled: CompiledModel, given: Given) -> list[int]:
    """Return the guards that are watched: all but those whose instants functions of parameters and constants tell."""
    guards, symbols = compiled.guards, scalars(given.symbols)
    inputs = {symbols[k].element_hash() for k, _ in given.inputs}
    seen = {*guards.watched, *guards.bent}
    return [
        k
        for k in range(len(guards.guards))
        if k in seen or any(s.element_hash() in inputs for s in ca.symvar(guards.excess[k]))
    ]


@dataclass(frozen=True)
class Content:
    """What the file holds.

    Parameters
    ----------
    problem : Problem
        The model.
    beginning : Beginning
        Where it starts.
    given : Given
        What it is given.
    nominal : array
        Sizes of states and algebraic unknowns.
    watched : list of int
        Its guards that are event indicators.
    shown : casadi.SX
        Variables that importers read, in x, z, parameters, time and constants.
    span, tolerance : float
        Usual length of a run in s, and its tolerance.
    """

    problem: Problem
    beginning: Beginning
    given: Given
    nominal: np.ndarray
    watched: list[int]
    shown: ca.SX
    span: float
    tolerance: float

    @property
    def compiled(self) -> CompiledModel:
        """The model."""
        return self.problem.compiled

    @property
    def sections(self) -> dict[str, bytes]:
        """Content of the sections of the file by their tags, but for what tells the model from others."""
        constants = self.beginning.at.constants
        shape = [len(constants.switches), len(constants.discretes), len(constants.closures), self.shown.numel()]
        c, jumps = self.compiled.constraints, self._jumps
        shape += [len(self.watched), len(self._timed), self._instants.numel(), jumps[0].numel(), c.size]
        shape += [len(self.given.inputs), len(self._levels)]
        places = [k for pair in self.given.inputs for k in pair]
        return {
            **self._model.sections,
            "layout": ints(shape),
            "roles": ints(self.given.roles),
            "starts": ints([self.given.starts.get(k, -1) for k in range(self.compiled.nx)]),
            "inputs": ints([*places, len(self.given.roles) - 1] if places else []),
            **self._square("settle", self.running[1], 3, self.compiled.nz),
            **self._square("begin", self.beginning.residuals, None, self.compiled.nx + self.compiled.nz),
            **{name: self._tape(column) for name, column in self._columns.items()},
            "rules": ints([k for rule in self._rules for k in rule]),
            "jumpsto": ints([k for place in jumps[1] for k in place]),
            "closeat": ints(self._closing.sparsity().colind()) + ints(self._closing.sparsity().row()),
            "closures": ints(closure_of(self.compiled)),
            "kinds": ints(c.kinds),
            "levels": b"".join(ints([len(rows), len(columns), *rows, *columns]) for rows, columns in self._levels),
            "coordsto": ints(self._coordinates[1]),
            "followat": ints(c.multipliers) + ints(c.kept.T.ravel()),
            "bounds": floats([k for limit in self._limits for k in (limit.least, limit.strict, limit.kind)]),
            "limited": b"".join(limit.text.encode() + b"\0" for limit in self._limits),
            "damped": floats(sizes(self.problem, self.nominal, self.beginning.vibration)),
            "nominal": floats([self.span, self.tolerance, *self.nominal, *self.problem.loop_scales, *self._follows]),
            "natural": floats(self.nominal[self.compiled.nx :]),
        }

    @property
    def _timed(self) -> list[int]:
        return [k for k in self.compiled.guards.timed if k not in set(self.watched)]

    @property
    def _symbols(self) -> list[ca.SX]:
        r = self.compiled.reduced
        return [r.x, r.z, time.sx, self.given.symbols, r.constants]

    def moving(self, expression: ca.SX) -> ca.SX:
        """Return an expression where the projection moves and inputs vary."""
        projections = self.compiled.reduced.projections
        if projections.choice.numel():
            expression = ca.substitute(expression, projections.moves, 1)
        return self.given.sloped(expression)

    @cached_property
    def running(self) -> tuple[ca.SX, ca.SX]:
        """Derivatives of the states, and residuals."""
        running = self.compiled.reduced.running
        return self.moving(running.ode), self.moving(running.alg)

    @cached_property
    def _model(self) -> StoredModel:
        at, nx = self.beginning.at, self.compiled.nx
        x, z, t, p, c = self._symbols
        return StoredModel(
            make_equations(x, z, t, p, c, *self.running),
            at.time,
            *(at.x, at.z, self.given.values, self._constants.vector),
            size=self.nominal[:nx],
            rate=are_rates(self.problem),
            names=self.compiled.states,
        )

    @property
    def _constants(self) -> Constants:
        """Those of the start, where constraints that do not count have entries of D, too: the library may keep others."""
        at = self.beginning.at
        if at.constants.all_count:
            return at.constants
        all_on = replace(at, constants=replace(at.constants, closures=np.ones_like(at.constants.closures)))
        D = choose_projection(self.problem, all_on, spare=False, moves=True).D
        return replace(at.constants, D=np.where(at.constants.D != 0, at.constants.D, D))

    @property
    def _follows(self) -> np.ndarray:
        """Sizes of the states with which loops follow a jump."""
        if not self.compiled.constraints.size:
            return self.problem.nominal[: self.compiled.nx]
        return closing_scales(self.problem, self.beginning.at, np.empty(0, dtype=int))

    def _square(self, name: str, residuals: ca.SX, argument: int | None, n: int) -> dict[str, bytes]:
        """Equations for the algebraic unknowns, or where no argument is given for these and the states."""
        x, z, t, p, c = self._symbols
        residuals = self.moving(residuals)
        if argument is None:
            square = make_square([p, c, ca.vertcat(x, z), t], 2, residuals, 2, np.arange(n))
        else:
            square = make_square([p, c, x, z, t], 2, residuals, argument, np.arange(n))
        return {name: tape_bytes(square.tape), f"{name}at": ints(square.start) + ints(square.row)}

    def _tape(self, column: ca.SX) -> bytes:
        function = ca.Function("tape", self._symbols, [dense(self.moving(column))])
        return tape_bytes(make_tape(function, early=(3, 4)))

    @property
    def _columns(self) -> dict[str, ca.SX]:
        guards, (J, residuals) = self.compiled.guards, (self._closing, self._constraints)
        return {
            "head": guards.start.function(*guards.arguments),
            "shown": self.shown,
            "guards": ca.vertcat(picked(guards.excess, self.watched), self._scale),
            "timed": self._truths,
            "instants": self._instants,
            "jumps": self._jumps[0],
            "closing": ca.vertcat(residuals, stacked(J.nz[:].elements()) if J.nnz() else ca.SX(0, 1)),
            "coords": self._coordinates[0],
            "limits": stacked([limit.value for limit in self._limits]),
        }

    @cached_property
    def _limits(self) -> list[Limit]:
        return limits(self.compiled)

    @property
    def _scale(self) -> ca.SX:
        """Change of each watched excess by nominal changes of the unknowns."""
        r = self.compiled.reduced
        J = ca.jacobian(picked(self.compiled.guards.excess, self.watched), ca.vertcat(r.x, r.z))
        return ca.fabs(J) @ ca.DM(self.nominal) if self.watched else ca.SX(0, 1)

    @property
    def _truths(self) -> ca.SX:
        guards = self.compiled.guards
        if not self._timed:
            return ca.SX(0, 1)
        held = guards.holds_at.function(self.compiled.reduced.p, time.sx, 0)
        return held[[guards.timed.index(k) for k in self._timed]]

    @cached_property
    def _instants(self) -> ca.SX:
        guards, r = self.compiled.guards, self.compiled.reduced
        found = ca.vertcat(guards.breaks.function(r.p), guards.planned.function(r.p, r.constants))
        return found if found.numel() else ca.SX(0, 1)

    @cached_property
    def _jumps(self) -> tuple[ca.SX, list[tuple[int, int]]]:
        guards = self.compiled.guards
        values, places = list[ca.SX](), list[tuple[int, int]]()
        for k in range(len(guards.guards)):
            if guards.guards[k].jumps:
                call, to = guards.jump(k)
                values.append(call.function(*guards.arguments))
                places += [(int(is_state), place) for is_state, place in to]
        return stacked(values), places

    @property
    def _rules(self) -> list[tuple[int, int, int, int, int]]:
        """For each guard the switch that it sets, whether it holds at 0 and acts at the start, its first jump and how many."""
        guards, found = self.compiled.guards, []
        first = np.cumsum([0, *(len(guard.jumps) for guard in guards.guards)]).tolist()
        for k in (*self.watched, *self._timed):
            guard = guards.guards[k]
            switch = k if k < guards.n_switches else -1
            found.append((switch, int(guard.inclusive), int(guard.at_start), first[k], len(guard.jumps)))
        return found

    @property
    def _constraints(self) -> ca.SX:
        running = self.compiled.reduced.running
        return dense(running.constraints) if self.compiled.constraints.size else ca.SX(0, 1)

    @cached_property
    def _closing(self) -> ca.SX:
        return ca.jacobian(self._constraints, self.compiled.reduced.x)

    @cached_property
    def _levels(self) -> list[tuple[list[int], np.ndarray]]:
        return levels(self.compiled)

    @cached_property
    def _coordinates(self) -> tuple[ca.SX, list[int]]:
        """Projected coordinates, and the states that stand for them."""
        r = self.compiled.reduced
        place = {v: k for k, v in enumerate(r.plan.states)}
        to = [place[p.state] for p in r.plan.constrained.projections]
        return (dense(r.running.resolve(r.projections.coordinates)) if to else ca.SX(0, 1)), to
