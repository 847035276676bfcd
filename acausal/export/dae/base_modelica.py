"""The reduced DAE in Base Modelica: one flat model, its equations linear in size, read by tools that know no parts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import AcausalError
from acausal.export.dae.modelica_text import Names, hashed, number, texts, written
from acausal.flatten.tree import join, walk
from acausal.language import fields as f
from acausal.language.condition import Condition, Joined
from acausal.language.functions import initial, time
from acausal.policy import POLICY
from acausal.solve.problem import Problem
from acausal.solve.start.start import start
from acausal.symbols import dense, scalars, stacked

CHOSEN = "// Values that acausal chooses at the start of a run, here for projection along the constraints."


@dataclass
class _Wanted:
    """Expressions whose texts are needed, in order, and how many there are of each kind."""

    columns: list[ca.SX] = field(default_factory=list)
    sizes: list[int] = field(default_factory=list)

    def add(self, column: ca.SX) -> None:
        self.columns.append(dense(column))
        self.sizes.append(column.numel())


class _Text:
    """Names, declarations and equations of a model.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    p : array
        Values of its free parameters.
    """

    def __init__(self, compiled: CompiledModel, p: np.ndarray) -> None:
        self.compiled, self.p = compiled, p
        self.names = Names()
        r = compiled.reduced
        own, layout = r.flat.parameters, compiled.layout
        self.parameters = [self.names(name) for name in own.names]
        # What is integrated in place of a coordinate has its name as well: the coordinate is what users read.
        algebraic = [self.names(name) for name in compiled.algebraic]
        self.unknowns = [*(self.names(name) for name in compiled.states), *algebraic]
        self.switches = [self.names(f"switch[{k + 1}]") for k in range(layout.switches)]
        discretes = scalars(r.constants)[layout.switches : layout.switches + layout.discretes]
        self.discretes = [self.names(s.name()) for s in discretes]
        others = scalars(r.constants)[layout.switches + layout.discretes :]
        self.chosen = [self.names(f"${s.name()}") for s in others]
        constants = [*self.switches, *self.discretes, *self.chosen]
        self.known = {time.sx.element_hash(): "time", initial.sx.element_hash(): "(if initial() then 1.0 else 0.0)"}
        self.known |= hashed(r.p, self.parameters) | hashed(ca.vertcat(r.x, r.z), self.unknowns)
        self.known |= hashed(r.constants, constants)
        self.discrete_hashes = [s.element_hash() for s in discretes]
        self.described = {
            join(c._path, name): declared.description
            for c in walk(compiled.tree)
            for name, declared in c.fields.items()
            if isinstance(declared, f.Variable | f.Parameter)
        }

    def declarations(self) -> Iterator[str]:
        """Yield parameters, states, algebraic unknowns, switches and discrete variables."""
        compiled, r = self.compiled, self.compiled.reduced
        own = r.flat.unknowns
        units = {name: unit for name, unit in zip(own.names, own.units, strict=True) if unit is not None}
        for text, name, value in zip(self.parameters, r.flat.parameters.names, self.p.tolist(), strict=True):
            yield f"parameter Real {text} = {number(value)}{self._comment(name)};"
        if self.chosen:
            yield CHOSEN
        for text, value in zip(self.chosen, self._choice(), strict=True):
            yield f"parameter Real {text} = {number(value)};"
        at = compiled.start(self.p, 0.0)[0].tolist()
        entries = zip(self.unknowns, (*compiled.states, *compiled.algebraic), at, strict=True)
        for text, name, value in entries:
            unit = str(units.get(name, ""))
            said = f'unit = "{unit}", ' if unit and "^" not in unit else ""
            yield f"Real {text}({said}start = {number(value)}){self._comment(name)};"
        yield from (f"Real {text};" for text in self.switches)
        yield from (f"discrete Real {text};" for text in self.discretes)

    def _comment(self, name: str) -> str:
        said = self.described.get(name.partition("[")[0] if name not in self.described else name, "")
        said = said.replace("\\", "\\\\").replace('"', '\\"')
        return f' "{said}"' if said else ""

    def _choice(self) -> list[float]:
        """Return what is chosen of closed loops: redundant closures do not count, D moves with the constraints."""
        compiled, layout = self.compiled, self.compiled.layout
        span = float(POLICY.loops.feedback)
        closures = np.ones(layout.closures)
        if layout.closures:
            try:
                found = start(Problem(compiled, self.p, span), 0.0, 0.0, "guesses").found(compiled)
                closures[list(found.dropped)] = 0.0
            except AcausalError:
                pass  # it starts with other values of parameters: all closures count until then
        return [*closures.tolist(), *[1.0] * (layout.moves + layout.D), span]

    def whole(self) -> str:
        """Return the model."""
        compiled, r = self.compiled, self.compiled.reduced
        guards = compiled.guards
        outputs = self._outputs()
        comparisons = [part.excess.sx for g in guards.guards for part in g.condition.comparisons]
        jumps = [self._jump(k) for k in range(guards.n_switches, len(guards.guards))]
        wanted = _Wanted()
        starts = [value for _, value in r.flat.discontinuities.discretes]
        resolve = r.running.resolve
        for column in (
            *(r.ode, r.alg, ca.substitute(compiled.conditions, initial.sx, 1)),
            *(resolve(stacked(some)) if some else ca.SX(0, 1) for some in (comparisons, starts)),
            *(stacked([e for _, e in outputs]), stacked([e for some in jumps for _, e in some])),
        ):
            wanted.add(column)
        found, shared = written(stacked(wanted.columns), self.known, self.names)
        ode, alg, conditions, excesses, starts_of, values, jumped = texts(found, wanted.sizes)
        said = iter(excesses)
        held = [_condition(g.condition, said) for g in guards.guards]
        states, new = self.unknowns[: compiled.nx], iter(jumped)
        initials = [f"{e} = 0.0;" for e in conditions]
        initials += [f"{d} = {e};" for d, e in zip(self.discretes, starts_of, strict=True)]
        equations = [f"{name} = {text};" for name, text in shared]
        equations += [f"der({x}) = {e};" for x, e in zip(states, ode, strict=True)]
        equations += [f"0.0 = {e};" for e in alg]
        equations += [f"{s} = if {c} then 1.0 else 0.0;" for s, c in zip(self.switches, held, strict=False)]
        equations += [f"{name} = {e};" for (name, _), e in zip(outputs, values, strict=True)]
        for k, some in enumerate(jumps, guards.n_switches):
            equations += self._when(held[k], guards.guards[k].at_start, [(target, next(new)) for target, _ in some])
        more = [f"output Real {name};" for name, _ in outputs] + [f"Real {name};" for name, _ in shared]
        name = Names()(type(compiled.tree).__name__)
        lines = [*self.declarations(), *more]
        parts = [("", lines), ("initial equation", initials), ("equation", equations)]
        body = "\n".join(
            "\n".join([*([f"  {head}"] if head else []), *(f"    {line}" for line in some)])
            for head, some in parts
            if some
        )
        return f"//! base 0.1.0\npackage {name}\n  model {name}\n{body}\n  end {name};\nend {name};\n"

    def _outputs(self) -> list[tuple[str, ca.SX]]:
        """Return outputs that are no unknowns, and what they are."""
        compiled, known = self.compiled, {*self.compiled.states, *self.compiled.algebraic}
        found = []
        for name in compiled.outputs:
            value = getattr(compiled.tree, name)
            entries = scalars(dense(ca.vec(compiled.reduced.running.resolve(value.sx))))
            places = [f"[{k}]" for k in range(len(entries))] if value.shape else [""]
            found += [(name + k, e) for k, e in zip(places, entries, strict=True)]
        return [(self.names(name), e) for name, e in found if name not in known]

    def _jump(self, guard: int) -> list[tuple[tuple[bool, int], ca.SX]]:
        """Return what jumps at an instant, a state or discrete variable, and its new value."""
        if not self.compiled.guards.guards[guard].jumps:
            return []
        call, places = self.compiled.guards.jump(guard)
        values = call.function(*self.compiled.guards.arguments)
        return list(zip(places, scalars(values), strict=True))

    def _when(self, held: str, at_start: bool, jumps: list[tuple[tuple[bool, int], str]]) -> Iterator[str]:
        """Yield a clause that is evaluated where a condition becomes true; discrete variables are those before it."""
        yield f"when {{{held}, initial()}} then" if at_start else f"when {held} then"
        for (is_state, place), text in jumps:
            value = text
            for name in self.discretes:
                value = value.replace(name, f"pre({name})")
            left = self.unknowns[place] if is_state else self.discretes[place]
            yield f"  reinit({left}, {value});" if is_state else f"  {left} = {value};"
        yield "end when;"


def _condition(condition: Condition, excesses: Iterator[str]) -> str:
    if not isinstance(condition, Joined):
        return f"{next(excesses)} {condition.kind} 0.0"
    a, b = _condition(condition.a, excesses), _condition(condition.b, excesses)
    return f"({a}) {'and' if condition.every else 'or'} ({b})"


def base_modelica(compiled: CompiledModel, p: np.ndarray) -> str:
    """Return a model in Base Modelica.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    p : array
        Values of its free parameters.
    """
    return _Text(compiled, p).whole()
