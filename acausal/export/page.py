"""The documentation page of an exported model."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from acausal.export.description import Description

PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{name}</title></head>
<body>
<h1>{name}</h1>
<p>{description}</p>
<table>
{rows}
</table>
</body>
</html>
"""


def page(description: Description, fmi_version: int, platforms: Sequence[str]) -> bytes:
    """Return the page.

    Parameters
    ----------
    description : Description
        Interface of the model.
    fmi_version : int
        2 or 3.
    platforms : sequence of str
        Folders of the included libraries.
    """

    def names(causality: str) -> str:
        found = [variable.name for variable in description.variables if variable.causality == causality]
        return f"{len(found)}: {', '.join(found)}" if found else "none"

    table = {
        "made by": f"acausal {description.version}",
        "interface": f"FMI {fmi_version}, Model Exchange and Co-Simulation",
        "platforms": ", ".join(platforms) + (", others from the sources" if description.sources else ""),
        "continuous states": str(len(description.states)),
        "event indicators": str(len(description.indicators)),
        "inputs": names("input"),
        "outputs": names("output"),
        "parameters": names("parameter"),
        "variables": str(len(description.variables)),
    }
    rows = "\n".join(f"<tr><th>{escape(what)}</th><td>{escape(text)}</td></tr>" for what, text in table.items())
    text = PAGE.format(name=escape(description.name), description=escape(description.description), rows=rows)
    return text.encode("utf-8", "replace")
