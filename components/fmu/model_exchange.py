"""ModelExchange: an FMU for Model Exchange as a part."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from itertools import islice
from typing import Any, ClassVar

from acausal import Component, Scalar, as_expr, call, der, discrete, external, piecewise, reinit, time, variable, when
from components.fmu.dynamics import Dynamics
from components.fmu.exchange_events import Event, StartFunction
from components.fmu.exchange_function import ExchangeFunction
from components.fmu.interface import Interface

KEPT = "kept"
CHANGED = 1e-12  # sum of the squares of changes of sides and discrete inputs since the last event: 0, or 1 and more


class ModelExchange(Component):
    """FMU for Model Exchange, with its inputs, outputs and parameters as fields, whose equations join those of the model.

    `states` are its continuous states, in its own units. Its outputs have derivatives for the solver, by its directional
    derivatives or by differences, but none that an equation may hold: where the model needs der() of an output, let it return a
    force and take a motion. An event is where an event indicator changes its sign, a discrete input changes, or the FMU has
    announced it.
    """

    mode: Scalar = discrete("event mode", start=-1)
    met: Scalar = discrete("event mode whose states are taken over", start=-1)
    next_event: Scalar = discrete("next time event", unit="s", start=time)
    interface: ClassVar[Interface]
    rebuild: ClassVar[Callable[..., Any]]  # from what its class is made of
    dynamics: ClassVar[Dynamics]
    states: ClassVar[Any]
    kept: ClassVar[Any]

    def equations(self):
        own, function = self.dynamics, self._function
        u, d, p = self._given
        nx, ny, nz = len(own.states), len(own.outputs), own.indicators
        x = [self.states[k] for k in range(nx)]
        for k, needs in enumerate(own.needs):
            known = [value if needed else None for value, needed in zip(u, needs, strict=True)]
            value = external(function, [self.mode, time, *x, *known, *d, *p], [k])[0]
            if k < nx:
                yield der(x[k]) == value
            else:
                signal = own.outputs[k - nx]
                yield getattr(self, signal.field) == signal.factor * value + signal.offset

        after, held, seen = self._parts_of_kept
        for signal, value in zip(own.discrete_outputs, held, strict=True):
            yield getattr(self, signal.field) == value
        everything = [self.mode, time, *x, *u, *d, *p]
        z = external(function, everything, range(nx + ny, nx + ny + nz))
        sides = [piecewise((1, z[k] > 0), 0) for k in range(nz)]
        moved = [(now - before) ** 2 for now, before in zip([*sides, *d], seen, strict=True)]
        moved += [external(function, everything, [nx + ny + nz])[0]] if own.completes else []
        due = time >= self.next_event
        results = [self.mode, self.next_event, *([self.kept] if KEPT in self.fields else [])]
        act = call(Event(function), [as_expr(everything), *([as_expr(sides)] if sides else [])], results)
        yield when(due | (sum(moved) > CHANGED) if moved else due, act, at_start=True)
        if nx:
            taken = [reinit(x[k], after[k]) for k in range(nx)]
            yield when(self.mode - self.met > 0.5, *taken, reinit(self.met, self.mode))

    def initial_equations(self):
        if nx := len(self.dynamics.states):
            u, d, p = self._given
            yield self.states == external(StartFunction(self._function), [time, *u, *d, *p], range(nx))

    @cached_property
    def _function(self) -> ExchangeFunction:
        """The FMU, one instance for each part of a built model."""
        return ExchangeFunction(self.interface)

    @property
    def _given(self) -> tuple[list[Any], list[Any], list[Any]]:
        """Continuous and discrete inputs in the units of the FMU, and parameters."""
        own = self.dynamics
        u, d = (
            [(getattr(self, s.field) - s.offset) / s.factor for s in part] for part in (own.inputs, own.discrete_inputs)
        )
        return u, d, [getattr(self, s.field) for s in self.interface.parameters]

    @property
    def _parts_of_kept(self) -> list[list[Any]]:
        """States after the last event, discrete outputs, and sides of the indicators with discrete inputs before it."""
        own = self.dynamics
        sizes = len(own.states), len(own.discrete_outputs), own.indicators + len(own.discrete_inputs)
        entries = iter(range(sum(sizes)))
        return [[self.kept[k] for k in islice(entries, n)] for n in sizes]

    def __reduce__(self) -> Any:
        return self.rebuild, (self.interface,), self.__dict__


def fields_of(own: Dynamics) -> dict[str, Any]:
    """Return the fields of an FMU besides its inputs, outputs and parameters."""
    found: dict[str, Any] = {}
    if n := len(own.states):
        names = ", ".join(signal.name for signal in own.states)
        start, nominal = ([getattr(s, name) for s in own.states] for name in ("raw", "nominal"))
        found["states"] = variable(
            f"continuous states: {names}", shape=(n,), start=tuple(start), nominal=tuple(nominal)
        )
    if n := n + len(own.discrete_outputs) + own.indicators + len(own.discrete_inputs):
        found[KEPT] = discrete("states, discrete outputs, and what events watch, at the last event", shape=(n,))
    return found
