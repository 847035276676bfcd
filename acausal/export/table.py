"""The variables of an exported model by value reference."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.export.beginning import Beginning
from acausal.export.description import Causality, Variability, Variable
from acausal.export.given import Given, Role
from acausal.flatten.component_tree import walk
from acausal.language import fields as f
from acausal.language.functions import time
from acausal.result.lookup import find, names
from acausal.symbols import dense, scalars, stacked

# Name, default (of the tolerance: that of the model), as in the library, and description.
SETTINGS = (
    ("solver.tolerance", None, "relative tolerance of Co-Simulation"),
    (
        "solver.damping",
        0.0,
        "1: Co-Simulation damps vibrations that are invisible in the coordinates; 0: it resolves them",
    ),
    ("solver.most_steps", 1e6, "largest number of steps of Co-Simulation between two communication points"),
)
TIME = 0  # its reference


@dataclass(frozen=True)
class Seen:
    """A scalar of the interface: name, unit, description, expression, and whether it is an output."""

    name: str
    unit: str
    description: str
    expression: ca.SX
    output: bool


@dataclass
class Table:
    """Variables and their value references.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    given : Given
        Its parameters, start values and inputs.
    beginning : Beginning
        Its initial values and their equations.
    nominal : array
        Nominal values of states and algebraic unknowns.
    tolerance : float
        Tolerance of Co-Simulation.
    watched : list of int
        Conditions that are event indicators.

    Attributes
    ----------
    shown : list of casadi.SX
        Expressions that the library evaluates for the importer.
    """

    compiled: CompiledModel
    given: Given
    beginning: Beginning
    nominal: np.ndarray
    tolerance: float
    watched: list[int]
    shown: list[ca.SX] = field(default_factory=list)

    @property
    def states(self) -> tuple[int, ...]:
        """References of the states."""
        return tuple(range(1, 1 + self.compiled.nx))

    @property
    def rates(self) -> tuple[int, ...]:
        """References of their derivatives."""
        return tuple(k + self.compiled.nx for k in self.states)

    @property
    def parameters(self) -> int:
        """First reference of parameters, start values and inputs."""
        return 1 + 2 * self.compiled.nx

    @property
    def first_shown(self) -> int:
        """First reference of the evaluated variables."""
        return self.parameters + len(self.given.roles)

    def variables(self) -> tuple[Variable, ...]:
        """Return all variables; fills `shown`."""
        seen = list(_seen(self.compiled))
        found = [*self._of_clock(), *self._of_given(seen), *self._of_states(seen), *self._of_seen(seen)]
        first = self.first_shown + len(self.shown)
        found += [
            Variable(f"event_indicators[{k}]", first + k, "local", "continuous", "calculated", "", None)
            for k in range(len(self.watched))
        ]
        first += len(self.watched)
        for k, (name, value, text) in enumerate(SETTINGS):
            start = self.tolerance if value is None else value
            found.append(Variable(name, first + k, "parameter", "fixed", "exact", "", start, text))
        return tuple(found)

    def _of_clock(self) -> Iterator[Variable]:
        yield Variable("time", TIME, "independent", "continuous", None, "s", None, "time")

    def _of_given(self, seen: list[Seen]) -> Iterator[Variable]:
        own = self.compiled.reduced.flat.parameters
        # Parameters bound to another one share its symbol; the declaration is that of the symbol's name.
        declared = {(s.name, s.expression.element_hash()): s for s in seen if s.expression.is_symbolic()}
        kinds: dict[Role, tuple[Causality, Variability]] = {
            Role.TUNABLE: ("parameter", "tunable"),
            Role.FIXED: ("parameter", "fixed"),
            Role.INPUT: ("input", "continuous"),
        }
        symbols = scalars(self.compiled.reduced.p)
        for k, (name, symbol) in enumerate(zip(own.names, symbols, strict=True)):
            if self.given.roles[k] not in kinds:
                continue
            told = declared.get((name, symbol.element_hash()))
            unit, text = (told.unit, told.description) if told else ("", "")
            causality, variability = kinds[self.given.roles[k]]
            yield Variable(
                name, self.parameters + k, causality, variability, "exact", unit, float(self.given.values[k]), text
            )

    def _of_states(self, seen: list[Seen]) -> Iterator[Variable]:
        r, x = self.compiled.reduced, self.beginning.at.x
        known = {s.name: s for s in seen}
        named = {(s.name, s.expression.element_hash()) for s in seen if not s.output}
        jumping = self._jumping()
        for k, (symbol, name) in enumerate(zip(scalars(r.x), r.states, strict=True)):
            # In closed loops the integrated state is projected: the projected coordinate has the name in the model.
            own = name if name not in known or (name, symbol.element_hash()) in named else f"integrated.{name}"
            about = known.get(name)
            unit, text = (about.unit, about.description) if about else ("", "")
            starts = k in self.beginning.starts
            yield Variable(
                *(own, self.states[k], "local", "continuous", "exact" if starts else "calculated", unit),
                *(float(x[k]) if starts else None, text, float(self.nominal[k])),
                reinit=k in jumping,
            )
            rate = f"{unit}/s" if unit else ""
            # Where the derivative is a state as well, its own name is that of the state.
            named_rate = f"der({own})" if f"der({own})" not in r.states else f"der({own},1)"
            yield Variable(
                *(named_rate, self.rates[k], "local", "continuous", "calculated", rate, None),
                derivative_of=self.states[k],
            )

    def _jumping(self) -> set[int]:
        """States that an event may change; in closed loops, all states of the loops."""
        guards = self.compiled.guards
        places = [to for k, g in enumerate(guards.guards) if g.jumps for to in guards.jump(k)[1]]
        direct = {place for is_state, place in places if is_state}
        return direct | set(self.compiled.constraints.states.tolist() if direct else [])

    def _of_seen(self, seen: list[Seen]) -> Iterator[Variable]:
        r, places = self.compiled.reduced, dict[int, int]()
        state = {s.element_hash(): k for k, s in enumerate(scalars(r.x))}
        own = {(r.p[k].element_hash(), name) for k, name in enumerate(r.flat.parameters.names)}
        moving = {s.element_hash() for s in [*scalars(ca.vertcat(r.x, r.z)), time.sx]}
        zeros = set(r.flat.stays_zero)
        for one in seen:
            key = one.expression.element_hash()
            if not one.output and one.name in zeros:
                self.shown.append(one.expression)
                place = self.first_shown + len(self.shown) - 1
                yield Variable(one.name, place, "local", "constant", "exact", one.unit, 0.0, one.description)
                continue
            if not one.output and (one.expression.is_constant() or (key, one.name) in own or one.name == "time"):
                continue
            if not one.output and key in state:
                if one.name != r.states[state[key]]:
                    yield Variable(
                        *(one.name, self.states[state[key]], "local", "continuous", "calculated", one.unit, None),
                        description=one.description,
                    )
                continue
            if one.output or key not in places:
                self.shown.append(one.expression)
                place = self.first_shown + len(self.shown) - 1
                if not one.output:
                    places[key] = place
            else:
                place = places[key]
            moves = any(s.element_hash() in moving for s in ca.symvar(one.expression))
            yield Variable(
                *(one.name, place, "output" if one.output else "local", "continuous" if moves else self._still(one)),
                *("calculated", one.unit, None, one.description),
            )

    def _still(self, one: Seen) -> Variability:
        """Return the variability of variables that change only at events."""
        roles = {s.element_hash(): r for s, r in zip(scalars(self.given.symbols), self.given.roles, strict=True)}
        found = {roles.get(s.element_hash(), Role.INPUT) for s in ca.symvar(one.expression)}
        if one.output or Role.INPUT in found:
            return "discrete"
        return "tunable" if Role.TUNABLE in found else "fixed"


def _seen(compiled: CompiledModel) -> Iterator[Seen]:
    """Return all scalars of a model by name, as expressions of states, algebraic unknowns, parameters, time and constants."""
    tree, found = compiled.tree, list[Seen]()
    owners = {component._path: component for component in walk(tree)}
    for path in names(tree):
        quantity = find(tree, path)
        owner, _, name = path.rpartition(".")
        text = getattr(owners[owner].fields[name], "description", "")
        column = scalars(dense(quantity.column))
        index = {name: k for k, name in enumerate(_names_in_columns(quantity.entries, quantity.shape))}
        for _, entry, unit in quantity.entries:
            output = not owner and isinstance(tree.fields[name], f.Variable) and name in compiled.outputs
            found.append(Seen(entry, unit, text, column[index[entry]], output))
    resolved = scalars(dense(compiled.reduced.running.resolve(stacked([s.expression for s in found]))))
    for one, expression in zip(found, resolved, strict=True):
        yield replace(one, expression=expression)


def _names_in_columns(entries: list[tuple[tuple[int, ...], str, str]], shape: tuple[int, ...]) -> list[str]:
    """Return the names of the entries in column-major order."""
    return [name for _, name, _ in sorted(entries, key=lambda entry: entry[0][::-1])] if shape else [entries[0][1]]
