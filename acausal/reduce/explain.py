"""Explain a structural singularity in the user's words."""

from __future__ import annotations

from collections import Counter

import casadi as ca

from acausal.flatten import FlatModel
from acausal.flatten.flat_model import Removal
from acausal.flatten.tree import join, walk
from acausal.language.fields import Variable
from acausal.structure import StructuralSingularity, Subsystem
from acausal.symbols import scalars

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
        lines += _surplus(flat, singularity.over[0])
        one = singularity.over[0]
        lines.append(
            "Remove it: a parameter has its value from the constructor, and a variable is needed in an equation."
            if len(lines) == 3 and not one.variables
            else "One of them is too many: remove it. Where rigid parts close a loop, their lengths cannot all be prescribed: "
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


def _surplus(flat: FlatModel, part: Subsystem) -> list[str]:
    """The equations that are too many, with those that give what was simplified away from them."""
    rows, given = _given(flat.equations.removal, part)
    written = Counter(str(flat.equations.removal.origins[row]) for row in rows)
    few = len(rows) <= MOST
    if few and (given or part.variables):
        names = [*[flat.unknowns.names[v] for v in part.variables if v < len(flat.unknowns.names)], *given]
        count = len(part.variables) + len(given)
        shown = f" ({', '.join(f'`{name}`' for name in names)})" if names else ""
        more = f"These {len(rows)} equations contain only {count} unknown{_s(count)}{shown}:"
        if count >= len(rows):
            more = f"These {len(rows)} equations and their time derivatives are more than the unknowns in them{shown}:"
        return [more, *_listed(written)]
    if not part.variables and not given:
        return [
            "This equation contains no unknown, only parameters:" if len(rows) == 1 else "No unknown is in:",
            *_listed(written),
        ]
    what = f"only {len(part.variables)} unknown{_s(len(part.variables))} ({_names(flat, part)})"
    many = len(part.equations) > 1
    head = (
        f"These {len(part.equations)} equations contain {what}:"
        if part.variables
        else "Other equations give all that is in"
    )
    head = head if part.variables else f"{head} {'these equations' if many else 'this equation'} already:"
    lines = [head, *_equations(flat, part)]
    own = Counter(str(o) for o in (flat.equations.removal.origins[r] for r in rows) if not o.path and not o.text)
    own -= Counter(_origins(flat, part))
    return [*lines, *(["What the model itself prescribes there:", *_listed(own)] if own else [])]


def _given(removal: Removal, part: Subsystem) -> tuple[list[int], list[str]]:
    """Rows of a part and of all that removed an unknown from them, as written, and the names of those unknowns."""
    place = {s.element_hash(): k for k, s in enumerate(scalars(removal.symbols))}
    size = removal.residuals.numel()
    rows = [removal.rows[e] for e in part.equations if e < len(removal.rows)]
    unknowns: list[int] = []
    for row in rows:
        for symbol in ca.symvar(removal.residuals[row]) if row < size else ():
            unknown = place.get(symbol.element_hash(), -1)
            if unknown in removal.source and unknown not in unknowns:
                unknowns.append(unknown)
                rows += [r for r in (removal.source[unknown],) if r not in rows]
    n = len(removal.names)
    return rows, ["der(" * (k // n) + removal.names[k % n] + ")" * (k // n) for k in unknowns]


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
    return _listed(Counter(_origins(flat, part)))


def _origins(flat: FlatModel, part: Subsystem) -> list[str]:
    return [str(flat.equations.origins[e]) for e in part.equations if e < len(flat.equations.origins)]


def _listed(written: Counter[str]) -> list[str]:
    rows = [f"  {line}{f' ({n} entries)' if n > 1 else ''}" for line, n in list(written.items())[:MOST]]
    more = len(written) - MOST
    return rows + ([f"  and {more} more"] if more > 0 else [])


def _s(n: int) -> str:
    return "" if n == 1 else "s"
