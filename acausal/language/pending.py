"""What equations request while a model is flattened: derivatives, switching conditions and jumps."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

import casadi as ca

from acausal.errors import DeclarationError
from acausal.language.condition import Condition
from acausal.language.when_statements import When
from acausal.symbols import Distinct, vec


class Pending:
    """What equations request while a model is flattened: derivatives, switching conditions and jumps.

    `derivatives` holds (placeholder, expression); the derivatives of all of them are formed in one call later.
    `switches` holds (switch, condition): a switch is 1 while its condition holds; `places` says where each is stated.
    `whens` holds the statements of jumps and where they are stated, `discrete` the symbols of discrete variables.
    `laws` holds the set-valued laws and where they are stated.
    `varying` holds the symbols of variables, as soon as there are any.
    `watches` is false while start values are formed, which need no switches.
    `differentiated` holds the expressions of der() that depend on switches, `sources` where each is stated.
    `promises` holds (condition, step, value) of smooth switches, `promised` where each is stated: where the condition
    changes, the step from one case to the next should be 0.
    """

    def __init__(self) -> None:
        self.derivatives: list[tuple[ca.SX, ca.SX]] = []
        self.switches: list[tuple[ca.SX, Condition]] = []
        self.places: list[Any] = []
        self.whens: list[tuple[When, Any]] = []
        self.laws: list[tuple[Any, Any]] = []
        self.discrete: set[int] = set()
        self.varying: set[int] = set()
        self.watches = True
        self.differentiated: list[ca.SX] = []
        self.sources: list[Any] = []
        self.promises: list[tuple[Condition, ca.SX, ca.SX]] = []
        self.promised: list[Any] = []
        self._conditions = Distinct()
        self._switching: set[int] = set()

    def switch(self, condition: Condition) -> ca.SX:
        """Return the switch of a condition, the same for the same condition; one on discrete variables is its own."""
        if not self.watches or all(s.element_hash() in self.discrete for s in ca.symvar(condition.excess.sx)):
            return truth(condition)
        number = self._conditions.number(condition.excess.sx, condition.kind)
        if number == len(self.switches):
            self.switches.append((ca.SX.sym("switch"), condition))
            self._switching.add(self.switches[-1][0].element_hash())
        return self.switches[number][0]

    def place(self, origin: Any) -> None:
        """Record where the switches and derivatives requested since the last call come from."""
        self.places += [origin] * (len(self.switches) - len(self.places))
        self.sources += [origin] * (len(self.differentiated) - len(self.sources))
        self.promised += [origin] * (len(self.promises) - len(self.promised))

    def promise(self, conditions: list[Condition], laws: list[ca.SX], value: ca.SX) -> None:
        """Note the steps of a smooth law from each case to the next that holds; an earlier case that holds hides them."""
        if not self.watches:
            return
        truths, steps, later = [truth(condition) for condition in conditions], list[ca.SX](), laws[-1]
        for holds, law in zip(reversed(truths), reversed(laws[:-1]), strict=True):
            steps.append(law - later)
            later = ca.if_else(holds, law, later)
        hidden = ca.SX(0)
        for condition, holds, step in zip(conditions, truths, reversed(steps), strict=True):
            self.promises.append((condition, vec(ca.if_else(hidden, 0, step)), vec(value)))
            hidden = ca.logic_or(hidden, holds)

    def differentiate(self, x: ca.SX) -> ca.SX:
        """Return a placeholder for the derivative of an expression."""
        placeholder = ca.SX.sym("der", *x.shape)
        self.derivatives.append((placeholder, x))
        if any(s.element_hash() in known for s in ca.symvar(x) for known in (self.discrete, self._switching)):
            self.differentiated.append(x)
        return placeholder


def truth(condition: Condition) -> ca.SX:
    """Return 1 where a condition holds and 0 elsewhere, without a switch."""
    return condition.holds(condition.excess.sx)


PENDING: ContextVar[Pending] = ContextVar("pending")


def pending_for(what: str) -> Pending:
    """Return what is pending; outside equations() DeclarationError for `what` was used."""
    try:
        return PENDING.get()
    except LookupError:
        raise _only_in_equations(what) from None


class _Reading(Pending):
    """Nothing can be requested any more: conditions are evaluated as they are, derivatives are refused."""

    def __init__(self) -> None:
        super().__init__()
        self.watches = False

    def differentiate(self, x: ca.SX) -> ca.SX:
        raise _only_in_equations("der()")


@contextmanager
def reading() -> Iterator[None]:
    """Form expressions of a built model that are read, not solved; within equations() they are as everything else there."""
    token = PENDING.set(PENDING.get(None) or _Reading())
    try:
        yield
    finally:
        PENDING.reset(token)


def _only_in_equations(what: str) -> DeclarationError:
    return DeclarationError(f"{what} can be used inside equations() only.")
