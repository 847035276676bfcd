"""Simplification of the equations of a model, and assembly of its FlatModel."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import UnbalancedModelError
from acausal.flatten.attributes import attributes, by_preference, jumping, started_elsewhere, unknown_units
from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.derivatives import Derivatives
from acausal.flatten.equation_owner import contradiction_text
from acausal.flatten.field_kinds import wrong_kinds
from acausal.flatten.flat_discontinuities import discontinuities
from acausal.flatten.flat_loops import loops_of
from acausal.flatten.flat_model import (
    FlatEquations,
    FlatModel,
    FlatUnknowns,
)
from acausal.flatten.flat_parameters import flat_parameters
from acausal.flatten.initial_conditions import InitialConditions
from acausal.flatten.linear_values import Linear, LinearValues, expressions
from acausal.flatten.origin import Origin
from acausal.flatten.part_constraints import rates
from acausal.flatten.simplify import DECLARED, Simplification, Simplifier, Source
from acausal.flatten.stays_zero import StaysZero, stays_zero
from acausal.flatten.zero_block import zero_block
from acausal.language.functions import feedback, initial, time
from acausal.symbols import picked, scalars, stacked


@dataclass(frozen=True)
class _Remaining:
    """Remaining unknowns and equations after the propagation.

    Parameters
    ----------
    done : Simplification
        Result of the propagation.
    values : list of Linear
        Value of each unknown in the remaining ones.
    unknowns, rows : list of int
        Unknowns and residuals that remain.
    present : set of int
        Unknowns that occurred in the equations.
    vanishing : StaysZero
        Unknowns that stay 0.
    """

    done: Simplification
    values: list[Linear]
    unknowns: list[int]
    rows: list[int]
    present: set[int]
    vanishing: StaysZero

    @cached_property
    def place(self) -> dict[int, int]:
        """Unknown -> its position among the remaining ones."""
        return {k: n for n, k in enumerate(self.unknowns)}


class Assembly:
    """Simplify the statements of the components and assemble the FlatModel.

    Parameters
    ----------
    raw : CollectedStatements
        Statements of the components.
    chain : Derivatives
        Symbols of the variables and of their derivatives.
    resolved : callable
        Replaces placeholders of derivatives in a list of expressions.
    declared : dict of int to casadi.SX
        Variables with a declared derivative that are not integrated.
    full : bool
        Whether unknowns that stay 0 remain.
    """

    def __init__(
        self, raw: CollectedStatements, chain: Derivatives, resolved: Any, declared: dict[int, ca.SX], full: bool
    ) -> None:
        self.raw, self.chain, self.declared, self.full = raw, chain, declared, full
        self.size = chain.variables.numel()
        closures = raw.equations.closures
        residuals = stacked([*raw.equations.residuals, *[c.dual for c in closures]])
        self.residuals, starts, energies = resolved(
            [residuals, stacked(raw.initial.residuals), ca.vertcat(*raw.energies.values())]
        )
        self.initial_residuals, self.energies = starts, dict(zip(raw.energies, ca.vertsplit(energies), strict=True))
        self.symbols, self.lower = ca.vertcat(*chain.levels), chain.lower
        self.discontinuities = discontinuities(raw, resolved)
        self.origins = raw.equations.scalar_origins()
        self.substitutes = {c.row: len(self.origins) + k for k, c in enumerate(closures)}
        self.origins += [self.origins[c.row] for c in closures]

    def flat_model(self) -> FlatModel:
        """Return the simplified FlatModel."""
        left = self._simplified()
        done, removed = left.done, list(left.done.solved)
        eliminated = picked(self.symbols, removed), expressions([left.values[k] for k in removed], self.symbols)
        residuals = ca.vertcat(
            ca.substitute(self.residuals, *eliminated), expressions([value for value, _ in done.left], self.symbols)
        )
        return FlatModel(
            unknowns=self._unknowns(left, eliminated),
            equations=self._equations(left, residuals, eliminated),
            parameters=flat_parameters(self.raw),
            discontinuities=self.discontinuities,
            loops=loops_of(
                self.raw,
                set(done.redundant),
                {source.row for source in left.vanishing.members.values()},
                left.values,
                left.rows,
                residuals,
                self.substitutes,
                self._rates(left),
            ),
            energies=self.energies,
            unconnected=self.raw.graph.unconnected,
            tree=self.raw.build.root,
            counts=self._counts(left),
            stays_zero=by_preference(self.raw, self.lower, left.vanishing.differentiated),
            zero_block=zero_block(self.raw, self.lower, left.vanishing, self.residuals, self.symbols),
        )

    def _simplified(self) -> _Remaining:
        """Propagate constants and aliases."""
        own = stacked(self.raw.build.parameters.symbols)
        given = ca.vertcat(own, time.sx, initial.sx, feedback.sx, self.discontinuities.constants)
        linear = LinearValues(self.symbols, given, self.residuals)
        present, vanishing = set(linear.input) | self._requested(), StaysZero()
        units = unknown_units(self.raw, self.lower)

        def vanish(simplifier: Simplifier) -> Mapping[int, Source]:
            nonlocal vanishing
            barred = {*started_elsewhere(self.raw, linear, self.discontinuities), *self.raw.kept}  # derivatives not 0
            vanishing = stays_zero(
                simplifier,
                barred,
                present,
                lambda: LinearValues(self.symbols, given, self._conditions.residuals, linear.solved),
            )
            return vanishing.members

        simplifier = Simplifier(linear, self._chains(present), self._rank(), self.substitutes, units, self.raw.kept)
        done = simplifier.run(None if self.full else vanish)
        self._refuse_contradictions(done)
        values = [linear.resolve((0.0, ((k, 1.0),))) for k in range(self.symbols.numel())]
        self.origins += [self.origins[source.row] for _, source in done.left]
        unused = self._unused(done)
        rows = [r for r in range(len(self.origins)) if r not in done.used and r not in unused]
        chained = {k for k, up in enumerate(done.derivative) if up >= 0} | {up for up in done.derivative if up >= 0}
        needed = chained | present | set(range(self.size))
        return _Remaining(done, values, sorted(needed.difference(done.solved)), rows, present, vanishing)

    def _unknowns(self, left: _Remaining, eliminated: tuple[ca.SX, ca.SX]) -> FlatUnknowns:
        found = attributes(self.raw, self.lower, jumping(self.raw, self.discontinuities), left.done.solved)
        own = [found[k] for k in left.unknowns]
        at = [k for k in self.declared if k in left.place]
        declared = scalars(ca.substitute(stacked([self.declared[k] for k in at]), *eliminated)) if at else []
        return FlatUnknowns(
            symbols=picked(self.symbols, left.unknowns),
            names=tuple(a.name for a in own),
            derivative=tuple(left.place.get(left.done.derivative[k], -1) for k in left.unknowns),
            declared={left.place[k]: e for k, e in zip(at, declared, strict=True)},
            preference=tuple(a.preference for a in own),
            nominal=np.array([a.nominal for a in own]),
            sized=np.array([a.sized for a in own], dtype=bool),
            units=tuple(a.unit for a in own),
            start=stacked([a.start for a in own]),
            guessed=np.array([a.guessed for a in own], dtype=bool),
            eliminated=eliminated,
        )

    def _equations(self, left: _Remaining, residuals: ca.SX, eliminated: tuple[ca.SX, ca.SX]) -> FlatEquations:
        kept, defines = left.done.kept, self._defines(left)
        place = {row: residuals.numel() + k for k, row in enumerate(kept)}
        residuals = ca.vertcat(residuals, expressions(list(kept.values()), self.symbols))
        return FlatEquations(
            residuals=picked(residuals, [place.get(r, r) for r in left.rows]),
            origins=tuple(self.origins[r] for r in left.rows),
            defines=tuple(defines.get(r, -1) for r in left.rows),
            initial=self._conditions.without(eliminated, left.vanishing.conditions),
            redundant=tuple(self.origins[r] for r in left.done.redundant),
            eliminated_by=lambda k: self._eliminating(self._source(left.rows[k], left.done), left.done),
            repeats=lambda: self._repeats(left.done),
        )

    def _source(self, row: int, done: Simplification) -> Source:
        """Return the source of a row: a residual, or a derivative that removed no unknown."""
        n = self.residuals.numel()
        return Source(row) if row < n else done.left[row - n][1]

    def _eliminating(self, source: Source, done: Simplification) -> tuple[Origin, ...]:
        """Return the equations that eliminated unknowns from a residual, those of the whole model first."""
        place = {s.element_hash(): k for k, s in enumerate(scalars(self.symbols))}
        entries, found = scalars(self.residuals), [source]
        for row, derivatives in found:
            inside = (*(place.get(s.element_hash(), -1) for s in ca.symvar(entries[row])), *derivatives)
            found += dict.fromkeys(
                done.eliminated_by[k] for k in inside if k in done.eliminated_by and done.eliminated_by[k] not in found
            )
        return tuple(sorted((self.origins[s.row] for s in found[1:]), key=lambda o: bool(o.path)))

    def _repeats(self, done: Simplification) -> tuple[tuple[Origin, ...], ...]:
        """Return the redundant equations that close no loop, each followed by those that eliminated its unknowns."""
        own = [*(Source(row) for row in done.redundant if row not in self.substitutes), *done.repeated]
        return tuple(tuple(dict.fromkeys((self.origins[s.row], *self._eliminating(s, done)))) for s in own)

    def _counts(self, left: _Remaining) -> dict[str, int]:
        done = left.done
        return {
            "equations_flat": len(self.origins) - len(self.substitutes) - len(done.left),
            "unknowns_flat": self.size + len([k for k in left.present if k >= self.size]),
            "constants": sum(not terms for _, terms in done.solved.values()),
            "aliases": sum(bool(terms) for _, terms in done.solved.values()),
            "unknowns_at_zero": len(left.vanishing.members),
            "redundant": len(done.redundant),
            "equations_simplified": len(left.rows),
            "unknowns_simplified": len(left.unknowns),
        }

    def _requested(self) -> set[int]:
        """Return the derivatives in initial equations and energies, which are unknowns even without an equation."""
        column = ca.vertcat(self.initial_residuals, *self.energies.values())
        inside = {s.element_hash() for s in ca.symvar(column)}
        derivatives = scalars(stacked(self.chain.levels[1:]))
        return {k for k, s in enumerate(derivatives, self.size) if s.element_hash() in inside}

    def _rates(self, left: _Remaining) -> set[int]:
        """Return the hashes of unknowns whose presence makes an equation of a part no constraint."""
        found = [k for k in left.unknowns if k not in self.declared and left.done.derivative[k] < 0]
        return rates(picked(self.symbols, found), self.raw.declared, self.raw.index, self.declared)

    def _unused(self, done: Simplification) -> set[int]:
        """Return the redundant residuals, and the substitutes of the independent ones."""
        redundant = set(done.redundant)
        return redundant | {s for row, s in self.substitutes.items() if row not in redundant}

    def _chains(self, present: set[int]) -> list[int]:
        """Return the derivative of each unknown, or -1 if none occurs."""
        derivative = [-1] * self.symbols.numel()
        for k, lower in reversed([*enumerate(self.lower, self.size)]):
            if k in present or derivative[k] >= 0:
                derivative[lower] = k
        return derivative

    def _rank(self) -> list[int]:
        rank = [a.declared.select for a in self.raw.arrays for _ in range(a.expr.sx.numel())]
        rank += [0] * (self.symbols.numel() - self.size)
        for k in self.declared:
            rank[k] += 5 * DECLARED
        return rank

    def _defines(self, left: _Remaining) -> dict[int, int]:
        """Return, for remaining residuals, the declared unknown on the left-hand side, itself or by an alias."""
        own: dict[int, int] = {}
        alias: dict[int, int] = {}
        rows, place, kept = set(left.rows), left.place, self.raw.kept
        row = 0
        for lhs, _ in self.raw.equations.sides:
            remain = [k for k in range(lhs.numel()) if row + k in rows]
            entries = scalars(lhs) if remain else []
            for k in remain:
                index = self.raw.index.get(entries[k].element_hash(), -1)
                if index < 0 or (index in place and index not in self.declared):
                    continue
                if index in place:
                    own[row + k] = place[index]
                    continue
                _, terms = left.values[index]
                known = self.declared if index in self.declared else kept
                if terms and terms[0][0] in known and terms[0][0] in place:
                    alias[row + k] = place[terms[0][0]]
            row += lhs.numel()
        taken = set(own.values())
        for r, variable in alias.items():
            if variable not in taken:
                taken.add(variable)
                own[r] = variable
        return own

    @cached_property
    def _conditions(self) -> InitialConditions:
        return InitialConditions.of(self.raw, self.initial_residuals)

    def _refuse_contradictions(self, done: Simplification) -> None:
        if done.contradictions:
            wrong = [(self.origins[source.row], value) for source, value in done.contradictions]
            others = dict.fromkeys(o for source, _ in done.contradictions[:5] for o in self._eliminating(source, done))
            kinds = wrong_kinds(self.raw.build.root, [self.residuals[source.row] for source, _ in done.contradictions])
            raise UnbalancedModelError("\n".join([*kinds, contradiction_text(self.raw.build.root, wrong, others)]))
