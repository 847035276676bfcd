"""Rules of FMI for a description, checked before a file is written."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping

from acausal.errors import ExportError
from acausal.export.description import (
    GIVEN,
    INITIAL,
    Description,
    Variable,
    by_reference,
    initial_of,
    initial_unknowns,
)

_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_PART = r"[A-Za-z_][A-Za-z0-9_]*(?:\[\d+(?:,\d+)*\])?"
_STRUCTURED = re.compile(rf"{_PART}(?:\.{_PART})*|der\({_PART}(?:\.{_PART})*(?:,\d+)?\)")
MOST = 2**32  # references have 32 bits


def check(description: Description) -> None:
    """Check a description.

    Raises
    ------
    ExportError
        If the description violates a rule; the message has the first violation.
    """
    for problem in _problems(description):
        raise ExportError(f"cannot export {description.name}: {problem}.")


def are_structured(names: Iterator[str]) -> bool:
    """Return whether all names follow the structured naming convention of FMI, which excludes non-ASCII letters."""
    return all(_STRUCTURED.fullmatch(name) for name in names)


def _problems(description: Description) -> Iterator[str]:
    if not _IDENTIFIER.fullmatch(description.identifier):
        yield f"`{description.identifier}` is not an identifier in C"
    for what in ("start_time", "stop_time", "tolerance", "step_size"):
        if not _finite(value := getattr(description, what)):
            yield f"{what} is {value}; give a finite number"
    names: set[str] = set()
    for variable in description.variables:
        if variable.name in names:
            yield f"two variables are named `{variable.name}`"
        names.add(variable.name)
        yield from _of_variable(variable)
    if sum(variable.causality == "independent" for variable in description.variables) != 1:
        yield "exactly one variable must be the independent one"
    yield from _of_structure(description)


def _finite(value: float | None) -> bool:
    return value is None or math.isfinite(value)


def _of_variable(variable: Variable) -> Iterator[str]:
    name = f"`{variable.name}`"
    if not _finite(variable.start):
        yield f"{name} starts at {variable.start}; give it a finite value"
    if not _finite(variable.minimum):
        yield f"the minimum of {name} is {variable.minimum}; give it a finite one or none"
    if variable.nominal is not None and not (math.isfinite(variable.nominal) and variable.nominal > 0):
        yield f"the nominal value of {name} is {variable.nominal}; give it a positive, finite one"
    if not 0 <= variable.reference < MOST:
        yield f"{name} has the reference {variable.reference}"
    allowed = INITIAL.get((variable.causality, variable.variability))
    if allowed is None:
        yield f"{name} cannot be {variable.causality} and {variable.variability}"
    elif variable.initial not in (None, *allowed):
        yield f"the initial value of {name} ({variable.causality}, {variable.variability}) cannot be {variable.initial}"
    elif (initial_of(variable) in ("exact", "approx")) != (variable.start is not None):
        yield f"{name} {'needs a' if variable.start is None else 'cannot have a'} start value"


def _of_structure(description: Description) -> Iterator[str]:
    alike = by_reference(description)
    states, rates = description.states, description.rates
    listed = {*states, *rates, *description.outputs, *description.indicators}
    for lists in (description.dependencies, description.initial_unknowns):
        listed |= lists.keys() | {known for knowns in lists.values() for known in knowns}
    if unknown := listed - alike.keys():
        yield f"no variable has the reference {min(unknown)}"
        return
    leading = {reference: variables[0] for reference, variables in alike.items()}
    for reference, variables in alike.items():
        yield from _of_aliases(leading[reference], variables[1:])
    if len(states) != len(rates) or [leading[rate].derivative_of for rate in rates] != list(states):
        yield "states and derivatives are not in pairs"
    for reference in (*states, *rates, *description.indicators):
        if leading[reference].causality in GIVEN or leading[reference].variability != "continuous":
            yield f"`{leading[reference].name}` is a state, a derivative or an indicator, but not continuous"
    if jumps := [v.name for v in description.variables if v.reinit and v.reference not in states]:
        yield f"`{jumps[0]}` is not a state, but events change it"
    outputs = {v.reference for v in description.variables if v.causality == "output"}
    if sorted(description.outputs) != sorted(outputs):
        yield "the outputs differ from the listed ones"
    yield from _of_initial_unknowns(description, leading)


def _of_aliases(first: Variable, others: tuple[Variable, ...]) -> Iterator[str]:
    for other in others:
        taken = first.causality in GIVEN and other.causality != "local"
        # Importers treat aliases of time as further independent variables.
        taken |= other.causality in GIVEN or first.causality == "independent"
        varies = (other.causality, first.variability) not in INITIAL
        if taken or varies or (first.variability == "constant") != (other.variability == "constant"):
            kinds = [f"`{v.name}` ({v.causality}, {v.variability})" for v in (first, other)]
            yield f"{' and '.join(kinds)} cannot be one value"
        elif other.start not in (None, first.start):
            yield f"`{first.name}` and `{other.name}` are one value with two starts, {first.start} and {other.start}"


def _of_initial_unknowns(description: Description, leading: Mapping[int, Variable]) -> Iterator[str]:
    listed = description.initial_unknowns.keys()
    for reference in sorted(listed ^ set(initial_unknowns(description, leading))):
        yield f"`{leading[reference].name}` is {'not an' if reference in listed else 'an unlisted'} initial unknown"
