"""Kinds of statements and their methods, and messages for misplaced statements."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal.errors import AcausalError, ConnectError, DeclarationError
from acausal.language.component import Component
from acausal.language.condition import Condition
from acausal.language.connection import Branch, Connect, Root
from acausal.language.expression import Equation, Expr
from acausal.language.fields import InitialValue
from acausal.language.set_valued_statement import SetValued
from acausal.language.validity_statements import Expectation, Requirement, Separation
from acausal.language.value_checks import shown
from acausal.language.when_statements import Reinit, When

# Class of a statement -> its text in messages, and the method that yields it.
STATEMENT_KINDS: dict[type, tuple[str, str]] = {
    Equation: ("an equation", "equations()"),
    When: ("when(...)", "equations()"),
    SetValued: ("set_valued(...)", "equations()"),
    Connect: ("connect(...)", "connections()"),
    Branch: ("branch(...)", "connections()"),
    Root: ("root(...)", "connections()"),
    Requirement: ("require(...)", "requirements()"),
    Expectation: ("expect(...)", "validity()"),
    Separation: ("apart(...)", "validity()"),
}
TAKES = {
    "equations": "equations such as `a == b`",
    "initial_equations": "equations such as `a == b`",
    "root_equations": "equations such as `a == b`",
    "connections": "connect(...), chain(...), branch(...), root(...) or potential_root(...)",
    "requirements": "require(...)",
    "validity": "expect(...) or apart(...)",
}
BARE = {
    "requirements": 'yield require(a < b, "message if it does not hold")',
    "validity": 'yield expect(part, whole, 0.01, "what is neglected")',
}


def misplaced_message(statement: Any, method: str) -> str:
    """Return the message for a statement that a method must not yield.

    Parameters
    ----------
    statement : object
        The yielded statement.
    method : str
        Name of the method.
    """
    takes = TAKES.get(method, TAKES["equations"])
    several = isinstance(statement, list | tuple) and bool(statement)
    first = statement[0] if several and isinstance(statement[0], Connect | Equation) else statement
    for kind, (word, home) in STATEMENT_KINDS.items():
        takes_it = kind is Equation and ("equations" in method or method in BARE)
        if isinstance(first, kind) and home != f"{method}()" and not takes_it:
            return f"{method}() yields {word}, which belongs to {home}: write it there."
    if isinstance(first, Condition | Equation) and method in BARE:
        word = "an equation" if isinstance(first, Equation) else "a bare inequality"
        return f"{method}() yields {word}; write {BARE[method]}."
    what, remedy = _described(statement, method)
    return f"{method}() yields {what}; yield {takes}.{f' {remedy}' if remedy else ''}"


def error_of(statement: Any) -> type[AcausalError]:
    """Return the class of the error for a misplaced statement."""
    first = statement[0] if isinstance(statement, list | tuple) and statement else statement
    return ConnectError if isinstance(first, Connect | Branch | Root) else DeclarationError


def _described(statement: Any, method: str) -> tuple[str, str]:
    """Return the words for an invalid statement, and the remedy."""
    if isinstance(statement, bool):
        if method == "connections":
            return f"{statement}", "Ports are joined by connect(a, b), not by `==`."
        remedy = "Its `==` compares plain values or parts: one side must be a variable, self.x or self.part.x."
        return f"{statement}", remedy
    if isinstance(statement, Condition):
        remedy = 'Yield requirements in requirements(): require(a < b, "..."); jumps are when(a < b, reinit(...)).'
        return "an inequality", remedy
    if isinstance(statement, Reinit):
        return "reinit(...) alone", "Say when it happens: when(condition, reinit(variable, value))."
    if isinstance(statement, InitialValue):
        return "fixed(...) or guess(...)", "Here a start value is an equation, self.x == ..., in initial_equations()."
    if isinstance(statement, Iterator) or (
        isinstance(statement, list | tuple) and all(isinstance(s, Equation) for s in statement)
    ):
        return "several at once", "Write `yield from` instead of `yield`."
    if isinstance(statement, tuple) and any(isinstance(s, Expr) for s in statement):
        return "values with a comma between them", "Each equation has its own `yield`."
    if statement is None:
        return "nothing", ""
    if isinstance(statement, Component | Expr):
        return repr(statement) if isinstance(statement, Component) else statement._shown(), ""
    return shown(statement), ""


def returned_message(value: Any, method: str) -> str:
    """Return the message for a method that returns statements instead of yielding them."""
    if value is None:
        return f"{method}() yields nothing: write `yield` before each statement, or leave the method out."
    word = next((word for kind, (word, _) in STATEMENT_KINDS.items() if isinstance(value, kind)), shown(value))
    return f"{method}() returns {word}; write `yield`, not `return`."
