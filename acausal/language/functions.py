"""Functions of expressions; with a field of a class body they are deferred until the model is built."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar
from fractions import Fraction
from functools import partial, wraps
from typing import Any

import casadi as ca

from acausal.errors import DeclarationError, UnitsError
from acausal.language import unit_rules
from acausal.language.arguments import told
from acausal.language.condition import Condition, refuse_cases
from acausal.language.events import When
from acausal.language.expression import Expr, as_expr, entrywise, is_deferred
from acausal.language.fields import Deferred
from acausal.language.written import kind_of
from acausal.symbols import scalars, vec
from acausal.units import DIMENSIONLESS, Dimension, parse

_SECOND = parse("s")
# Without a unit, so that sin(time) is right for users who mean rad/s times time.
time = Expr(ca.SX.sym("time"), None, "time")
initial = Expr(ca.SX.sym("initial"), DIMENSIONLESS, "initial")
# How fast states return to an invariant that they must keep (Baumgarte 1972): ten times in a run.
feedback = Expr(ca.SX.sym("feedback"), DIMENSIONLESS / _SECOND, "feedback")


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

    def switch(self, condition: Condition) -> ca.SX:
        """Return the switch of a condition, the same for the same condition; one on discrete variables is its own."""
        if not self.watches or all(s.element_hash() in self.discrete for s in ca.symvar(condition.excess.sx)):
            return _truth(condition)
        for switch, other in self.switches:
            if other.kind == condition.kind and ca.is_equal(other.excess.sx, condition.excess.sx, 9):
                return switch
        self.switches.append((ca.SX.sym("switch"), condition))
        return self.switches[-1][0]

    def place(self, origin: Any) -> None:
        """Record where the switches and derivatives requested since the last call come from."""
        self.places += [origin] * (len(self.switches) - len(self.places))
        self.sources += [origin] * (len(self.differentiated) - len(self.sources))
        self.promised += [origin] * (len(self.promises) - len(self.promised))

    def promise(self, steps: list[tuple[Condition, ca.SX]], value: ca.SX) -> None:
        """Note the steps of a smooth law from each case to the next; an earlier case that holds hides them."""
        hidden = ca.SX(0)
        for condition, step in steps if self.watches else ():
            self.promises.append((condition, vec(ca.if_else(hidden, 0, step)), vec(value)))
            hidden = ca.logic_or(hidden, _truth(condition))

    def differentiate(self, x: ca.SX) -> ca.SX:
        """Return a placeholder for the derivative of an expression."""
        placeholder = ca.SX.sym("der", *x.shape)
        self.derivatives.append((placeholder, x))
        switching = self.discrete | {switch.element_hash() for switch, _ in self.switches}
        if switching and any(s.element_hash() in switching for s in ca.symvar(x)):
            self.differentiated.append(x)
        return placeholder


def _truth(condition: Condition) -> ca.SX:
    return condition.holds(condition.excess.sx)


PENDING: ContextVar[Pending] = ContextVar("pending")


def _pending(what: str) -> Pending:
    try:
        return PENDING.get()
    except LookupError:
        raise DeclarationError(f"{what} can be used inside equations() only.") from None


def _deferrable(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def call(*arguments: Any) -> Any:
        if is_deferred(*arguments):
            return Deferred(call, arguments)
        return function(*arguments)

    return told(call)


def _elementary(name: str, operate: Callable[[ca.SX], ca.SX]) -> Callable[[Any], Any]:
    def function(x: Any) -> Expr:
        x = as_expr(x)
        if isinstance(x.unit, Dimension) and x.unit != DIMENSIONLESS:
            raise UnitsError(f"{name} needs a number or an angle, but {x!r} is in [{x.unit}].")
        return Expr(operate(x.sx), DIMENSIONLESS if x.unit is not None else None, shape=x.shape)

    function.__name__ = function.__qualname__ = name
    function.__doc__ = f"{name.capitalize()} of an expression, entry by entry; the argument is dimensionless or in rad."
    return _deferrable(function)


sin = _elementary("sin", ca.sin)
cos = _elementary("cos", ca.cos)
tan = _elementary("tan", ca.tan)
asin = _elementary("asin", ca.asin)
acos = _elementary("acos", ca.acos)
exp = _elementary("exp", ca.exp)
log = _elementary("log", ca.log)
tanh = _elementary("tanh", ca.tanh)


@_deferrable
def sqrt(x: Any) -> Any:
    """Square root of an expression, entry by entry."""
    x = as_expr(x)
    return Expr(ca.sqrt(x.sx), unit_rules.of_power(x, Fraction(1, 2)), shape=x.shape)


@_deferrable
def sign(x: Any) -> Any:
    """Sign of an expression, entry by entry: -1, 0 or 1; the integration stops where it changes."""
    x, pending = as_expr(x), PENDING.get(None)
    if x.sx.is_constant():
        return Expr(ca.sign(x.sx), DIMENSIONLESS, shape=x.shape)
    if pending is None:
        return Deferred(sign, (x,))
    entries = [_watched_sign(Expr(entry), pending) for entry in scalars(x.sx)]
    return Expr(ca.reshape(ca.vertcat(*entries), *x.sx.shape), DIMENSIONLESS, shape=x.shape)


def _watched_sign(x: Expr, pending: Pending) -> ca.SX:
    return pending.switch(Condition(-x, "<")) - pending.switch(Condition(x, "<"))


@_deferrable
def absolute(x: Any) -> Any:
    """Absolute value of an expression, entry by entry: what abs(x) gives.

    Its value is continuous, so that only a law of time alone stops the integration at its kinks.
    """
    x, pending = as_expr(x), PENDING.get(None)
    symbols = {s.element_hash() for s in ca.symvar(x.sx)}
    if time.sx.element_hash() not in symbols or (pending is not None and symbols & pending.varying):
        return Expr(ca.fabs(x.sx), x.unit, shape=x.shape)
    if pending is None:
        return Deferred(absolute, (x,))
    entries = [piecewise((-entry, entry < 0), entry).sx for entry in map(Expr, scalars(x.sx))]
    return Expr(ca.reshape(ca.vertcat(*entries), *x.sx.shape), x.unit, shape=x.shape)


@_deferrable
def atan2(y: Any, x: Any) -> Any:
    """Angle of the point (x, y) in rad, in (-pi, pi]."""
    y, x = as_expr(y), as_expr(x)
    shape = entrywise(y, "and", x)
    unit_rules.common(y, x, "the arguments of atan2")
    return Expr(ca.atan2(y.sx, x.sx), DIMENSIONLESS, shape=shape)


@_deferrable
def dot(a: Any, b: Any) -> Any:
    """Scalar product of two vectors, both resolved in the same frame."""
    return as_expr(a) @ as_expr(b)


@_deferrable
def cross(a: Any, b: Any) -> Any:
    """Vector product of two vectors of length 3, both resolved in the same frame."""
    a, b = as_expr(a), as_expr(b)
    if a.shape != (3,) or b.shape != (3,):
        raise DeclarationError(f"cross needs two vectors of length 3, not {kind_of(a.shape)} and {kind_of(b.shape)}.")
    one = isinstance(a.unit, Dimension | None) and isinstance(b.unit, Dimension | None)
    return Expr(ca.cross(a.sx, b.sx), unit_rules.of_product(a, b) if one else None)


@told
def quantity(value: Any, unit: str) -> Expr:
    """Return a constant with a unit, where a number alone would be a pure number.

    Parameters
    ----------
    value : float or array
        The value in SI.
    unit : str
        SI unit of every entry.

    Examples
    --------
    >>> yield self.f == quantity(100, "N/m") * self.s  # doctest: +SKIP
    """
    if isinstance(value, str) or not isinstance(unit, str):
        raise DeclarationError(
            f'a quantity is a number and its unit, quantity(100, "N/m"), not quantity({value!r}, {unit!r}).'
        )
    number = as_expr(value)
    return Expr(number.sx, parse(unit), shape=number.shape)


@told
def der(x: Any) -> Any:
    """Time derivative of an expression.

    Parameters
    ----------
    x : Expr
        Any expression of variables, parameters and time.

    Returns
    -------
    Expr
        Derivative, of the shape of `x`, its unit divided by s.
    """
    pending = _pending("der()")
    x = as_expr(x)
    placeholder = pending.differentiate(x.sx)
    if isinstance(x.unit, tuple):
        unit: Any = tuple(None if u is None else u / _SECOND for u in x.unit)
    else:
        unit = x.unit / _SECOND if x.unit is not None else None
    return Expr(placeholder, unit, f"der({x.name})" if x.name else "", x.shape)


@told
def piecewise(*cases: Any, smooth: bool = False) -> Any:
    """Value of the first case whose condition holds.

    Parameters
    ----------
    *cases : (value, Condition) pairs, then a value
        The last argument, without a condition, is the value otherwise. Where a condition compares `time` with an expression
        of parameters, alone or joined with others, the instant is a break time: the integration stops there exactly.
        Any other condition is watched: the integration stops where it changes, located to about the tolerance.
    smooth : bool
        True promises that value and first two derivatives are continuous, so that no stop is needed. A run in which
        the value jumps nevertheless ends with a warning.

    Returns
    -------
    Expr
        The value, all cases having one shape.

    Examples
    --------
    >>> torque = piecewise((0.01 * (1 - exp(-time / 0.167)), time <= 0.7), 0)  # doctest: +SKIP
    """
    refuse_cases(cases)
    flat = [item for case in cases[:-1] for item in (case[0], case[1].excess)] + [cases[-1]]
    if is_deferred(*flat) or (not smooth and PENDING.get(None) is None):
        return Deferred(partial(piecewise, smooth=smooth), cases)
    value = otherwise = as_expr(cases[-1])
    steps: list[tuple[Condition, ca.SX]] = []
    for choice, condition in reversed(cases[:-1]):
        choice = as_expr(choice)
        if choice.shape != value.shape:
            raise DeclarationError(
                f"the cases of piecewise differ in shape: {kind_of(choice.shape)} and {kind_of(value.shape)}."
            )
        last = Expr(otherwise.sx, value.unit, otherwise.name, value.shape)
        unit = unit_rules.common(choice, last, "cases of a piecewise")
        steps.insert(0, (condition, choice.sx - value.sx))
        holds = _truth(condition) if smooth else _pending("piecewise").switch(condition)
        value = Expr(ca.if_else(holds, choice.sx, value.sx), unit, shape=value.shape)
    if smooth and (pending := PENDING.get(None)):
        pending.promise(steps, value.sx)
    return value
