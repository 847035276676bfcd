"""The description of a model in FMI 2."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from xml.etree.ElementTree import Element, SubElement

from acausal.export.description import GIVEN, Description, Variable, by_reference, initial_of, is_solved
from acausal.export.document import add_common, attributes, begin, finished
from acausal.export.rules import check


def describe(description: Description) -> bytes:
    """Return the content of modelDescription.xml.

    Raises
    ------
    ExportError
        If the description violates FMI.
    """
    check(description)
    written = list(_written(description))
    index: dict[int, int] = {}  # by reference: index of its leading variable, counted from 1
    for number, (variable, leads) in enumerate(written, 1):
        if leads:
            index[variable.reference] = number
    root = begin(
        description,
        fmiVersion="2.0",
        guid=description.token,
        numberOfEventIndicators=len(description.indicators),
    )
    _add_interfaces(root, description)
    add_common(root, description)
    variables = SubElement(root, "ModelVariables")
    for variable, _ in written:
        _add_variable(variables, variable, index)
    _add_structure(SubElement(root, "ModelStructure"), description, [variable for variable, _ in written], index)
    return finished(root)


def _written(description: Description) -> Iterator[tuple[Variable, bool]]:
    """Return the variables, and whether each is the leading one of its reference, which alone has a start value."""
    leading = {reference: alike[0] for reference, alike in by_reference(description).items()}
    for variable in description.variables:
        first = leading[variable.reference]
        if variable.name == first.name:
            yield first, True
        elif variable.variability == "constant":
            yield variable, False
        else:
            yield replace(variable, initial="calculated", start=None, derivative_of=None, reinit=False), False


def _add_interfaces(root: Element, description: Description) -> None:
    common = attributes(
        modelIdentifier=description.identifier,
        canGetAndSetFMUstate=True,
        canSerializeFMUstate=True,
        providesDirectionalDerivative=True,
    )
    exchange = SubElement(
        root, "ModelExchange", common | attributes(completedIntegratorStepNotNeeded=not description.completes)
    )
    simulation = SubElement(
        root,
        "CoSimulation",
        common | attributes(canHandleVariableCommunicationStepSize=True, canInterpolateInputs=True),
    )
    for interface in (exchange, simulation) if description.sources else ():
        files = SubElement(interface, "SourceFiles")
        for name in description.sources:
            SubElement(files, "File", attributes(name=name))


def _add_variable(variables: Element, variable: Variable, index: Mapping[int, int]) -> None:
    scalar = SubElement(
        variables,
        "ScalarVariable",
        attributes(
            name=variable.name,
            valueReference=variable.reference,
            description=variable.description or None,
            causality=variable.causality,
            variability=variable.variability,
            initial=None if variable.causality in GIVEN else initial_of(variable),
        ),
    )
    SubElement(
        scalar,
        "Real",
        attributes(
            unit=variable.unit or None,
            min=variable.minimum,
            nominal=variable.nominal,
            start=variable.start,
            derivative=None if variable.derivative_of is None else index[variable.derivative_of],
            reinit=variable.reinit or None,
        ),
    )


def _add_structure(
    structure: Element, description: Description, variables: list[Variable], index: Mapping[int, int]
) -> None:
    outputs: dict[int, list[int]] = {}
    for number, variable in enumerate(variables, 1):
        if variable.causality == "output":
            outputs.setdefault(variable.reference, []).append(number)
    listed = [number for reference in description.outputs for number in outputs[reference]]
    solved = {
        number
        for number in (*listed, *(index[r] for r in (*description.states, *description.rates)))
        if is_solved(variables[number - 1])
    }

    def add(tag: str, unknowns: Iterable[int], dependencies: Mapping[int, tuple[int, ...]], alone: bool) -> None:
        rows = []
        for number in unknowns:
            reference = variables[number - 1].reference
            # An alias of a given start value depends only on that value.
            knowns = dependencies.get(reference, (reference,) if alone else None)
            rows.append((number, None if knowns is None else sorted(index[known] for known in knowns)))
        if rows:
            element = SubElement(structure, tag)
            for number, knowns in rows:
                SubElement(element, "Unknown", attributes(index=number, dependencies=knowns))

    add("Outputs", listed, description.dependencies, False)
    add("Derivatives", [index[rate] for rate in description.rates], description.dependencies, False)
    add("InitialUnknowns", sorted(solved), description.initial_unknowns, True)
