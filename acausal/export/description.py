"""What the description of an exported model says, before it is written as FMI 2 or FMI 3."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Literal

Causality = Literal["independent", "parameter", "input", "output", "local"]
Variability = Literal["constant", "fixed", "tunable", "discrete", "continuous"]
Initial = Literal["exact", "approx", "calculated"]


@dataclass(frozen=True)
class Variable:
    """A scalar that importers see; several with one reference are aliases of one value.

    Parameters
    ----------
    name : str
        In the user's words: "beam.node_r_0[1,2]", "der(crank.phi)".
    reference : int
        Under which the library reads and writes the value.
    causality, variability, initial : str
        As FMI defines them; `initial` None stands for the default of the other two.
    unit : str
        "" where it is not known.
    start : float or None
        Of what is set or solved for at the start.
    description : str
        A sentence for users.
    nominal : float or None
        Usual size.
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
    """A model as other tools see it; numbers of variables are references.

    Parameters
    ----------
    name : str
        Of the model.
    identifier : str
        Name of the libraries, an identifier in C.
    token : str
        Tells this model from others: a GUID in braces.
    description : str
        A sentence for users.
    version : str
        Of acausal.
    variables : tuple of Variable
        In the order in which they are written.
    states, rates : tuple of int
        Continuous states and their derivatives, in pairs.
    outputs, indicators : tuple of int
        Outputs and event indicators, in their order.
    dependencies : mapping
        Of outputs, rates and indicators: on which states and inputs they depend, in ascending order.
    initial_unknowns : mapping
        Of what is solved for at the start: on which inputs, parameters and exact starts it depends, in ascending order.
    start_time, stop_time, tolerance, step_size : float or None
        What the model proposes for a run.
    completes : bool
        Whether importers tell the end of each step that they keep: closed loops may pass a flat position.
    sources : tuple of str
        C files that have to be compiled for other platforms; none if no sources are enclosed.
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


# What FMI allows as `initial`; the first is the default.
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
GIVEN = ("independent", "parameter", "input")  # from outside


def initial_of(variable: Variable) -> Initial | None:
    """Return how a variable gets its initial value, where need be by the default."""
    return variable.initial or INITIAL[variable.causality, variable.variability][0]


def is_solved(variable: Variable) -> bool:
    """Return whether the initial value comes out of the initialisation."""
    return initial_of(variable) in ("approx", "calculated")


def by_reference(description: Description) -> dict[int, tuple[Variable, ...]]:
    """Return the variables of each reference, first the one through which the value is given."""
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
    """Add to a variable what only its aliases say: FMI asks one of them for it."""
    return replace(
        first,
        nominal=next((v.nominal for v in alike if v.nominal is not None), None),
        minimum=next((v.minimum for v in alike if v.minimum is not None), None),
        derivative_of=next((v.derivative_of for v in alike if v.derivative_of is not None), None),
        reinit=any(v.reinit for v in alike),
    )


def initial_unknowns(description: Description, leading: Mapping[int, Variable]) -> Iterator[int]:
    """Return the references that FMI wants listed as initial unknowns: outputs, states and rates that are solved for."""
    for reference in sorted({*description.outputs, *description.states, *description.rates}):
        if is_solved(leading[reference]):
            yield reference
