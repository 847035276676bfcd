"""Requests of equations while a model is flattened: derivatives, switches and jumps."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

import casadi as ca

from acausal.errors import DeclarationError
from acausal.language.condition import Condition
from acausal.language.when_statements import When
from acausal.symbols import Distinct, scalars, vec


class Pending:
    """Requests of equations while a model is flattened: derivatives, switches and jumps.

    `derivatives` contains (placeholder, expression); all derivatives are formed in one call later.
    `switches` contains (switch, condition): a switch is 1 while its condition holds; `switch_origins` contains their
    origins. `whens` contains event statements, `laws` set-valued laws, each with its origin.
    `discrete` and `varying` contain the hashes of the symbols of discrete and of all variables, once these exist.
    `watches` is False while start values are formed, which need no switches.
    `differentiated` contains the operands of der() that depend on switches, `derivative_origins` their origins.
    `smooth_steps` contains (condition, step, value) of smooth laws, `smooth_origins` their origins: where the condition
    changes, the step between two cases should be 0.
    `tables` contains (symbol, table, raised): the symbol of the number of its first column, another one within der();
    `kinks` contains (symbol, time): the next point, after time, of a table of time. `memories` contains
    (variable, start) of discrete variables without a field.
    """

    def __init__(self) -> None:
        self.derivatives: list[tuple[ca.SX, ca.SX]] = []
        self.switches: list[tuple[ca.SX, Condition]] = []
        self.switch_origins: list[Any] = []
        self.whens: list[tuple[When, Any]] = []
        self.laws: list[tuple[Any, Any]] = []
        self.discrete: set[int] = set()
        self.varying: set[int] = set()
        self.watches = True
        self.differentiated: list[ca.SX] = []
        self.derivative_origins: list[Any] = []
        self.smooth_steps: list[tuple[Condition, ca.SX, ca.SX]] = []
        self.smooth_origins: list[Any] = []
        self.tables: list[tuple[ca.SX, Any, bool]] = []
        self.kinks: list[tuple[ca.SX, ca.SX]] = []
        self.memories: list[tuple[Any, ca.SX]] = []
        self._unplaced: list[When] = []
        self._conditions = Distinct()
        self._switching: set[int] = set()

    def switch(self, condition: Condition) -> ca.SX:
        """Return the switch of a condition, one for equal conditions; a condition on discrete variables needs none."""
        if not self.watches or all(s.element_hash() in self.discrete for s in ca.symvar(condition.excess.sx)):
            return truth(condition)
        number = self._conditions.number(condition.excess.sx, condition.kind)
        if number == len(self.switches):
            self.switches.append((ca.SX.sym("switch"), condition))
            self._switching.add(self.switches[-1][0].element_hash())
        return self.switches[number][0]

    def place(self, origin: Any) -> None:
        """Record the origin of the requests since the last call."""
        self.switch_origins += [origin] * (len(self.switches) - len(self.switch_origins))
        self.derivative_origins += [origin] * (len(self.differentiated) - len(self.derivative_origins))
        self.smooth_origins += [origin] * (len(self.smooth_steps) - len(self.smooth_origins))
        self.whens += [(when, origin) for when in self._unplaced]
        self._unplaced.clear()

    def add_smooth_law(self, conditions: list[Condition], laws: list[ca.SX], value: ca.SX) -> None:
        """Record the steps of a smooth law between consecutive cases, 0 where an earlier case holds."""
        if not self.watches:
            return
        truths, steps, later = [truth(condition) for condition in conditions], list[ca.SX](), laws[-1]
        for holds, law in zip(reversed(truths), reversed(laws[:-1]), strict=True):
            steps.append(law - later)
            later = ca.if_else(holds, law, later)
        hidden = ca.SX(0)
        for condition, holds, step in zip(conditions, truths, reversed(steps), strict=True):
            self.smooth_steps.append((condition, vec(ca.if_else(hidden, 0, step)), vec(value)))
            hidden = ca.logic_or(hidden, holds)

    def table(self, data: Any, raised: bool = False) -> ca.SX:
        """Return the symbol of the number of the first column of a table; another one within der()."""
        known = next((symbol for symbol, *own in self.tables if own[0] is data and own[1] == raised), None)
        if known is None:
            name = data.path or f"table {len(self.tables) + 1}"
            self.tables.append((known := ca.SX.sym(f"der of {name}" if raised else name), data, raised))
        return known

    def remember(self, variables: list[Any], starts: list[ca.SX], *whens: When) -> None:
        """Add discrete variables without a field, and what changes them."""
        self.memories += zip(variables, starts, strict=True)
        own = {variable.sx.element_hash() for variable in variables}
        self.discrete |= own
        self.varying = self.varying | own
        self._unplaced += whens

    def value(self, key: Any, compute: Callable[[], Any]) -> Any:
        """Return an observed value; its requests are recorded each time."""
        return compute()

    def differentiate(self, x: ca.SX) -> ca.SX:
        """Return a placeholder for the derivative of an expression."""
        placeholder = ca.SX.sym("der", *x.shape)
        x = self._with_raised_tables(x) if self.tables else x
        self.derivatives.append((placeholder, x))
        if any(s.element_hash() in known for s in ca.symvar(x) for known in (self.discrete, self._switching)):
            self.differentiated.append(x)
        return placeholder

    def _with_raised_tables(self, x: ca.SX) -> ca.SX:
        """Return an operand of der() with symbols of its own for tables, by which reduction tells their derivatives."""
        inside = {s.element_hash() for s in ca.symvar(x)}
        within = [
            e for placeholder, e in self.derivatives if any(s.element_hash() in inside for s in scalars(placeholder))
        ]
        inside |= {s.element_hash() for e in within for s in ca.symvar(e)}
        for symbol, data, raised in [own for own in self.tables if own[0].element_hash() in inside]:
            if raised and data.kind == "linear":
                raise DeclarationError(
                    f'der(der(...)) of {data!r} is infinite at its points. Give it kind="akima" or "cubic".'
                )
            above = symbol if raised else self.table(data, raised=True)
            x = ca.substitute(x, symbol, above)
            self.kinks += [(above, ca.substitute(after, symbol, above)) for own, after in self.kinks if own is symbol]
        return x


def truth(condition: Condition) -> ca.SX:
    """Return 1 where a condition holds and 0 elsewhere, without a switch."""
    return condition.holds(condition.excess.sx)


PENDING: ContextVar[Pending] = ContextVar("pending")


def pending_for(what: str) -> Pending:
    """Return the current requests; raise DeclarationError, naming `what`, outside equations()."""
    try:
        return PENDING.get()
    except LookupError:
        raise _only_in_equations(what) from None


class _Reading(Pending):
    """Requests while values are read: conditions are evaluated without switches, derivatives are invalid."""

    def __init__(self) -> None:
        super().__init__()
        self.watches = False
        self._values: dict[Any, Any] = {}

    def value(self, key: Any, compute: Callable[[], Any]) -> Any:
        """Return a value that is formed once."""
        if key not in self._values:
            self._values[key] = compute()
        return self._values[key]

    def differentiate(self, x: ca.SX) -> ca.SX:
        raise _only_in_equations("der()")


@contextmanager
def reading() -> Iterator[Pending]:
    """Form expressions of a built model for reading, without requests; within equations() requests are recorded.

    Within one outer `reading()` each observed value is formed once.
    """
    token = PENDING.set(PENDING.get(None) or _Reading())
    try:
        yield PENDING.get()
    finally:
        PENDING.reset(token)


def _only_in_equations(what: str) -> DeclarationError:
    return DeclarationError(f"{what} can be used inside equations() only.")
