"""The model as a file that the library of an FMU reads, see docs/background/model-file.md."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.constants import Constants
from acausal.compiler.runtime import Runtime
from acausal.core import StoredModel
from acausal.core.model_file import floats, ints
from acausal.export.beginning import Beginning
from acausal.export.given import Given
from acausal.export.limits import Limit, limits
from acausal.language.functions import time
from acausal.solve.initialization.assembly import levels
from acausal.solve.initialization.coordinate_partitioning import choose_projection, closing_scales
from acausal.solve.initialization.independent_constraints import closure_of
from acausal.solve.integrate.one_step import are_rates, sizes
from acausal.solve.problem import Problem
from acausal.symbols import scalars, stacked


def watched(compiled: CompiledModel, given: Given) -> list[int]:
    """Return the guards that are watched: all but those whose instants functions of parameters and constants tell."""
    guards, symbols = compiled.guards, scalars(given.symbols)
    inputs = {symbols[k].element_hash() for k, _ in given.inputs}
    seen = {*guards.watched, *guards.nonlinear}
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

    @cached_property
    def runtime(self) -> Runtime:
        """What the run-time takes of the model."""
        compiled, own = self.compiled, self.given
        closures = closure_of(compiled)
        return Runtime(compiled, own.symbols, self.watched, levels(compiled), closures, varied=own.sloped)

    @property
    def sections(self) -> dict[str, bytes]:
        """Content of the sections of the file by their tags, but for what tells the model from others."""
        constants, runtime, c = self.beginning.at.constants, self.runtime, self.compiled
        counts = len(constants.switches), len(constants.discretes), len(constants.closures)
        inputs = [k for pair in self.given.inputs for k in pair]
        return {
            **runtime.sections,
            **self._start.start,
            "layout": runtime.layout(
                counts, self.shown.numel(), len(self._timed), self._instants.numel(), len(self.given.inputs)
            ),
            "roles": ints(self.given.roles),
            "starts": ints([self.given.starts.get(k, -1) for k in range(c.nx)]),
            "inputs": ints([*inputs, len(self.given.roles) - 1] if inputs else []),
            **runtime.square("begin", self.beginning.residuals, None, range(c.nx + c.nz)),
            "head": runtime.tape(self._head),
            "shown": runtime.tape(self.shown),
            "timed": runtime.tape(self._truths),
            "instants": runtime.tape(self._instants),
            "limits": runtime.tape(stacked([limit.value for limit in self._limits])),
            **runtime.rules(self._timed),
            "bounds": floats([k for limit in self._limits for k in (limit.least, limit.strict, limit.kind)]),
            "limited": b"".join(limit.text.encode() + b"\0" for limit in self._limits),
            "damped": floats(sizes(self.problem, self.nominal, self.beginning.vibration)),
            "nominal": floats([self.span, self.tolerance, *self.nominal, *self.problem.loop_scales, *self._follows]),
            "natural": floats(self.nominal[c.nx :]),
            "tables": floats(np.concatenate([[len(self.given.columns)], *self.given.columns])),
        }

    @property
    def _timed(self) -> list[int]:
        return [k for k in self.compiled.guards.timed if k not in set(self.watched)]

    @property
    def _head(self) -> ca.SX:
        """Switches and discrete variables at the start."""
        guards = self.compiled.guards
        head = guards.start.function(*guards.arguments)
        if self.beginning.releases:
            guards.laws.release(head)
        return head

    @cached_property
    def _start(self) -> StoredModel:
        at, nx = self.beginning.at, self.compiled.nx
        return StoredModel(
            self.runtime.equations,
            at.time,
            *(at.x, at.z, self.given.values, self._constants.vector),
            size=self.nominal[:nx],
            rate=are_rates(self.problem.compiled),
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
        return closing_scales(self.problem, self.beginning.at)

    @cached_property
    def _limits(self) -> list[Limit]:
        return limits(self.compiled)

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
        found = ca.vertcat(guards.breaks.function(r.p), guards.scheduled.function(r.p, r.constants))
        return found if found.numel() else ca.SX(0, 1)
