"""Checks of expressions: no opaque CasADi calls, which later passes cannot read, and no undeclared symbols."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

import casadi as ca

from acausal.errors import DeclarationError
from acausal.flatten.origin import Origin, value_origin
from acausal.instructions import is_known
from acausal.language.functions import feedback, initial, time
from acausal.symbols import called, scalars, stacked, vec

if TYPE_CHECKING:
    from acausal.flatten.collected_statements import CollectedStatements

Found = Callable[[ca.SX], bool]


def refuse_opaque_expressions(raw: CollectedStatements) -> None:
    """Raise DeclarationError if an expression of the model contains an opaque call or an undeclared symbol."""
    stated = [*zip(raw.equations.residuals, raw.equations.origins, strict=True)]
    stated += zip(raw.initial.residuals, raw.initial.origins, strict=True)
    stated += [
        (c.excess.sx, origin) for (_, c), origin in zip(raw.pending.switches, raw.pending.switch_origins, strict=False)
    ]
    for when, origin in raw.pending.whens:
        given = [jump.value for jump in when.jumps] + [a for call in when.calls for a in call.arguments]
        stated += [(e.sx, origin) for e in (when.condition.excess, *given)]
    for law, origin in raw.pending.laws:
        stated += [(e.sx, origin) for e in (law.speed, law.rate, law.limit)]
    values = [(a, e.sx) for a in raw.arrays for e in (a.start, a.nominal) if not e.sx.is_constant()]
    stated += [(sx, value_origin(a.owner, a.declared.name)) for a, sx in values]
    others = [*[e for _, e in raw.pending.derivatives], *raw.energies.values(), *raw.discrete_starts]
    everything = _column([*[sx for sx, _ in stated], *others])
    known = [raw.variables, stacked(raw.build.parameters.symbols), _column(_requested(raw))]
    function = ca.Function("all", known, [everything], {"allow_free": True})
    if not all(map(is_known, function.get_function())):
        raise DeclarationError(
            f"{_place(raw, stated, others, _calls)}an expression calls a CasADi function whose operations are unknown, "
            "such as an interpolant or an external function. Write a table with table(x, Table(...)); call a function of "
            "elementary operations with SX, which expands it."
        )
    _refuse_varying(raw)
    if function.has_free():
        stranger = function.free_sx()[0]
        place = _place(raw, stated, others, lambda e: ca.depends_on(e, stranger))
        raise DeclarationError(place + _undeclared(stranger))


def _refuse_varying(raw: CollectedStatements) -> None:
    """Raise DeclarationError if a start value depends on a variable, or a nominal value on one or on time."""
    variables = raw.index.keys()
    for array in (a for a in raw.arrays if not a.start.sx.is_constant()):
        found = [s for s in ca.symvar(array.start.sx) if s.element_hash() in variables]
        if found:
            declared = array.declared.name
            raise DeclarationError(
                f"{value_origin(array.owner, declared)}: the start value depends on the variable "
                f"`{found[0].name()}`; it takes numbers and parameters. State it in initial_equations(): "
                f"yield self.{declared} == ...."
            )
    varying = variables | {time.sx.element_hash()}
    for array in (a for a in raw.arrays if not a.nominal.sx.is_constant()):
        found = [s for s in ca.symvar(array.nominal.sx) if s.element_hash() in varying]
        if found:
            raise DeclarationError(
                f"{value_origin(array.owner, array.declared.name)}: the nominal value depends on `{found[0].name()}`, "
                "which changes in a run; it takes numbers and parameters."
            )


def refuse_undeclared(expression: ca.SX, known: Iterable[ca.SX], place: str = "") -> None:
    """Raise DeclarationError if an expression contains an unknown symbol.

    Parameters
    ----------
    expression : casadi.SX
        Expression of the user.
    known : iterable of casadi.SX
        Columns of known symbols.
    place : str
        Place of the expression, for the message.
    """
    hashes = {s.element_hash() for s in scalars(_column(known))}
    for symbol in ca.symvar(expression):
        if symbol.element_hash() not in hashes:
            raise DeclarationError(place + _undeclared(symbol))


def _undeclared(symbol: ca.SX) -> str:
    name = symbol.name()
    word = name if name.isidentifier() else "q"
    return (
        f"`{name}` is not a variable or parameter of this model, but a CasADi symbol or one of another built model. "
        f'Declare it in the class body, `{word}: Scalar = variable("...")` or `parameter("...")`, and use self.{word}.'
    )


def _requested(raw: CollectedStatements) -> list[ca.SX]:
    """Return the symbols that expressions may contain besides variables and parameters."""
    pending = raw.pending
    columns = [d.sx for d in raw.discretes] + [time.sx, initial.sx, feedback.sx]
    return columns + [symbol for symbol, _ in (*pending.switches, *pending.derivatives)]


def _place(raw: CollectedStatements, stated: list[tuple[ca.SX, Origin]], others: list[ca.SX], found: Found) -> str:
    """Return the place of a faulty expression, or of the equation or energy that uses it."""
    for sx, origin in stated:
        if found(sx):
            return f"{origin}: "
    held = [placeholder for (placeholder, _), e in zip(raw.pending.derivatives, others, strict=False) if found(e)]
    for residual, origin in zip(raw.equations.residuals, raw.equations.origins, strict=True):
        if any(ca.depends_on(residual, placeholder) for placeholder in held):
            return f"{origin}: "
    name = next((name for name, e in raw.energies.items() if found(e)), "a start value")
    return f"{name}{'()' if name in raw.energies else ''}: "


def _column(entries: Iterable[ca.SX]) -> ca.SX:
    return stacked([vec(e) for e in entries])


def _calls(expression: ca.SX) -> bool:
    """Return whether an expression contains opaque calls."""
    return not all(map(is_known, called(expression)))
