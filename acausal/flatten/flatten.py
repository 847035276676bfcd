"""flatten(): from a model to its FlatModel."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.collect import Equations, collect, collect_initial
from acausal.flatten.derivatives import Derivatives
from acausal.flatten.flat_model import FlatModel, Initial
from acausal.flatten.graph import Graph, build_graph
from acausal.flatten.instantiate import Instantiation
from acausal.flatten.origin import Origin, with_place
from acausal.flatten.simplify import DECLARED, Simplification, Simplifier
from acausal.flatten.tape import Tape
from acausal.flatten.variables import VariableArray, create_variables
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.language.expression import Expr, as_expr
from acausal.language.functions import PENDING, Pending, initial, time


@dataclass
class _Raw:
    """What the components said, before simplification."""

    build: Instantiation
    graph: Graph
    arrays: list[VariableArray]
    equations: Equations
    initial: Equations
    declared: list[tuple[Expr, Expr]]
    energies: dict[str, Any]
    pending: Pending
    index: dict[int, int] = field(default_factory=dict)


def flatten(model: Component, overrides: Mapping[str, Any] | None = None) -> FlatModel:
    """Flatten a model: instantiate, connect, collect the equations, propagate constants and aliases.

    Parameters
    ----------
    model : Component
        The model as constructed.
    overrides : mapping of str to value, optional
        Parameters and structural parameters by path that replace those of the model.

    Returns
    -------
    FlatModel

    Raises
    ------
    DeclarationError, ConnectError, UnitsError
        Where the model is wrong, with component and line.
    """
    raw = _collect(model, overrides)
    variables = column([ca.vec(a.expr.sx) for a in raw.arrays])
    raw.index = {s.element_hash(): k for k, s in enumerate(variables.elements())}
    declared = _declared(raw)
    integrated = _integrated(raw, declared)
    chain = Derivatives(variables, {k: e for k, e in declared.items() if k not in integrated})
    placeholders, derivatives = chain.resolve(raw.pending.derivatives)

    def resolved(expressions: list[ca.SX]) -> list[ca.SX]:
        return ca.substitute(expressions, [placeholders], [derivatives])

    for k in integrated:
        raw.equations.residuals.append(chain.levels[1][k] - declared[k])
        raw.equations.origins.append(Origin(variables[k].name(), "root", "declared derivative"))
        raw.equations.sides.append((chain.levels[1][k], declared[k]))
    return _Assembly(raw, chain, resolved, {k: e for k, e in declared.items() if k not in integrated}).flat_model()


def _collect(model: Component, overrides: Mapping[str, Any] | None) -> _Raw:
    if not isinstance(model, Component):
        raise DeclarationError(f"expected a model, that is an instance such as SpinUp(); got {model!r}")
    build = Instantiation(model, overrides)
    components = build.components
    graph = build_graph(components)
    arrays = create_variables(components, graph.same)
    pending = Pending()
    token = PENDING.set(pending)
    try:
        equations = collect(components, graph)
        starts = collect_initial(components)
        declared = [pair for group in graph.same for pair in group[0].declared_derivatives()]
        energies = {
            name: sum(
                (_power(c, name) for c in components if getattr(type(c), name) is not getattr(Component, name)),
                as_expr(0.0),
            ).sx
            for name in ("stored_energy", "dissipated_power", "supplied_power")
        }
    finally:
        PENDING.reset(token)
    return _Raw(build, graph, arrays, equations, starts, declared, energies, pending)


def column(entries: Iterable[Any]) -> ca.SX:
    """Stack columns; of nothing an empty column of symbols, where CasADi gives numbers."""
    return ca.vertcat(ca.SX(0, 1), *entries)


def _power(component: Component, name: str) -> Expr:
    origin = Origin(component._path, type(component).__name__, f"{name}()")
    value = as_expr(with_place(getattr(component, name), origin))
    return Expr(value.sx)


def _declared(raw: _Raw) -> dict[int, ca.SX]:
    """Index of each variable with a declared derivative -> that derivative."""
    return {
        raw.index[s.element_hash()]: e
        for variable, derivative in raw.declared
        for s, e in zip(ca.vec(variable.sx).elements(), ca.vec(ca.densify(derivative.sx)).elements(), strict=True)
    }


def _integrated(raw: _Raw, declared: dict[int, ca.SX]) -> list[int]:
    """Declared variables of chosen roots that no root equation defines."""
    if not raw.graph.roots:
        return []
    found: set[int] = set()
    defined = {k for lhs, _ in raw.equations.sides for k in _bare(raw, lhs)}
    for connector in raw.graph.roots:
        for variable, _ in connector.declared_derivatives():
            found.update(raw.index[s.element_hash()] for s in ca.vec(variable.sx).elements())
    return sorted(k for k in found if k in declared and k not in defined)


def _bare(raw: _Raw, side: ca.SX) -> list[int]:
    """Indices of the variables if a side of an equation is nothing but variables."""
    indices = [raw.index.get(s.element_hash(), -1) for s in ca.vec(ca.densify(side)).elements()]
    return indices if -1 not in indices else []


class _Assembly:
    """Simplify the raw equations and put the FlatModel together."""

    def __init__(self, raw: _Raw, chain: Derivatives, resolved: Any, declared: dict[int, ca.SX]) -> None:
        self.raw, self.chain, self.declared = raw, chain, declared
        self.size = chain.levels[0].numel()
        residuals = column(raw.equations.residuals)
        self.residuals, starts, energies = resolved(
            [residuals, column(raw.initial.residuals), ca.vertcat(*raw.energies.values())]
        )
        self.initial_residuals, self.energies = starts, dict(zip(raw.energies, ca.vertsplit(energies), strict=True))
        self.symbols = ca.vertcat(*chain.levels)
        self.parameters = column(raw.build.parameters.symbols)
        self.modes = column([mode for mode, _ in raw.pending.switches])
        self.origins = raw.equations.scalar_origins()

    def flat_model(self) -> FlatModel:
        """Simplify and assemble."""
        others = ca.vertcat(self.parameters, time.sx, initial.sx, self.modes)
        tape = Tape(self.symbols, others, self.residuals)
        present = set(tape.input)
        derivative = self._chains(present)
        done = Simplifier(tape, derivative, self._rank()).run()
        self._refuse_contradictions(done)
        values = [tape.resolve((0.0, ((k, 1.0),))) for k in range(self.symbols.numel())]
        elements = self.symbols.elements()
        final = [
            c0 if not terms else (elements[terms[0][0]] * terms[0][1] + c0 if (c0, terms[0][1]) != (0, 1) else elements[terms[0][0]])
            for c0, terms in values
        ]
        removed = [k for k in done.solved]
        was = column([elements[k] for k in removed])
        becomes = column([final[k] for k in removed])
        rows = [r for r in range(len(self.origins)) if r not in done.used and r not in set(done.redundant)]
        residuals = ca.substitute([self.residuals], [was], [becomes])[0]
        return self._build(done, rows, residuals, (was, becomes), present)

    def _build(self, done: Simplification, rows: list[int], residuals: ca.SX, eliminated: Any, present: set[int]) -> FlatModel:
        was, becomes = eliminated
        raw, build = self.raw, self.raw.build
        entries = residuals.elements()
        for row, (c0, terms) in done.kept.items():
            entries[row] = self.symbols[terms[0][0]] * terms[0][1] + c0
        chained = {k for k, up in enumerate(done.derivative) if up >= 0} | {up for up in done.derivative if up >= 0}
        unknowns = [
            k for k in range(self.symbols.numel()) if k not in done.solved and (k < self.size or k in present or k in chained)
        ]
        place = {k: n for n, k in enumerate(unknowns)}
        defines = self._defines(place)
        declared_at = [k for k in self.declared if k in place]
        declared = ca.substitute([column([self.declared[k] for k in declared_at])], [was], [becomes])[0]
        attributes = self._attributes(done, unknowns, place)
        names = [name for array in raw.arrays for name in array.names]
        for _ in self.chain.levels[1:]:
            names.extend(f"der({n})" for n in names[-self.size :])
        return FlatModel(
            unknowns=column([self.symbols[k] for k in unknowns]),
            residuals=column([entries[r] for r in rows]),
            names=tuple(names[k] for k in unknowns),
            derivative=tuple(place.get(done.derivative[k], -1) for k in unknowns),
            declared={place[k]: e for k, e in zip(declared_at, declared.elements(), strict=True)} if declared_at else {},
            defines=tuple(defines.get(r, -1) for r in rows),
            origins=tuple(self.origins[r] for r in rows),
            parameters=self.parameters,
            parameter_names=tuple(build.parameters.names),
            parameter_values=np.array(build.parameters.values),
            switches=tuple((mode, condition.excess.sx) for mode, condition in raw.pending.switches),
            initial=self._initial(was, becomes),
            eliminated=eliminated,
            energies=self.energies,
            limits=tuple(build.parameters.limits),
            bound=build.parameters.bound,
            structural_zeros=tuple(build.parameters.structural_zeros),
            redundant=tuple(self.origins[r] for r in done.redundant),
            unconnected=raw.graph.unconnected,
            tree=build.root,
            counts={
                "equations_flat": len(self.origins),
                "unknowns_flat": self.size + len([k for k in present if k >= self.size]),
                "constants": sum(not terms for _, terms in done.solved.values()),
                "aliases": sum(bool(terms) for _, terms in done.solved.values()),
                "redundant": len(done.redundant),
                "equations_simplified": len(rows),
                "unknowns_simplified": len(unknowns),
            },
            **attributes,
        )

    def _chains(self, present: set[int]) -> list[int]:
        """Unknown -> its derivative among the symbols, as far as a derivative occurs."""
        n, total = self.size, self.symbols.numel()
        derivative = [-1] * total
        for k in range(total - 1, n - 1, -1):
            if k in present or derivative[k] >= 0:
                derivative[k - n] = k
        return derivative

    def _rank(self) -> list[int]:
        rank = [a.declared.select for a in self.raw.arrays for _ in range(a.expr.sx.numel())]
        rank += [0] * (self.symbols.numel() - self.size)
        for k in self.declared:
            rank[k] += 5 * DECLARED
        return rank

    def _defines(self, place: dict[int, int]) -> dict[int, int]:
        """Residual -> the declared unknown that is its left-hand side."""
        defines, row = {}, 0
        for lhs, _ in self.raw.equations.sides:
            for k, entry in enumerate(ca.vec(ca.densify(lhs)).elements()):
                index = self.raw.index.get(entry.element_hash(), -1)
                if index in self.declared and index in place:
                    defines[row + k] = place[index]
            row += lhs.numel()
        return defines

    def _attributes(self, done: Simplification, unknowns: list[int], place: dict[int, int]) -> dict[str, Any]:
        """Start, nominal value and preference of the remaining unknowns; an alias passes its own on."""
        arrays = self.raw.arrays
        start = [s for a in arrays for s in ca.vec(ca.densify(a.start.sx)).elements()]
        guessed = [a.guessed or a.fixed for a in arrays for _ in range(a.expr.sx.numel())]
        nominal = self._numbers(column([ca.vec(a.nominal.sx) for a in arrays]))
        select = [a.declared.select for a in arrays for _ in range(a.expr.sx.numel())]
        extra = self.symbols.numel() - self.size
        start, guessed = start + [ca.SX(0)] * extra, guessed + [False] * extra
        nominal, select = np.concatenate([nominal, np.ones(extra)]), select + [0] * extra
        for k in reversed(done.solved):
            c0, terms = done.solved[k]
            if not terms:
                continue
            (other, c) = terms[0]
            if guessed[k] and not guessed[other]:
                start[other], guessed[other] = (start[k] - c0) / c, True
            if select[k] > select[other] and select[other] == 0:
                select[other] = select[k]
            if nominal[other] == 1 and nominal[k] != 1:
                nominal[other] = nominal[k] / abs(c)
        return {
            "start": column([start[k] for k in unknowns]),
            "guessed": np.array([guessed[k] for k in unknowns], dtype=bool),
            "nominal": nominal[unknowns],
            "preference": tuple(select[k] for k in unknowns),
        }

    def _numbers(self, column: ca.SX) -> np.ndarray:
        """Values of expressions of parameters, as they are when compiled."""
        function = ca.Function("numbers", [self.parameters], [ca.densify(column)])
        return np.array(function(np.array(self.raw.build.parameters.values))).ravel()

    def _initial(self, was: ca.SX, becomes: ca.SX) -> tuple[Initial, ...]:
        """Fixed start values, then the initial equations of components."""
        fixed = [a for a in self.raw.arrays if a.fixed]
        residuals = [ca.vec(a.expr.sx - a.start.sx) for a in fixed] + [self.initial_residuals]
        texts = [
            (f"{name} = {entry}", Origin(a.owner._path, type(a.owner).__name__, a.owner._origin))
            for a in fixed
            for name, entry in zip(a.names, ca.vec(ca.densify(a.start.sx)).elements(), strict=True)
        ]
        texts += [("initial equation", o) for o in self.raw.initial.scalar_origins()]
        entries = ca.substitute([column([ca.densify(r) for r in residuals])], [was], [becomes])[0]
        if not texts:
            return ()
        return tuple(Initial(r, text, o) for r, (text, o) in zip(entries.elements(), texts, strict=True))

    def _refuse_contradictions(self, done: Simplification) -> None:
        if done.contradictions:
            lines = [f"  {self.origins[row]}: its sides differ by {value:.6g}" for row, value in done.contradictions[:10]]
            raise DeclarationError(
                "these equations contradict the others, whatever the motion:\n" + "\n".join(lines) + "\n"
                "A length, position or value is given twice with different values; remove one or make them agree."
            )
