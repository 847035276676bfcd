"""What an exported model refuses: parameters beyond their limits, and what its components require."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum

import casadi as ca

from acausal.compiler import CompiledModel
from acausal.compiler.requirements import Stated
from acausal.language.condition import Condition
from acausal.symbols import dense, scalars, vec


class Kind(IntEnum):
    """What a limit is, and so when it is looked at; the numbers are part of the file."""

    LIMIT = 0
    REQUIREMENT = 1
    AT_START = 2


@dataclass(frozen=True)
class Limit:
    """A value that has to be at least as great as another one.

    Attributes
    ----------
    value : casadi.SX
        A scalar.
    least : float
        The other one.
    strict : bool
        Whether it has to be greater than that.
    kind : Kind
        A limit of a parameter, a requirement on parameters, or one on variables at the start.
    text : str
        The name of the parameter, or what is wrong otherwise.
    """

    value: ca.SX
    least: float
    strict: bool
    kind: Kind
    text: str


def limits(compiled: CompiledModel) -> list[Limit]:
    """Return all that can be broken, in the order in which it is looked at.

    What follows other parameters comes after the requirements: they know the cause, such as a wrong diameter.
    """
    own, required = compiled.reduced.flat.parameters, compiled.requirements
    free, bound = list[Limit](), list[Limit]()
    for path, sx, declared in own.limits:
        least = 0.0 if declared.minimum is None else float(declared.minimum)
        strict = declared.positive and least <= 0
        entries = scalars(dense(vec(sx)))
        (bound if path in own.bound else free).extend(Limit(e, least, strict, Kind.LIMIT, path) for e in entries)
    found = [*free, *_required(required.of_parameters, Kind.REQUIREMENT), *bound]
    for limit in _required(required.at_start, Kind.AT_START):
        found.append(Limit(compiled.reduced.running.resolve(limit.value), 0.0, limit.strict, limit.kind, limit.text))
    return [limit for limit in found if not limit.value.is_constant()]


def _required(stated: list[Stated], kind: Kind) -> Iterator[Limit]:
    """Yield what components require, but for functions, which are no expressions."""
    for requirement, origin in stated:
        condition = requirement.subject
        if isinstance(condition, Condition) and not requirement.warning:
            where = f"{origin.path}: " if origin.path else ""
            yield Limit(-requirement.sx, 0.0, condition.kind == "<", kind, f"{where}{requirement.problem}.")
