"""Event conditions, discrete variables, smooth laws and set-valued laws of a flat model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi as ca

from acausal.errors import DeclarationError
from acausal.flatten.component_tree import join
from acausal.flatten.field_values import shape_of, unit_of
from acausal.flatten.origin import Origin, value_origin, with_place
from acausal.language import fields as f
from acausal.language import unit_rules
from acausal.language.component import Component
from acausal.language.condition import Condition
from acausal.language.expression import Expr, as_expr
from acausal.language.pending import PENDING, Pending
from acausal.language.quantities import plain
from acausal.language.when_statements import Call
from acausal.symbols import dense, scalars, stacked, vec

Resolve = Callable[[list[ca.SX]], list[ca.SX]]


@dataclass(frozen=True)
class Discrete:
    """A declared discrete variable with its symbols."""

    expr: Expr
    declared: f.Variable
    owner: Component

    def start(self) -> ca.SX:
        """Return the initial value, a column; the variables of the owner must exist."""
        given = self.owner._values.get(self.declared.name)
        value = given.value if isinstance(given, f.InitialValue) else f.evaluate(self.declared.start, self.owner)
        given = as_expr(plain(value, self.expr.unit, f"start of `{self.expr.name}`"))
        sx = dense(vec(given.sx))
        size = self.expr.sx.numel()
        if sx.numel() not in (1, size):
            raise DeclarationError(f"start of `{self.expr.name}` has {sx.numel()} entries; it must have {size}.")
        if given.shape == self.expr.shape:
            unit_rules.common(self.expr, given, "its start value")
        return sx if sx.numel() == size else ca.repmat(sx, size, 1)


@dataclass(frozen=True)
class Jump:
    """A scalar that becomes `value` at an event; `discrete` is its number, or None if `target` is a state."""

    target: ca.SX
    value: ca.SX
    discrete: int | None


@dataclass(frozen=True)
class FunctionCall:
    """Call of a function of time and its arguments.

    The results are kept in discrete variables, numbers of which are `results`; at the next event `outputs` take them over,
    or are the same.
    """

    function: Callable[..., Any]
    arguments: tuple[ca.SX, ...]
    argument_shapes: tuple[tuple[int, ...], ...]
    result_shapes: tuple[tuple[int, ...], ...]
    results: tuple[int, ...]
    outputs: tuple[int, ...]


@dataclass(frozen=True)
class Guard:
    """An event condition: its indicator `excess` is negative while it holds; at 0 it holds if `inclusive`.

    The conditions of a model are those of its switches, then one for each `when`, with its jumps and calls.
    """

    condition: Condition
    origin: Origin
    jumps: tuple[Jump, ...] = ()
    at_start: bool = False
    calls: tuple[FunctionCall, ...] = ()

    @cached_property
    def excess(self) -> ca.SX:
        """Event indicator, negative while the condition holds."""
        return self.condition.excess.sx

    @property
    def inclusive(self) -> bool:
        """True if the condition holds at indicator 0."""
        return self.condition.kind == "<="


@dataclass(frozen=True)
class Law:
    """A set-valued law: speed, rate and limit, and the numbers of its discrete variables.

    These are `mode`, `offset`, `shared`, `share` and `slip`, in this order.
    """

    speed: ca.SX
    rate: ca.SX
    limit: ca.SX
    places: tuple[int, ...]
    origin: Origin


@dataclass(frozen=True)
class Promise:
    """A law that is declared smooth: where `excess` is 0, `step` should be 0; `value` is the law itself.

    A case holds where the excess is negative, and at 0 if `inclusive`; `compared` contains the excesses of its
    comparisons.
    """

    excess: ca.SX
    step: ca.SX
    value: ca.SX
    compared: ca.SX
    inclusive: bool
    origin: Origin

    def holds(self, excess: Any) -> Any:
        """Return whether the case holds, for an excess or an array of them."""
        return (excess < 0) | ((excess == 0) & self.inclusive)


def create_discretes(components: list[Component]) -> list[Discrete]:
    """Create the symbols of the discrete variables and set them as attributes of their components."""
    found = []
    for component in components:
        for name, declared in component.fields.items():
            if isinstance(declared, f.Variable) and declared.causality == "discrete":
                path = join(component._path, name)
                shape = shape_of(declared, component)
                expr = Expr(ca.SX.sym(path, *shape), unit_of(declared, component), path, shape)
                vars(component)[name] = expr
                found.append(Discrete(expr, declared, component))
                PENDING.get().discrete.update(s.element_hash() for s in scalars(expr.sx))
    return found


def discrete_starts(discretes: list[Discrete]) -> list[ca.SX]:
    """Return the initial values of the discrete variables, a column each."""
    PENDING.get().watches = False
    try:
        return [with_place(d.start, value_origin(d.owner, d.declared.name)) for d in discretes]
    finally:
        PENDING.get().watches = True


def promises(pending: Pending, resolve: Resolve) -> tuple[Promise, ...]:
    """Return the laws that are declared smooth; for the arguments see `guards`."""
    compared = [stacked(part.excess.sx for part in condition.comparisons) for condition, *_ in pending.smooth_steps]
    parts = zip(pending.smooth_steps, compared, strict=True)
    sx = iter(resolve([sx for (condition, *law), own in parts for sx in (condition.excess.sx, *law, own)]))
    return tuple(
        Promise(next(sx), next(sx), next(sx), next(sx), condition.kind == "<=", origin)
        for (condition, *_), origin in zip(pending.smooth_steps, pending.smooth_origins, strict=False)
    )


def guards(pending: Pending, discretes: list[Expr], resolve: Resolve) -> tuple[Guard, ...]:
    """Return the event conditions of switches and of `when` statements.

    Parameters
    ----------
    pending : Pending
        Requests of equations.
    discretes : list of Expr
        Discrete variables, in the order of their numbers.
    resolve : callable
        Replaces placeholders of derivatives.
    """
    place = _places(discretes)
    conditions = [condition for _, condition in pending.switches] + [when.condition for when, _ in pending.whens]
    excess = iter(resolve([part.excess.sx for condition in conditions for part in condition.comparisons]))
    conditions = [c.replaced(lambda part: Condition(Expr(next(excess)), part.kind)) for c in conditions]
    found = [
        Guard(c, origin) for c, origin in zip(conditions, pending.switch_origins, strict=False)
    ]  # one for each switch
    for condition, (when, origin) in zip(conditions[len(found) :], pending.whens, strict=True):
        jumps = []
        for jump in when.jumps:
            target, value = resolve([dense(vec(s.sx)) for s in (jump.variable, jump.value)])
            for t, v in zip(scalars(target), scalars(value), strict=True):
                jumps.append(Jump(t, v, place.get(t.element_hash()) if t.is_symbolic() else None))
        calls = tuple(_function_call(call, place, resolve, origin) for call in when.calls)
        found.append(Guard(condition, origin, tuple(jumps), when.at_start, calls))
    return tuple(found)


def _function_call(call: Call, place: dict[int, int], resolve: Resolve, origin: Origin) -> FunctionCall:
    numbers = []
    for group in (call.results, call.outputs):
        entries = [s for variable in group for s in scalars(dense(vec(variable.sx)))]
        numbers.append(tuple(place.get(s.element_hash(), -1) if s.is_symbolic() else -1 for s in entries))
    if -1 in (*numbers[0], *numbers[1]):
        raise DeclarationError(
            f'{origin}: the results of a call must be discrete variables. Declare them discrete("...").'
        )
    arguments = resolve([dense(vec(argument.sx)) for argument in call.arguments])
    shapes = tuple(a.shape for a in call.arguments), tuple(r.shape for r in call.results)
    return FunctionCall(call.function, tuple(arguments), *shapes, *numbers)


def laws(pending: Pending, discretes: list[Expr], resolve: Resolve) -> tuple[Law, ...]:
    """Return the set-valued laws; for the arguments see `guards`."""
    place, found = _places(discretes), list[Law]()
    sx = iter(resolve([e.sx for law, _ in pending.laws for e in (law.speed, law.rate, law.limit)]))
    for law, origin in pending.laws:
        own = (law.mode, law.offset, law.shared, law.share, law.slip)
        places = [place.get(e.sx.element_hash(), -1) for e in own]
        if -1 in places:
            raise DeclarationError(
                f"{origin}: set_valued needs discrete variables, but `{own[places.index(-1)].name}` is not discrete. "
                'Declare it discrete("...").'
            )
        found.append(Law(next(sx), next(sx), next(sx), tuple(places), origin))
    return tuple(found)


def _places(discretes: list[Expr]) -> dict[int, int]:
    """Return the number of each discrete scalar by the hash of its symbol."""
    return {s.element_hash(): k for k, s in enumerate(s for d in discretes for s in scalars(d.sx))}
