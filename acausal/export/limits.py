"""Limits of the parameters of an exported model, and requirements of its components."""

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
    """Kind of a limit, which determines when it is checked; the numbers are part of the file format."""

    LIMIT = 0
    REQUIREMENT = 1
    AT_START = 2


@dataclass(frozen=True)
class Limit:
    """A lower limit of a scalar.

    Attributes
    ----------
    value : casadi.SX
        The scalar.
    least : float
        The limit.
    strict : bool
        Whether the scalar must be greater than the limit.
    kind : Kind
        A limit of a parameter, a requirement on parameters, or one on variables at the start.
    text : str
        Name of the parameter, or message of the requirement.
    """

    value: ca.SX
    least: float
    strict: bool
    kind: Kind
    text: str


def limits(compiled: CompiledModel) -> list[Limit]:
    """Return all limits in the order of their checks.

    Limits of bound parameters follow the requirements, which name the cause, such as a wrong diameter.
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
    """Yield the requirements of components that are expressions, not Python functions."""
    for requirement, origin in stated:
        condition = requirement.subject
        if isinstance(condition, Condition) and not requirement.warning:
            where = f"{origin.path}: " if origin.path else ""
            yield Limit(-requirement.sx, 0.0, condition.kind == "<", kind, f"{where}{requirement.problem}.")
