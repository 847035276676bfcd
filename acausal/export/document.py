"""Common parts of the model descriptions of FMI 2 and FMI 3."""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from acausal.export.description import Description
from acausal.export.rules import are_structured
from acausal.export.units import exponents

Value = str | float | Sequence[int] | None
CATEGORIES = {"logEvents": "events and what they changed", "logStatusError": "why a call was refused"}
_NO_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def attributes(**values: Value) -> dict[str, str]:
    """Return the attributes that are not None as text."""
    return {name: _text(value) for name, value in values.items() if value is not None}


def _text(value: str | float | Sequence[int]) -> str:
    if isinstance(value, str):
        return _NO_XML.sub("\ufffd", value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Sequence):
        return " ".join(map(str, value))
    return str(value) if isinstance(value, int) else repr(float(value))


def begin(description: Description, **more: Value) -> Element:
    """Return the root element of a description."""
    own = attributes(
        modelName=description.name,
        description=description.description or None,
        generationTool=f"acausal {description.version}",
        variableNamingConvention="structured" if are_structured(v.name for v in description.variables) else "flat",
    )
    return Element("fmiModelDescription", attributes(**more) | own)


def add_common(root: Element, description: Description) -> None:
    """Add units, log categories and the default experiment."""
    if units := dict.fromkeys(v.unit for v in description.variables if v.unit):
        definitions = SubElement(root, "UnitDefinitions")
        for unit in units:
            element = SubElement(definitions, "Unit", attributes(name=unit))
            if (powers := exponents(unit)) is not None:
                SubElement(element, "BaseUnit", attributes(**powers))
    categories = SubElement(root, "LogCategories")
    for name, text in CATEGORIES.items():
        SubElement(categories, "Category", attributes(name=name, description=text))
    if proposed := attributes(
        startTime=description.start_time,
        stopTime=description.stop_time,
        tolerance=description.tolerance,
        stepSize=description.step_size,
    ):
        SubElement(root, "DefaultExperiment", proposed)


def finished(root: Element) -> bytes:
    """Return a document as bytes."""
    indent(root)
    return tostring(root, encoding="utf-8", xml_declaration=True) + b"\n"
