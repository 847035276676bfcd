"""The compiled model: functions of states, algebraic unknowns, parameters and time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np
import scipy

from acausal.compiler.algebraic_newton import NewtonStep, newton_steps
from acausal.compiler.call import Call
from acausal.compiler.constants import Layout
from acausal.compiler.constraint_jacobian import Constraints
from acausal.compiler.diagram import diagram
from acausal.compiler.equations import EquationList, collected, equations_of
from acausal.compiler.event_conditions import EventConditions
from acausal.compiler.linearization import PointLinearization
from acausal.compiler.memo import memoized
from acausal.compiler.model_source import Source, pickled
from acausal.compiler.parameters import Settable
from acausal.compiler.part_graph import part_graph
from acausal.compiler.report import AtStart, report, summary
from acausal.compiler.requirements import Requirements
from acausal.compiler.vectorized import Vectorized
from acausal.language import fields as f
from acausal.language.functions import initial, time
from acausal.locks import exclusive
from acausal.reduce import Dependence, ReducedModel
from acausal.symbols import scalars, stacked

if TYPE_CHECKING:
    import networkx


@dataclass(frozen=True, eq=False)
class CompiledModel:
    """A model that can be initialised, integrated and linearised; made by `compile`.

    Parameters
    ----------
    reduced : ReducedModel
        The equations.
    seconds : dict of str to float
        Time of each stage of compiling.
    source : Source, optional
        What it was compiled from; a pickle holds nothing else.
    declared : mapping of str to value, optional
        Simulation settings declared by a model without a source: numbers or expressions of parameters.
    """

    reduced: ReducedModel
    seconds: dict[str, float] = field(default_factory=dict)
    source: Source | None = None
    memo: dict[Any, Any] = field(default_factory=dict)
    declared: Mapping[str, Any] | None = None

    @exclusive
    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the source of the model; unpickling compiles it again."""
        return pickled(self.source)

    def __repr__(self) -> str:
        return f"CompiledModel({type(self.tree).__name__}: {self.nx} states, {self.nz} algebraic unknowns)"

    @exclusive
    def _repr_html_(self) -> str:
        """Show the report, and the diagram of the parts if the model has a source."""
        drawn = diagram(part_graph(collected(self.source, self.tree, ""), "")) if self.source else ""
        return f"<pre>{escape(summary(self.report_at()))}</pre>{drawn}"

    def __copy__(self) -> CompiledModel:
        # The equations are immutable and shared; all that is computed from them is computed again.
        return CompiledModel(self.reduced, dict(self.seconds), self.source, declared=self.declared)

    def __deepcopy__(self, memo: dict[int, Any]) -> CompiledModel:
        return self.__copy__()

    @property
    def tree(self) -> Any:
        """The bound model, whose attributes are the symbols of its variables."""
        return self.reduced.flat.tree

    @cached_property
    def nx(self) -> int:
        """Number of states."""
        return self.reduced.x.numel()

    @cached_property
    def nz(self) -> int:
        """Number of algebraic unknowns of the integrated system."""
        return self.reduced.z.numel()

    @property
    @exclusive
    def report(self) -> dict[str, Any]:
        """Sizes at each stage, states, removed equations, and seconds."""
        return self.report_at()

    def report_at(self, found: AtStart | None = None) -> dict[str, Any]:
        """Return the report, with the findings at a start."""
        return report(self.reduced, self.local.function, found or AtStart(), self.seconds)

    @exclusive
    def summary(self, found: AtStart | None = None) -> str:
        """Return the report as text, with the findings at a start."""
        return summary(self.report_at(found))

    @exclusive
    def equations(self, part: str = "", reduced: bool = False) -> EquationList:
        """Return the equations of a part, or of the whole model, in sympy: as written, or as reduced; see `equations_of`."""
        return equations_of(self.reduced, self.source, part, reduced)

    @exclusive
    def graph(self, part: str = "") -> networkx.MultiGraph:
        """Return the parts of the model, or of a part, as nodes, and their connections as edges; see `part_graph`."""
        return part_graph(collected(self.source, self.tree, part), part)

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the states."""
        return self.reduced.states

    @property
    def algebraic(self) -> tuple[str, ...]:
        """Names of the algebraic unknowns of the integrated system."""
        return self.reduced.algebraic

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs of the model."""
        return tuple(n for n, d in self.tree.fields.items() if isinstance(d, f.Variable) and d.causality == "output")

    @cached_property
    def nominal(self) -> np.ndarray:
        """Nominal value of each state and algebraic unknown."""
        own, plan = self.reduced.flat.unknowns, self.reduced.plan
        nominal = np.concatenate([own.nominal, np.ones(plan.system.n_variables - len(own.nominal))])
        for p in plan.constrained.projections:
            nominal[p.state], nominal[p.state_rate] = nominal[p.coordinate], nominal[p.rate]
        return nominal[[*plan.states, *plan.algebraic]]

    @cached_property
    def sizes(self) -> tuple[tuple[str, bool], ...]:
        """For each state its unit, or its name if the unit is unknown, and whether its nominal value is declared."""
        own, plan = self.reduced.flat.unknowns, self.reduced.plan
        of = {p.state: p.coordinate for p in plan.constrained.projections}
        places = [of.get(k, k) for k in plan.states]
        known = len(own.names)
        return tuple(
            (str(own.units[k] or own.names[k]), bool(own.sized[k])) if k < known else ("", True) for k in places
        )

    @cached_property
    def conditions(self) -> ca.SX:
        """Residuals of fixed start values and initial equations, in x, z, parameters and time."""
        entries = [condition.residual for condition in self.reduced.flat.equations.initial]
        return self.reduced.resolve(stacked(entries), unprojected=True)

    @cached_property
    def constraints(self) -> Constraints:
        """Constraints at several levels of differentiation, as of closed loops."""
        return Constraints(self.reduced)

    @cached_property
    def arguments(self) -> list[ca.SX]:
        """Arguments of every function: x, z, parameters, time, constants and the flag of the initial system."""
        r = self.reduced
        return [r.x, r.z, r.p, time.sx, r.constants, initial.sx]

    @cached_property
    def values(self) -> Call:
        """Function that returns ode, alg and conditions."""
        return Call(ca.Function("values", self.arguments, [ca.densify(self._equations)]))

    @memoized
    def newton_steps(self, wanted: tuple[int, ...]) -> tuple[NewtonStep, ...]:
        """Return Newton steps, in block order, that solve for algebraic unknowns and all on which they depend."""
        alg = self._shared[self.nx : self.nx + self.nz]
        return newton_steps(alg, self.reduced.z, self.arguments[:-1], *self.dependence.needed(wanted))

    @property
    def dependence(self) -> Dependence:
        """The algebraic unknowns on which an expression depends."""
        return self.reduced.dependence

    @cached_property
    def _equations(self) -> ca.SX:
        return ca.vertcat(self.reduced.ode, self.reduced.alg, self.conditions)

    @cached_property
    def local(self) -> Call:
        """Function that returns ode, alg and conditions, and their sparse Jacobian by (x, z)."""
        J = ca.jacobian(self._equations, ca.vertcat(self.reduced.x, self.reduced.z))
        return Call(ca.Function("local", self.arguments, [ca.densify(self._equations), J]))

    def at(
        self, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: float, constants: np.ndarray, flag: float
    ) -> PointLinearization:
        """Evaluate equations and Jacobian at a point."""
        value, entries = self.local(x, z, p, t, constants, flag)
        return PointLinearization(value.copy(), entries.copy(), self.pattern)

    @cached_property
    def pattern(self) -> scipy.sparse.csc_matrix:
        """Sparsity pattern of the Jacobian, with all entries 0."""
        found = self.local.function.sparsity_out(1)
        rows, starts = (np.array(k, dtype=np.int32) for k in (found.row(), found.colind()))
        return scipy.sparse.csc_matrix((np.zeros(len(rows)), rows, starts), shape=found.shape)

    @cached_property
    def start(self) -> Call:
        """Function of parameters and time: start values of states and algebraic unknowns."""
        own, plan = self.reduced.flat.unknowns.start, self.reduced.plan
        start = [*scalars(own), *[ca.SX(0)] * (plan.system.n_variables - own.numel())]
        for p in plan.constrained.projections:
            start[p.state] = start[p.coordinate]
        chosen = ca.densify(stacked([start[k] for k in (*plan.states, *plan.algebraic)]))
        return Call(ca.Function("start", [self.reduced.p, time.sx], [chosen]))

    @cached_property
    def layout(self) -> Layout:
        """Layout of the vector of constants."""
        guards, constraints = self.guards, self.constraints
        moves = self.reduced.projections.choice.numel() > 0
        parts = len(self.reduced.flat.loops.of_parts) if moves else 0
        counts = guards.n_switches, guards.n_discretes, len(constraints.closures), parts
        return Layout(*counts, int(moves), constraints.entries.shape[1])

    @cached_property
    def guards(self) -> EventConditions:
        """Event conditions of the model."""
        return EventConditions(self.reduced, self.start.function)

    @cached_property
    def _shared(self) -> ca.SX:
        """Derivatives of the states, residuals and powers in one column, with common subexpressions shared."""
        return ca.cse(ca.vertcat(self.reduced.running.ode, self.reduced.running.alg, self.powers))

    @cached_property
    def powers(self) -> ca.SX:
        """Supplied and dissipated power, in x, z, parameters and time."""
        energies = self.reduced.flat.energies
        return self.reduced.running.resolve(ca.vertcat(energies["supplied_power"], energies["dissipated_power"]))

    @cached_property
    def power(self) -> Vectorized:
        """Function of x, z, parameters, time and constants: supplied and dissipated power."""
        return Vectorized(ca.Function("power", self.arguments[:-1], [ca.densify(self.powers)]))

    @cached_property
    def rates(self) -> Vectorized:
        """Function of x, z, parameters, time and constants: derivatives of the states."""
        return Vectorized(ca.Function("rates", self.arguments[:-1], [ca.densify(self.reduced.running.ode)]))

    @cached_property
    def energy(self) -> ca.SX:
        """Stored energy, in x, z, parameters and time."""
        return self.reduced.running.resolve(self.reduced.flat.energies["stored_energy"])

    @cached_property
    def stored(self) -> Call:
        """Function of x, z, parameters, time and constants: stored energy."""
        return Call(ca.Function("stored", self.arguments[:-1], [ca.densify(self.energy)]))

    @exclusive
    def parameter_values(self, changes: Mapping[str, Any] | None) -> np.ndarray:
        """Return the values of all free parameters after the changes; see `Settable`."""
        return self.settable.values(changes)

    @exclusive
    def value(self, path: str) -> Any:
        """Return the value with which a parameter, structural parameter or effect was compiled; see `Settable`."""
        return self.settable.value(path)

    @property
    def requirements(self) -> Requirements:
        """Requirements of components on parameters, and on variables at the start."""
        return self.settable.requirements

    @cached_property
    def settable(self) -> Settable:
        """The settable parameters, for callers that hold the lock."""
        return self.memo.get(Settable) or Settable(self.reduced.flat)
