"""The interface of an exported model, independent of the version of FMI."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Literal

Causality = Literal["independent", "parameter", "input", "output", "local"]
Variability = Literal["constant", "fixed", "tunable", "discrete", "continuous"]
Initial = Literal["exact", "approx", "calculated"]


@dataclass(frozen=True)
class Variable:
    """A scalar of the interface; variables with equal references are aliases of one value.

    Parameters
    ----------
    name : str
        As in the model: "beam.node_r_0[1,2]", "der(crank.phi)".
    reference : int
        Value reference.
    causality, variability, initial : str
        As defined by FMI; `initial` None is the default for the other two.
    unit : str
        "" if unknown.
    start : float or None
        Start value.
    description : str
        A sentence for users.
    nominal : float or None
        Nominal value.
    minimum : float or None
        Smallest value.
    derivative_of : int or None
        Reference of the state of which this is the derivative.
    reinit : bool
        Whether an event may change this state.
    """

    name: str
    reference: int
    causality: Causality
    variability: Variability
    initial: Initial | None
    unit: str
    start: float | None
    description: str = ""
    nominal: float | None = None
    minimum: float | None = None
    derivative_of: int | None = None
    reinit: bool = False


@dataclass(frozen=True)
class Description:
    """The interface of a model; variables are given by their references.

    Parameters
    ----------
    name : str
        Of the model.
    identifier : str
        Name of the libraries, an identifier in C.
    token : str
        Identifies the model: a GUID in braces.
    description : str
        A sentence for users.
    version : str
        Of acausal.
    variables : tuple of Variable
        In the order of the file.
    states, rates : tuple of int
        Continuous states and their derivatives, in pairs.
    outputs, indicators : tuple of int
        Outputs and event indicators, in their order.
    dependencies : mapping
        States and inputs on which each output, rate and indicator depends, in ascending order.
    initial_unknowns : mapping
        Inputs, parameters and exact start values on which each initial unknown depends, in ascending order.
    start_time, stop_time, tolerance, step_size : float or None
        The default experiment.
    completes : bool
        Whether importers must report the end of each accepted step, because closed loops may pass a singular configuration.
    sources : tuple of str
        C files to compile for other platforms; empty if no sources are included.
    """

    name: str
    identifier: str
    token: str
    description: str
    version: str
    variables: tuple[Variable, ...]
    states: tuple[int, ...]
    rates: tuple[int, ...]
    outputs: tuple[int, ...]
    indicators: tuple[int, ...]
    dependencies: Mapping[int, tuple[int, ...]]
    initial_unknowns: Mapping[int, tuple[int, ...]]
    start_time: float | None = None
    stop_time: float | None = None
    tolerance: float | None = None
    step_size: float | None = None
    completes: bool = False
    sources: tuple[str, ...] = ()


# Values of `initial` that FMI allows; the first is the default.
ANY: tuple[Initial | None, ...] = ("calculated", "exact", "approx")
INITIAL: Mapping[tuple[Causality, Variability], tuple[Initial | None, ...]] = {
    ("independent", "continuous"): (None,),
    ("parameter", "fixed"): ("exact",),
    ("parameter", "tunable"): ("exact",),
    ("input", "discrete"): ("exact",),
    ("input", "continuous"): ("exact",),
    ("output", "constant"): ("exact",),
    ("output", "discrete"): ANY,
    ("output", "continuous"): ANY,
    ("local", "constant"): ("exact",),
    ("local", "fixed"): ("calculated", "approx"),
    ("local", "tunable"): ("calculated", "approx"),
    ("local", "discrete"): ANY,
    ("local", "continuous"): ANY,
}
GIVEN = ("independent", "parameter", "input")  # values set by the importer


def initial_of(variable: Variable) -> Initial | None:
    """Return `initial` of a variable, or its default."""
    return variable.initial or INITIAL[variable.causality, variable.variability][0]


def is_solved(variable: Variable) -> bool:
    """Return whether the initialisation computes the initial value."""
    return initial_of(variable) in ("approx", "calculated")


def by_reference(description: Description) -> dict[int, tuple[Variable, ...]]:
    """Return the variables of each reference, first the one that has the start value."""
    found: dict[int, list[Variable]] = {}
    for variable in description.variables:
        found.setdefault(variable.reference, []).append(variable)
    return {reference: _leading(alike) for reference, alike in found.items()}


def _leading(alike: list[Variable]) -> tuple[Variable, ...]:
    if len(alike) == 1:
        return (alike[0],)
    first = max(alike, key=lambda variable: (variable.causality in GIVEN, variable.start is not None))
    return (_merged(first, alike), *(variable for variable in alike if variable is not first))


def _merged(first: Variable, alike: list[Variable]) -> Variable:
    """Complete a variable by the attributes of its aliases, because FMI requires them of one variable."""
    return replace(
        first,
        nominal=next((v.nominal for v in alike if v.nominal is not None), None),
        minimum=next((v.minimum for v in alike if v.minimum is not None), None),
        derivative_of=next((v.derivative_of for v in alike if v.derivative_of is not None), None),
        reinit=any(v.reinit for v in alike),
    )


def initial_unknowns(description: Description, leading: Mapping[int, Variable]) -> Iterator[int]:
    """Return the references of the initial unknowns of FMI: outputs, states and rates that the initialisation computes."""
    for reference in sorted({*description.outputs, *description.states, *description.rates}):
        if is_solved(leading[reference]):
            yield reference
