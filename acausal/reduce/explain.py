"""Explain a structural singularity in the user's words."""

from __future__ import annotations

from collections import Counter

from acausal.flatten import FlatModel
from acausal.flatten.tree import join, walk
from acausal.language.fields import Variable
from acausal.structure import StructuralSingularity, Subsystem

MOST = 10


def explain(flat: FlatModel, singularity: StructuralSingularity, surplus: int) -> str:
    """Return the message: what is wrong, the smallest offending parts, the likely cause and the remedy.

    Parameters
    ----------
    flat : FlatModel
        The model.
    singularity : StructuralSingularity
        Its over- and under-determined parts.
    surplus : int
        Equations minus unknowns.
    """
    if surplus > 0:
        head = f"the model has {surplus} more equation{_s(surplus)} than unknowns."
    elif surplus < 0:
        head = f"the model lacks {-surplus} equation{_s(-surplus)}: there are more unknowns than equations."
    else:
        head = "the model has as many equations as unknowns, but they cannot determine all of them."
    lines = [head]
    if singularity.over:
        part = singularity.over[0]
        lines.append(
            f"These {len(part.equations)} equations contain only {len(part.variables)} unknown{_s(len(part.variables))} "
            f"({_names(flat, part)}):"
        )
        lines += _equations(flat, part)
        lines.append(
            "One of them is too many: remove it. Where rigid parts close a loop, their lengths cannot all be prescribed: "
            "add a joint or a spring."
        )
    if singularity.under:
        part = singularity.under[0]
        lines.append(f"Nothing determines {_names(flat, part)}.")
        lines += _hints(flat, part)
        if part.equations:
            lines.append(f"The only equations that contain them ({len(part.equations)}):")
            lines += _equations(flat, part)
        lines.append(
            "Add the missing equation, or connect the part; "
            "a mass or inertia of 0 at a free end also leaves its motion undetermined."
        )
    return "\n".join(lines)


def _hints(flat: FlatModel, part: Subsystem) -> list[str]:
    """Ports without a connection and inputs without a value, of the components that the unknowns belong to."""
    names = [flat.unknowns.names[v].removeprefix("der(") for v in part.variables]
    ports = [p for p in flat.unconnected if any(n.startswith(f"{p}.") for n in names)]
    inputs = [
        join(c._path, own)
        for c in walk(flat.tree)
        if c._path and any(n.startswith(f"{c._path}.") for n in names)
        for own, declared in c.fields.items()
        if isinstance(declared, Variable) and declared.causality == "input" and own not in c._values
    ]
    lines = [f"Not connected: {', '.join(f'`{p}`' for p in ports[:MOST])}."] if ports else []
    if inputs:
        lines.append(f"Inputs that need a value or an equation: {', '.join(f'`{i}`' for i in inputs[:MOST])}.")
    return lines


def _names(flat: FlatModel, part: Subsystem) -> str:
    known = flat.unknowns.names
    written = [v for v in part.variables if v < len(known)]
    names = [f"`{known[v]}`" for v in written[:MOST]]
    more = len(written) - MOST
    return ", ".join(names) + (f" and {more} more" if more > 0 else "")


def _equations(flat: FlatModel, part: Subsystem) -> list[str]:
    origins = flat.equations.origins
    written = Counter(str(origins[e]) for e in part.equations if e < len(origins))
    rows = [f"  {line}{f' ({n} entries)' if n > 1 else ''}" for line, n in list(written.items())[:MOST]]
    more = len(written) - MOST
    return rows + ([f"  and {more} more"] if more > 0 else [])


def _s(n: int) -> str:
    return "" if n == 1 else "s"
