"""The compiled model: functions of states, algebraic unknowns, parameters and time, ready to integrate."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np
import scipy.sparse as sparse

from acausal.compiler.call import Call
from acausal.compiler.closing import Closing
from acausal.errors import DeclarationError
from acausal.flatten.instantiate import not_settable, numeric
from acausal.language import fields as f
from acausal.language.functions import initial, time
from acausal.reduce import ReducedModel
from acausal.symbols import scalars


@dataclass(frozen=True)
class Local:
    """Value and Jacobian of the model at one point.

    `ode`, `alg` and `conditions` are stacked in `value`; `jacobian` holds their derivatives by (x, z).
    """

    value: np.ndarray
    jacobian: sparse.csc_matrix


@dataclass
class CompiledModel:
    """A model that can be initialised, integrated and linearised; made by `compile`.

    Parameters
    ----------
    reduced : ReducedModel
        The equations.
    seconds : dict of str to float
        Time of each stage of compiling.
    """

    reduced: ReducedModel
    seconds: dict[str, float] = field(default_factory=dict)
    integrators: dict[tuple, Call] = field(default_factory=dict)
    cache: dict[Any, Any] = field(default_factory=dict)

    @property
    def tree(self) -> Any:
        """The bound model; its attributes are the symbols of its variables."""
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
    def report(self) -> dict[str, Any]:
        """Sizes at each stage, states, what was removed, and seconds."""
        from acausal.compiler.report import report

        return report(self)

    def summary(self) -> str:
        """Return the report as text."""
        from acausal.compiler.report import summary

        return summary(self)

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the states."""
        return tuple(self.reduced.names[k] for k in self.reduced.plan.states)

    @property
    def algebraic(self) -> tuple[str, ...]:
        """Names of the algebraic unknowns of the integrated system."""
        return tuple(self.reduced.names[k] for k in self.reduced.plan.algebraic)

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs of the model."""
        return tuple(n for n, d in self.tree.fields.items() if isinstance(d, f.Variable) and d.causality == "output")

    @cached_property
    def nominal(self) -> np.ndarray:
        """Typical size of each state and algebraic unknown."""
        flat, plan = self.reduced.flat, self.reduced.plan
        nominal = np.concatenate([flat.nominal, np.ones(plan.system.n_variables - len(flat.nominal))])
        for p in plan.constrained.projections:
            nominal[p.state] = nominal[p.coordinate]
        return nominal[[*plan.states, *plan.algebraic]]

    @cached_property
    def conditions(self) -> ca.SX:
        """Residuals of fixed start values and initial equations, in x, z, parameters and time."""
        entries = [condition.residual for condition in self.reduced.flat.initial]
        return self.reduced.resolve(ca.vertcat(ca.SX(0, 1), *entries), unprojected=True)

    @cached_property
    def closing(self) -> Closing:
        """Constraints that hold at several levels."""
        return Closing(self.reduced)

    @cached_property
    def arguments(self) -> list[ca.SX]:
        """Arguments of every function: x, z, parameters, time, modes and the flag of the initial system."""
        r = self.reduced
        return [r.x, r.z, r.flat.parameters, time.sx, r.modes, initial.sx]

    @cached_property
    def values(self) -> Call:
        """Function of ode, alg and conditions."""
        return Call(ca.Function("values", self.arguments, [ca.densify(self._equations)]))

    @cached_property
    def _equations(self) -> ca.SX:
        return ca.vertcat(self.reduced.ode, self.reduced.alg, self.conditions)

    @cached_property
    def local(self) -> Call:
        """Function of ode, alg and conditions with their sparse Jacobian by (x, z)."""
        J = ca.jacobian(self._equations, ca.vertcat(self.reduced.x, self.reduced.z))
        return Call(ca.Function("local", self.arguments, [ca.densify(self._equations), J]))

    def at(self, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray, flag: float) -> Local:
        """Evaluate equations and Jacobian at a point."""
        value, entries = self.local(x, z, p, t, modes, flag)
        rows, starts, shape = self._pattern
        return Local(value.copy(), sparse.csc_matrix((entries.copy(), rows, starts), shape=shape))

    @cached_property
    def _pattern(self) -> tuple[np.ndarray, np.ndarray, tuple[int, int]]:
        """Row indices, column starts and shape of the Jacobian."""
        pattern = self.local.function.sparsity_out(1)
        return np.array(pattern.row(), dtype=np.int32), np.array(pattern.colind(), dtype=np.int32), pattern.shape

    @cached_property
    def start(self) -> Call:
        """Function of parameters and time: start values of states and algebraic unknowns."""
        flat, plan = self.reduced.flat, self.reduced.plan
        start = [*scalars(flat.start), *[ca.SX(0)] * (plan.system.n_variables - flat.start.numel())]
        for p in plan.constrained.projections:
            start[p.state] = start[p.coordinate]
        chosen = ca.densify(ca.vertcat(ca.SX(0, 1), *[start[k] for k in (*plan.states, *plan.algebraic)]))
        return Call(ca.Function("start", [flat.parameters, time.sx], [chosen]))

    @cached_property
    def breaks(self) -> Call:
        """Function of parameters: break time of each switch."""
        flat = self.reduced.flat
        excess = ca.vertcat(*[e for _, e in flat.switches])
        if not flat.switches:
            return Call(ca.Function("breaks", [flat.parameters], [ca.SX(0, 1)]))
        known = {s.element_hash() for s in scalars(ca.vertcat(flat.parameters, time.sx))}
        if any(s.element_hash() not in known for s in ca.symvar(excess)):
            raise DeclarationError(
                "the condition of a piecewise compares something other than time with parameters; "
                "write it as time < ..., or use smooth=True if value and first two derivatives do not jump."
            )
        at_zero = ca.substitute(excess, time.sx, 0)
        return Call(ca.Function("breaks", [flat.parameters], [ca.densify(-at_zero / ca.jacobian(excess, time.sx))]))

    @cached_property
    def modes_at(self) -> Call:
        """Function of parameters and time: 1 for each switch whose condition holds."""
        flat = self.reduced.flat
        excess = ca.vertcat(*[e for _, e in flat.switches])
        return Call(ca.Function("modes", [flat.parameters, time.sx], [ca.densify(excess < 0)]))

    def integrator(self, grid: tuple[float, ...], options: Mapping[str, Any], energy: bool, moves: bool) -> Call:
        """Return the IDAS integrator for a relative grid and options, built once.

        Time is scaled, t = t0 + s T: t0, T, what follows from parameters alone, and the modes are its parameters.
        """
        key = (grid, tuple(sorted((k, v if not isinstance(v, list) else tuple(v)) for k, v in options.items())), energy, moves)
        if key not in self.integrators:
            started = clock.perf_counter()
            dae = self._dae(energy, moves)
            function = ca.integrator("simulate", "idas", dae, 0.0, list(grid), dict(options))
            self.integrators[key] = Call(function)
            self.seconds["integrators"] = self.seconds.get("integrators", 0.0) + clock.perf_counter() - started
        return self.integrators[key]

    @cached_property
    def _hoisted(self) -> tuple[ca.SX, ca.SX, ca.SX]:
        """Equations with everything that follows from parameters alone replaced by symbols, computed once a run."""
        r = self.reduced
        column = ca.cse(ca.substitute(ca.vertcat(r.ode, r.alg, self.powers), initial.sx, 0))
        column, symbols, values = ca.extract_parametric(column, r.flat.parameters)
        own = {s.element_hash() for s in scalars(r.flat.parameters)}
        bare = [s for s in ca.symvar(column) if s.element_hash() in own]
        return ca.densify(column), ca.vertcat(*symbols, *bare), ca.vertcat(*values, *bare)

    @cached_property
    def powers(self) -> ca.SX:
        """Supplied and dissipated power, in x, z, parameters and time."""
        energies = self.reduced.flat.energies
        return self.reduced.resolve(ca.vertcat(energies["supplied_power"], energies["dissipated_power"]))

    @cached_property
    def hoist(self) -> Call:
        """Function of parameters: what the integrated equations need of them."""
        return Call(ca.Function("hoist", [self.reduced.flat.parameters], [ca.densify(self._hoisted[2])]))

    def _dae(self, quadratures: bool, moves: bool) -> dict[str, ca.SX]:
        key = ("dae", quadratures, moves)
        if key not in self.cache:
            self.cache[key] = self._make_dae(quadratures, moves)
        return self.cache[key]

    def _make_dae(self, quadratures: bool, moves: bool) -> dict[str, ca.SX]:
        r, (column, hoisted, _) = self.reduced, self._hoisted
        column = ca.substitute(column, r.closing.moves, moves)
        s, t0, T = ca.SX.sym("s"), ca.SX.sym("t0"), ca.SX.sym("T")
        column = ca.substitute(column, time.sx, t0 + s * T)
        ode, alg, powers = ca.vertsplit(column, [0, self.nx, self.nx + self.nz, column.numel()])
        dae = {"x": r.x, "z": r.z, "p": ca.vertcat(t0, T, hoisted, r.modes), "t": s, "ode": T * ode, "alg": alg}
        if quadratures:
            dae["quad"] = T * powers
        return dae

    def parameter_values(self, changes: Mapping[str, Any] | None) -> np.ndarray:
        """Return the values of all free parameters after some changes.

        Raises
        ------
        DeclarationError
            For an unknown name, a structural parameter, a structural zero, a parameter that follows others, or a
            value out of its limits.
        """
        flat = self.reduced.flat
        values = flat.parameter_values.copy()
        for path, value in (changes or {}).items():
            self._set(values, path, value)
        self._check_limits(values)
        return values

    def _set(self, values: np.ndarray, path: str, value: Any) -> None:
        flat = self.reduced.flat
        index = {name: k for k, name in enumerate(flat.parameter_names)}
        try:
            array = numeric(value, np.shape(value), f"`{path}`")
        except ValueError:
            raise DeclarationError(f"`{path}` is {value!r}; it must be an array of numbers.") from None
        prefix = path + "["
        entries = [n for n in (*index, *flat.structural_zeros) if n == path or n.startswith(prefix)]
        if not entries:
            if path in flat.bound:
                raise DeclarationError(
                    f"`{path}` follows {flat.bound[path]}; change that, or compile with its own value."
                )
            if path in self._structural_names:
                raise DeclarationError(f"`{path}` is structural: it is fixed when compiled. Compile again with it.")
            known = [*flat.parameter_names, *flat.structural_zeros, *flat.bound, *self._structural_names]
            raise DeclarationError(not_settable(path, self.tree, known))
        for name in entries:
            at = tuple(int(k) for k in name[len(path) + 1 : -1].split(",")) if name != path else ()
            if (
                len(at) != array.ndim
                or len(entries) != array.size
                or any(k >= n for k, n in zip(at, array.shape, strict=True))
            ):
                raise DeclarationError(
                    f"`{path}` has entries such as {name}; a value of shape {array.shape} does not fit."
                )
            entry = float(array[at])
            if name in index:
                values[index[name]] = entry
            elif entry != 0:
                raise DeclarationError(
                    f"`{name}` was exactly 0 when compiled and is no longer in the equations (a structural zero). "
                    f"Compile again with it: ac.compile(model, parameters={{{path!r}: ...}})."
                )

    @cached_property
    def _structural_names(self) -> set[str]:
        from acausal.flatten.instantiate import join, walk

        return {join(c._path, n) for c in walk(self.tree) for n, d in c.fields.items() if isinstance(d, f.Structural)}

    def _check_limits(self, values: np.ndarray) -> None:
        flat = self.reduced.flat
        if not flat.limits:
            return
        if "limits" not in self.cache:
            column = ca.vertcat(*[ca.densify(ca.vec(sx)) for _, sx, _ in flat.limits])
            owners = np.repeat(np.arange(len(flat.limits)), [sx.numel() for _, sx, _ in flat.limits])
            least = np.array([-np.inf if d.minimum is None else d.minimum for _, _, d in flat.limits])[owners]
            positive = np.array([d.positive for _, _, d in flat.limits])[owners]
            self.cache["limits"] = Call(ca.Function("limits", [flat.parameters], [column])), owners, least, positive
        call, owners, least, positive = self.cache["limits"]
        found = call(values)[0]
        wrong = np.flatnonzero(~(found >= least) | (positive & ~(found > 0)))
        if wrong.size:
            path, _, declared = flat.limits[owners[wrong[0]]]
            bound = "greater than 0" if declared.positive else f"at least {declared.minimum:g}"
            raise DeclarationError(f"`{path}` ({declared.description}) is {found[wrong[0]]:g}; it must be {bound}.")
