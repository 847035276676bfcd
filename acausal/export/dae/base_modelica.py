"""The reduced DAE in Base Modelica: one flat model whose text grows linearly with the model."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import AcausalError
from acausal.export.dae.dae_listing import unknown_names
from acausal.export.dae.modelica_text import Names, hashed, modelica, number, texts
from acausal.flatten.component_tree import join, walk
from acausal.flatten.discontinuities import Guard
from acausal.language import fields as f
from acausal.language.condition import Condition, Joined
from acausal.language.functions import initial, time
from acausal.policy import POLICY
from acausal.solve.initialization.initial_modes import start
from acausal.solve.problem import Problem
from acausal.symbols import dense, scalars, stacked

CHOSEN = (
    "// Values that acausal chooses at the start of a run: projection along the constraints, feedback for a run of 1 s."
)


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
        every, plan = unknown_names(compiled), r.plan
        self.unknowns = [self.names(every[k]) for k in (*plan.states, *plan.algebraic)]
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
        inside = {s.element_hash() for s in ca.symvar(ca.vertcat(r.ode, r.alg, compiled.conditions))}
        chosen = scalars(r.constants)[len(self.switches) + len(self.discretes) :]
        values = zip(chosen, self.chosen, self._choice(), strict=True)
        lines = [f"parameter Real {text} = {number(v)};" for s, text, v in values if s.element_hash() in inside]
        yield from [CHOSEN][: len(lines)]
        yield from lines
        at = compiled.start(self.p, 0.0)[0].tolist()
        entries = zip(self.unknowns, (*compiled.states, *compiled.algebraic), at, strict=True)
        for text, name, value in entries:
            unit = str(units.get(name, ""))
            attribute = f'unit = "{unit}", ' if unit and "^" not in unit else ""
            yield f"Real {text}({attribute}start = {number(value)}){self._comment(name)};"
        yield from (f"Real {text};" for text in self.switches)
        yield from (f"discrete Real {text};" for text in self.discretes)

    def _comment(self, name: str) -> str:
        description = self.described.get(re.sub(r"\[[\d,]+\]$", "", name), "")
        description = description.replace("\\", "\\\\").replace('"', '\\"')
        return f' "{description}"' if description else ""

    def _choice(self) -> list[float]:
        """Return the choices for closed loops: redundant closures are dropped, D follows the constraint Jacobian."""
        compiled, layout = self.compiled, self.compiled.layout
        span = float(POLICY.loops.feedback)
        closures, shares = np.ones(layout.closures), np.eye(layout.parts)
        if layout.closures:
            try:
                found = start(Problem(compiled, self.p, span), 0.0, 0.0, "guesses")
                closures[list(found.found(compiled).dropped)] = 0.0
                shares = found.point.constants.shares
            except AcausalError:
                pass  # these parameter values have no consistent start: keep all closures
        return [*closures.tolist(), *shares.T.ravel().tolist(), *[1.0] * (layout.moves + layout.D), span]

    def whole(self) -> str:
        """Return the text of the model."""
        compiled, r = self.compiled, self.compiled.reduced
        outputs = self._outputs()
        starts = [value for _, value in r.flat.discontinuities.discretes]
        switches = r.flat.discontinuities.guards[: compiled.guards.n_switches]
        columns = [r.ode, r.alg, ca.substitute(compiled.conditions, initial.sx, 1), self._resolved(starts)]
        columns += [self._resolved(_excesses(switches)), stacked([e for _, e in outputs])]
        (ode, alg, conditions, begun, excesses, values), shared = self._written(columns, self.known)
        excess_texts = iter(excesses)
        held = [_condition(guard.condition, excess_texts) for guard in switches]
        initials = [f"{e} = 0.0;" for e in conditions]
        initials += [f"{d} = {e};" for d, e in zip(self.discretes, begun, strict=True)]
        whens, more = self._whens()
        equations = [f"{name} = {text};" for name, text in (*shared, *more)]
        equations += [f"der({x}) = {e};" for x, e in zip(self.unknowns[: compiled.nx], ode, strict=True)]
        equations += [f"0.0 = {e};" for e in alg]
        equations += [f"{s} = if {c} then 1.0 else 0.0;" for s, c in zip(self.switches, held, strict=True)]
        equations += [f"{name} = {e};" for (name, _), e in zip(outputs, values, strict=True)]
        lines = [*self.declarations(), *(f"output Real {name};" for name, _ in outputs)]
        lines += [f"Real {name};" for name, _ in (*shared, *more)]
        return _framed(type(compiled.tree).__name__, lines, initials, [*equations, *whens])

    def _resolved(self, entries: list[ca.SX]) -> ca.SX:
        return self.compiled.reduced.running.resolve(stacked(entries)) if entries else ca.SX(0, 1)

    def _written(self, columns: list[ca.SX], known: dict[int, str]) -> tuple[list[list[str]], list[tuple[str, str]]]:
        """Return the texts of columns, and their common subexpressions."""
        found, shared = modelica(stacked([dense(ca.SX(c)) for c in columns]), known, self.names)
        return texts(found, [c.numel() for c in columns]), shared

    def _whens(self) -> tuple[list[str], list[tuple[str, str]]]:
        """Return the when-clauses and their common subexpressions; discrete variables have the values before the event."""
        guards, first = self.compiled.guards, self.compiled.guards.n_switches
        stated = guards.guards[first:]
        jumps = [self._jumps(k) for k in range(first, len(guards.guards))]
        before = {h: f"pre({name})" for h, name in zip(self.discrete_hashes, self.discretes, strict=True)}
        columns = [self._resolved(_excesses(stated)), stacked([e for some in jumps for _, e in some])]
        (excesses, values), shared = self._written(columns, self.known | before)
        excess_texts, new, found = iter(excesses), iter(values), list[str]()
        for guard, some in zip(stated, jumps, strict=True):
            held = _condition(guard.condition, excess_texts)
            found.append(f"when {{{held}, initial()}} then" if guard.at_start else f"when {held} then")
            for left, _ in some:
                found.append(f"  reinit({left}, {next(new)});" if left in self.unknowns else f"  {left} = {next(new)};")
            found.append("end when;")
        return found, shared

    def _jumps(self, guard: int) -> list[tuple[str, ca.SX]]:
        """Return the variables that jump at an event, and their new values."""
        if not self.compiled.guards.guards[guard].jumps:
            return []
        call, places = self.compiled.guards.jump(guard)
        values = scalars(call.function(*self.compiled.guards.arguments))
        names = [(self.unknowns if is_state else self.discretes)[k] for is_state, k in places]
        return list(zip(names, values, strict=True))

    def _outputs(self) -> list[tuple[str, ca.SX]]:
        """Return the outputs that are not unknowns, and their expressions."""
        compiled, known = self.compiled, {*self.compiled.states, *self.compiled.algebraic}
        found = []
        for name in compiled.outputs:
            value = getattr(compiled.tree, name)
            entries = scalars(dense(ca.vec(compiled.reduced.running.resolve(value.sx))))
            places = [f"[{k}]" for k in range(len(entries))] if value.shape else [""]
            found += [(name + k, e) for k, e in zip(places, entries, strict=True)]
        return [(self.names(name), e) for name, e in found if name not in known]


def _excesses(guards: Sequence[Guard]) -> list[ca.SX]:
    """Return the excesses of all comparisons, which are compared with 0."""
    return [part.excess.sx for guard in guards for part in guard.condition.comparisons]


def _condition(condition: Condition, excesses: Iterator[str]) -> str:
    if not isinstance(condition, Joined):
        return f"{next(excesses)} {condition.kind} 0.0"
    a, b = _condition(condition.a, excesses), _condition(condition.b, excesses)
    return f"({a}) {'and' if condition.every else 'or'} ({b})"


def _framed(name: str, lines: list[str], initials: list[str], equations: list[str]) -> str:
    """Return the text of a package with one model."""
    name = Names()(name)
    parts = [("", lines), ("  initial equation", initials), ("  equation", equations)]
    text = [line for head, some in parts if some for line in (*[head][: bool(head)], *(f"    {one}" for one in some))]
    return "\n".join(
        ["//! base 0.1.0", f"package {name}", f"  model {name}", *text, f"  end {name};", f"end {name};", ""]
    )


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
