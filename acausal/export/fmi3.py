"""The description of a model in FMI 3, and the build description of its sources."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from xml.etree.ElementTree import Element, SubElement

from acausal.export.description import GIVEN, Description, Variable, by_reference, initial_of, initial_unknowns
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
    alike = by_reference(description)
    root = begin(description, fmiVersion="3.0", instantiationToken=description.token)
    _add_interfaces(root, description)
    add_common(root, description)
    variables = SubElement(root, "ModelVariables")
    for same in alike.values():
        _add_variable(variables, same)
    leading = {reference: variables[0] for reference, variables in alike.items()}
    _add_structure(SubElement(root, "ModelStructure"), description, leading)
    return finished(root)


def describe_sources(description: Description) -> bytes:
    """Return the content of buildDescription.xml, for compiling the sources."""
    root = Element("fmiBuildDescription", attributes(fmiVersion="3.0"))
    build = SubElement(root, "BuildConfiguration", attributes(modelIdentifier=description.identifier))
    files = SubElement(build, "SourceFileSet", attributes(language="C99"))
    for name in description.sources:
        SubElement(files, "SourceFile", attributes(name=name))
    return finished(root)


def _add_interfaces(root: Element, description: Description) -> None:
    common = attributes(
        modelIdentifier=description.identifier,
        canGetAndSetFMUState=True,
        canSerializeFMUState=True,
        providesDirectionalDerivatives=True,
        providesAdjointDerivatives=True,
    )
    SubElement(root, "ModelExchange", common | attributes(needsCompletedIntegratorStep=description.completes))
    SubElement(
        root,
        "CoSimulation",
        common
        | attributes(canHandleVariableCommunicationStepSize=True, mightReturnEarlyFromDoStep=True, hasEventMode=True),
    )


def _add_variable(variables: Element, alike: Sequence[Variable]) -> None:
    """Add the variables of a reference: an output, if there is one, gives the name, the others are aliases."""
    first = alike[0]
    shown = next((variable for variable in alike if variable.causality == "output"), first)
    element = SubElement(
        variables,
        "Float64",
        attributes(
            name=shown.name,
            valueReference=shown.reference,
            description=shown.description or None,
            causality=shown.causality,
            variability=first.variability,
            initial=None if first.causality in GIVEN else initial_of(first),
            unit=shown.unit or None,
            min=first.minimum,
            nominal=first.nominal,
            start=first.start,
            derivative=first.derivative_of,
            reinit=first.reinit or None,
        ),
    )
    for alias in alike:
        if alias.name != shown.name:
            SubElement(element, "Alias", attributes(name=alias.name, description=alias.description or None))


def _add_structure(structure: Element, description: Description, leading: Mapping[int, Variable]) -> None:
    def add(tag: str, unknowns: Iterable[int], dependencies: Mapping[int, tuple[int, ...]]) -> None:
        for unknown in unknowns:
            knowns = dependencies.get(unknown)
            SubElement(structure, tag, attributes(valueReference=unknown, dependencies=knowns and sorted(knowns)))

    add("Output", description.outputs, description.dependencies)
    add("ContinuousStateDerivative", description.rates, description.dependencies)
    add("InitialUnknown", initial_unknowns(description, leading), description.initial_unknowns)
    add("EventIndicator", description.indicators, description.dependencies)
