"""Simplify the equations of a model and put its FlatModel together."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.closing import closing
from acausal.flatten.derivatives import Derivatives
from acausal.flatten.discontinuities import guards, promises
from acausal.flatten.flat_model import FlatModel, Initial
from acausal.flatten.origin import Origin
from acausal.flatten.said import Said, column
from acausal.flatten.simplify import DECLARED, Simplification, Simplifier
from acausal.flatten.tape import Linear, Tape
from acausal.language.fields import ALWAYS
from acausal.language.functions import initial, time
from acausal.symbols import scalars
from acausal.units import parse

SECOND = parse("s")


class Assembly:
    """Simplify what was said and put the FlatModel together.

    Parameters
    ----------
    raw : Said
        What the components said.
    chain : Derivatives
        Symbols of the variables and of their derivatives.
    resolved : callable
        Replaces placeholders of derivatives in a list of expressions.
    declared : dict of int to casadi.SX
        Variables with a declared derivative that is not integrated.
    """

    def __init__(self, raw: Said, chain: Derivatives, resolved: Any, declared: dict[int, ca.SX]) -> None:
        self.raw, self.chain, self.declared = raw, chain, declared
        self.size = chain.levels[0].numel()
        closures = raw.equations.closures
        residuals = column([*raw.equations.residuals, *[c.dual for c in closures]])
        self.residuals, starts, energies = resolved(
            [residuals, column(raw.initial.residuals), ca.vertcat(*raw.energies.values())]
        )
        self.initial_residuals, self.energies = starts, dict(zip(raw.energies, ca.vertsplit(energies), strict=True))
        self.symbols = ca.vertcat(*chain.levels)
        self.parameters = column(raw.build.parameters.symbols)
        self.guards = guards(raw.pending, raw.discretes, resolved)
        self.discretes = tuple(
            zip([ca.vec(d.expr.sx) for d in raw.discretes], resolved(raw.discrete_starts), strict=True)
        )
        self.promises = promises(raw.pending, resolved)
        self.continuous = tuple(zip(resolved(raw.pending.differentiated), raw.pending.sources, strict=True))
        self.modes = column([*[mode for mode, _ in raw.pending.switches], *[symbol for symbol, _ in self.discretes]])
        self.origins = raw.equations.scalar_origins()
        self.substitutes = {c.row: len(self.origins) + k for k, c in enumerate(closures)}
        self.origins += [self.origins[c.row] for c in closures]

    def flat_model(self) -> FlatModel:
        """Simplify and assemble."""
        others = ca.vertcat(self.parameters, time.sx, initial.sx, self.modes)
        tape = Tape(self.symbols, others, self.residuals)
        present = set(tape.input) | self._asked()
        derivative = self._chains(present)
        done = Simplifier(tape, derivative, self._rank(), self.substitutes).run()
        self._refuse_contradictions(done)
        values = [tape.resolve((0.0, ((k, 1.0),))) for k in range(self.symbols.numel())]
        elements = scalars(self.symbols)
        final = [_expression(value, elements) for value in values]
        removed, unused = list(done.solved), self._unused(done)
        was = column([elements[k] for k in removed])
        becomes = column([final[k] for k in removed])
        left = column([_expression(value, elements) for value, _ in done.left])
        self.origins += [self.origins[row] for _, row in done.left]
        rows = [r for r in range(len(self.origins)) if r not in done.used and r not in unused]
        residuals = ca.vertcat(ca.substitute([self.residuals], [was], [becomes])[0], left)
        return self._build(done, rows, residuals, (was, becomes), values, present)

    def _build(
        self,
        done: Simplification,
        rows: list[int],
        residuals: ca.SX,
        eliminated: tuple[ca.SX, ca.SX],
        values: list[Linear],
        present: set[int],
    ) -> FlatModel:
        was, becomes = eliminated
        raw, build = self.raw, self.raw.build
        entries, elements = scalars(residuals), scalars(self.symbols)
        for row, value in done.kept.items():
            entries[row] = _expression(value, elements)
        chained = {k for k, up in enumerate(done.derivative) if up >= 0} | {up for up in done.derivative if up >= 0}
        unknowns = [
            k
            for k in range(self.symbols.numel())
            if k not in done.solved and (k < self.size or k in present or k in chained)
        ]
        place = {k: n for n, k in enumerate(unknowns)}
        defines = self._defines(place, values, set(rows))
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
            declared={place[k]: e for k, e in zip(declared_at, scalars(declared), strict=True)} if declared_at else {},
            defines=tuple(defines.get(r, -1) for r in rows),
            origins=tuple(self.origins[r] for r in rows),
            parameters=self.parameters,
            parameter_names=tuple(build.parameters.names),
            parameter_values=np.array(build.parameters.values),
            switches=tuple((m, g.excess) for (m, _), g in zip(raw.pending.switches, self.guards, strict=False)),
            guards=self.guards,
            discretes=self.discretes,
            continuous=self.continuous,
            promises=self.promises,
            initial=self._initial(was, becomes),
            eliminated=eliminated,
            energies=self.energies,
            limits=tuple(build.parameters.limits),
            bound=build.parameters.bound,
            structural_zeros=tuple(build.parameters.structural_zeros),
            redundant=tuple(self.origins[r] for r in done.redundant),
            unconnected=raw.graph.unconnected,
            **closing(raw, set(done.redundant), values, rows, residuals, self.substitutes),
            tree=build.root,
            counts={
                "equations_flat": len(self.origins) - len(self.substitutes) - len(done.left),
                "unknowns_flat": self.size + len([k for k in present if k >= self.size]),
                "constants": sum(not terms for _, terms in done.solved.values()),
                "aliases": sum(bool(terms) for _, terms in done.solved.values()),
                "redundant": len(done.redundant),
                "equations_simplified": len(rows),
                "unknowns_simplified": len(unknowns),
            },
            **attributes,
        )

    def _asked(self) -> set[int]:
        """Derivatives that initial equations and energies hold; they are unknowns even where no equation holds them."""
        inside = ca.symvar(ca.vertcat(self.initial_residuals, *self.energies.values()))
        asked = {s.element_hash() for s in inside}.difference(self.raw.index)
        place = {s.element_hash(): k for k, s in enumerate(scalars(self.symbols))} if asked else {}
        return {place[s] for s in asked if s in place}

    def _unused(self, done: Simplification) -> set[int]:
        """Residuals that say nothing new, and substitutes of those that do."""
        redundant = set(done.redundant)
        return redundant | {s for row, s in self.substitutes.items() if row not in redundant}

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

    def _defines(self, place: dict[int, int], values: list[Linear], rows: set[int]) -> dict[int, int]:
        """Residual that remains -> the declared unknown on its left-hand side, by its own name or by that of an alias."""
        own: dict[int, int] = {}
        alias: dict[int, int] = {}
        row = 0
        for lhs, _ in self.raw.equations.sides:
            for k, entry in enumerate(scalars(ca.vec(ca.densify(lhs)))):
                index = self.raw.index.get(entry.element_hash(), -1)
                if index not in self.declared or row + k not in rows:
                    continue
                if index in place:
                    own[row + k] = place[index]
                    continue
                _, terms = values[index]
                if terms and terms[0][0] in self.declared and terms[0][0] in place:
                    alias[row + k] = place[terms[0][0]]
            row += lhs.numel()
        taken = set(own.values())
        for r, variable in alias.items():
            if variable not in taken:
                taken.add(variable)
                own[r] = variable
        return own

    def _attributes(self, done: Simplification, unknowns: list[int], place: dict[int, int]) -> dict[str, Any]:
        """Start, nominal value and preference of the remaining unknowns; an alias passes its own on."""
        arrays = self.raw.arrays
        start = [s for a in arrays for s in scalars(ca.vec(ca.densify(a.start.sx)))]
        guessed = [a.guessed or a.fixed for a in arrays for _ in range(a.expr.sx.numel())]
        weights = column([ca.vec(a.nominal.sx) for a in arrays])
        inside = {s.element_hash() for s in ca.symvar(weights)}
        nominal = self._numbers(weights)
        sized = [a.sized for a in arrays for _ in range(a.expr.sx.numel())]
        units = [u for a in arrays for u in a.units]
        for _ in self.chain.levels[1:]:
            units.extend(u and u / SECOND for u in units[-self.size :])
        select = [a.declared.select for a in arrays for _ in range(a.expr.sx.numel())]
        for k in self._jumping():
            select[k] = ALWAYS
        extra = self.symbols.numel() - self.size
        # What an instance says counts before what a class says, and that before nothing.
        weight = [2 if told else int(not s.is_zero()) for told, s in zip(guessed, start, strict=True)] + [0] * extra
        start, guessed = start + [ca.SX(0)] * extra, guessed + [False] * extra
        nominal, select, sized = (
            np.concatenate([nominal, np.ones(extra)]),
            select + [0] * extra,
            sized + [False] * extra,
        )
        for k in reversed(done.solved):
            c0, terms = done.solved[k]
            if not terms:
                continue
            (other, c) = terms[0]
            if weight[k] > weight[other]:
                start[other], weight[other], guessed[other] = (start[k] - c0) / c, weight[k], guessed[k]
            if select[k] > select[other] and select[other] == 0:
                select[other] = select[k]
            if sized[k] and not sized[other]:
                nominal[other], sized[other] = nominal[k] / abs(c), True
        return {
            "start": column([start[k] for k in unknowns]),
            "guessed": np.array([guessed[k] for k in unknowns], dtype=bool),
            "nominal": nominal[unknowns],
            "sized": np.array([sized[k] for k in unknowns], dtype=bool),
            "units": tuple(units[k] for k in unknowns),
            "weighing": tuple(
                name
                for name, s in zip(self.raw.build.parameters.names, scalars(self.parameters), strict=True)
                if s.element_hash() in inside
            ),
            "preference": tuple(select[k] for k in unknowns),
        }

    def _jumping(self) -> list[int]:
        """Variables that jump at instants, which have to be states."""
        targets = [jump.target for guard in self.guards for jump in guard.jumps if jump.target.is_symbolic()]
        places = (self.raw.index.get(target.element_hash(), -1) for target in targets)
        return [k for k in places if k >= 0]

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
            for name, entry in zip(a.names, scalars(ca.vec(ca.densify(a.start.sx))), strict=True)
        ]
        texts += [("initial equation", o) for o in self.raw.initial.scalar_origins()]
        entries = ca.substitute([column([ca.densify(r) for r in residuals])], [was], [becomes])[0]
        if not texts:
            return ()
        return tuple(Initial(r, text, o) for r, (text, o) in zip(scalars(entries), texts, strict=True))

    def _refuse_contradictions(self, done: Simplification) -> None:
        if done.contradictions:
            lines = [
                f"  {self.origins[row]}: its sides differ by {value:.6g}" for row, value in done.contradictions[:10]
            ]
            raise DeclarationError(
                "these equations contradict the others, whatever the motion:\n" + "\n".join(lines) + "\n"
                "A length, position or value is given twice with different values; remove one or make them agree."
            )


def _expression(value: Linear, elements: list[Any]) -> Any:
    c0, terms = value
    products = [elements[u] if c == 1 else elements[u] * c for u, c in terms]
    return reduce(add, [*products, c0] if c0 or not products else products)
