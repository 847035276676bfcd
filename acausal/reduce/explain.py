"""Error messages for structural singularities."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

import casadi as ca

from acausal.flatten import FlatModel
from acausal.flatten.component_tree import join, walk
from acausal.flatten.equation_owner import is_stated_by_user
from acausal.flatten.field_kinds import wrong_kinds
from acausal.flatten.origin import Origin
from acausal.language.component import Connector
from acausal.language.fields import Variable
from acausal.language.functions import time
from acausal.structure import StructuralSingularity, Subsystem
from acausal.symbols import scalars

MOST, SHORT = 5, 3
UNCONNECTED = "Not connected"
OUT = "remove one of them"
KNOWN = "known values: parameters (default=..., or given where the part is created), inputs (given or 0), time."
DECLARED = "Declare the unknown of an equation variable(...)."


def explain(flat: FlatModel, singularity: StructuralSingularity, surplus: int) -> str:
    """Return the message: the fault, the smallest singular parts, the likely cause and the remedy.

    Parameters
    ----------
    flat : FlatModel
        The model.
    singularity : StructuralSingularity
        Over- and under-determined parts of the model.
    surplus : int
        Number of equations minus number of unknowns.
    """
    if surplus > 0:
        head = f"the model has {surplus} more equation{_plural(surplus)} than unknowns."
    elif surplus < 0:
        head = f"the model lacks {-surplus} equation{_plural(-surplus)}: there are more unknowns than equations."
    else:
        head = "the model has as many equations as unknowns, but they cannot determine all of them."
    over, under = singularity.over[:1], _together(singularity.under) if singularity.under else None
    lines = [head]
    residuals = scalars(flat.equations.residuals)
    lines += wrong_kinds(flat.tree, [residuals[e] for part in over for e in part.equations if e < len(residuals)])
    if over and under and not _hints(flat, under):
        stated, remedy = _determined(flat, over[0])
        if OUT not in remedy:
            remedy = f"One of the first equations should probably contain {_one_of(flat, under)}."
        return "\n".join([*lines, *stated, *_undetermined(flat, under), remedy])
    if over:
        lines += _too_many(flat, over[0])
    if under:
        square = len(under.equations) == len(under.variables)
        lines += _implicit(flat, under) if square else _too_few(flat, under)
    return "\n".join(lines)


def _one_of(flat: FlatModel, part: Subsystem) -> str:
    names = _names(flat, part)
    return f"one of {names}" if len(part.variables) > 1 else names


def _too_many(flat: FlatModel, part: Subsystem) -> list[str]:
    """Return the lines for an over-determined part, and the remedy."""
    lines, remedy = _determined(flat, part)
    if any("(inherited from " in line for line in lines):
        remedy += (
            " Inherited equations come from `yield from super().equations()`; remove that if you replace all of them."
        )
    if flat.loops.cuts:
        remedy += " Where rigid parts close a loop, their lengths cannot all be prescribed: add a joint or a spring."
    return [*lines, remedy]


def _determined(flat: FlatModel, part: Subsystem) -> tuple[list[str], str]:
    """Return the lines for an over-determined part, the user's own equations first, and the remedy."""
    origins = flat.equations.origins
    rows = [e for e in part.equations if e < len(origins)]
    bases = {str(origins[e]): base for e in rows if (base := _inherited(flat, origins[e]))}
    inside = [o for o in dict.fromkeys(origins[e] for e in rows) if o.kind != "root"]
    eliminating = dict.fromkeys(o for e in rows for o in flat.equations.eliminated_by(e))
    every = dict.fromkeys([*inside, *eliminating])
    own = [o for o in every if is_stated_by_user(flat.tree, o)]
    users, competing = _lines(own, bases), _competing_parts(own)
    n = len(part.variables)
    # If unknowns are left, the eliminating equations of parts only show the order of elimination.
    stated = [o for o in (inside if n else every) if not is_stated_by_user(flat.tree, o)]
    others = _lines(stated, bases)
    if not n and not eliminating:
        return _known(flat, rows, _lines(inside, bases))
    if users and others:
        one = len(users) == 1
        head = "This equation has" if one else "One of these equations has"
        held = f"These equations already determine {'its' if one else 'their'} unknowns:"
        remedy = "Remove it." if one else competing or "Remove one of yours."
        return [f"{head} no unknown left to determine:", *users, held, *others], remedy
    if not n:
        return ["One of these equations has no unknown left to determine:", *(users or others)], "Remove one of them."
    count = f"These {len(part.equations)} equations determine only {n} unknown{_plural(n)} ({_names(flat, part)}):"
    own = _lines(inside, bases)
    given = [line for line in users if line not in own]
    lines = [count, *own, *(["with other unknowns given by:", *given] if given else [])]
    return lines, competing or "One of them is too many: remove it."


def _competing_parts(users: Iterable[Origin]) -> str:
    """Return the parts to which all of these equations belong; "" for a single part, or the model itself."""
    names = [f"`{path}`" for path in dict.fromkeys(o.path for o in users)]
    if "``" in names or not 1 < len(names) <= MOST:
        return ""
    return f"{', '.join(names[:-1])} and {names[-1]} determine the same quantity: {OUT}."


def _known(flat: FlatModel, rows: list[int], lines: list[str]) -> tuple[list[str], str]:
    """Return the lines for equations that contain known values only, and the remedy."""
    head = "This equation determines nothing:" if len(lines) == 1 else "These equations determine nothing:"
    residuals, own = scalars(flat.equations.residuals), flat.parameters
    inside = {s.element_hash() for e in rows for s in ca.symvar(residuals[e])}
    symbols = zip(own.names, scalars(own.symbols), strict=True)
    held = dict.fromkeys(name.partition("[")[0] for name, s in symbols if s.element_hash() in inside)
    it = "It contains" if len(lines) == 1 else "They contain"
    if not held:
        what = "time and numbers." if inside == {time.sx.element_hash()} else KNOWN
        return [head, *lines], f"{it} only {what} Remove it. {DECLARED}"
    declared = {join(c._path, name): d for c in walk(flat.tree) for name, d in c.fields.items()}
    what = [
        f"`{name}` is {'an input of the model (0 if none is given)' if is_input else 'a parameter'}"
        for name, is_input in ((name, isinstance(declared.get(name), Variable)) for name in held)
    ]
    first = f"{', '.join(what[:SHORT])}. Declare"
    remedy = (
        f"{first} it variable(...) if the equation should determine it; or remove the equation."
        if len(held) == 1
        else f"{first} the one that the equation should determine variable(...); or remove the equation."
    )
    return [head, *lines], remedy


def _together(parts: tuple[Subsystem, ...]) -> Subsystem:
    """Return the smallest part, or all variables that no equation contains if there are any."""
    alone = [part for part in parts if not part.equations]
    return Subsystem.of((), (v for part in alone for v in part.variables)) if alone else parts[0]


def _undetermined(flat: FlatModel, part: Subsystem) -> list[str]:
    """Return the lines for an under-determined part: its unknowns, and the equations that contain them."""
    own = _equations(flat, part)
    lines = [f"Nothing determines {_names(flat, part)}."]
    return lines + (["Only these equations contain them:", *own] if own else [])


def _too_few(flat: FlatModel, part: Subsystem) -> list[str]:
    """Return the lines for an under-determined part, the likely cause first, and the remedy."""
    hints = _hints(flat, part)
    lines = [*hints, *_undetermined(flat, part)]
    if not hints and (reference := _reference(flat, part)):
        return [*lines, f"No {reference} fixes their level: connect one to any of these parts."]
    if not hints and (repeats := _repeats(flat)):
        return [*lines, *repeats]
    ports = any(line.startswith(UNCONNECTED) for line in hints)
    remedy = (
        "Connect the part, or give it what is missing"
        if ports
        else "Give the inputs"
        if hints
        else "Add the missing equation"
    )
    remedy += " values (in the class, or where the part is created) or equations." if hints and not ports else "."
    zero = " A mass or inertia of 0 at a free end also leaves a motion undetermined." if ports else ""
    return [*lines, remedy + zero]


def _reference(flat: FlatModel, part: Subsystem) -> str:
    """Return the class of the part that the connectors of undetermined unknowns lack, "" if they need none."""
    names = [flat.unknowns.names[v] for v in part.variables if v < len(flat.unknowns.names)]
    connectors = [c for c in walk(flat.tree) if isinstance(c, Connector) and hasattr(c, "reference")]
    return next((getattr(c, "reference") for c in connectors if any(n.startswith(f"{c._path}.") for n in names)), "")  # noqa: B009


def _repeats(flat: FlatModel) -> list[str]:
    """Return the lines for a group of equations of which one is redundant, and the remedy; [] without one."""
    found = flat.equations.repeats()
    if not found:
        return []
    # The mistake is most likely in the group with most of the user's equations.
    stated, users = max(
        ((own, [o for o in own if is_stated_by_user(flat.tree, o)]) for own in found), key=lambda pair: len(pair[1])
    )
    lines = _lines(users if len(users) > 1 else [*users, *(o for o in stated if o not in users)], {})
    remedy = (
        _competing_parts(users) or "Replace one of them, or remove a part that determines the same quantity as another."
    )
    return ["One of these equations follows from the others, and determines nothing:", *lines, remedy]


def _implicit(flat: FlatModel, part: Subsystem) -> list[str]:
    """Return the lines for a constraint through variables that have only a simultaneous solution, and the remedy."""
    names, known = flat.unknowns.names, [v for v in part.variables if v < len(flat.unknowns.names)]
    return [
        f"The motion is constrained through {', '.join(f'`{names[v]}`' for v in known[:MOST])}, "
        "which these equations determine only simultaneously:",
        *_equations(flat, part),
        "Remove a part that imposes the same constraint as another, or make it elastic; or give each an explicit "
        "equation.",
    ]


def _inherited(flat: FlatModel, origin: Origin) -> str:
    """Return the base class whose equations() states an equation, "" for the component's own class."""
    owner = next((c for c in walk(flat.tree) if c._path == origin.path), None)
    for cls in type(owner).__mro__[1:] if owner else ():
        code = getattr(vars(cls).get("equations"), "__code__", None)
        lines = {f"{code.co_filename}:{line}" for *_, line in code.co_lines() if line} if code else set()
        if origin.where in lines and "equations" in vars(type(owner)):
            return cls.__name__
    return ""


def _hints(flat: FlatModel, part: Subsystem) -> list[str]:
    """Return lines on unconnected ports and inputs without value of the components that have the unknowns."""
    names = [flat.unknowns.names[v].removeprefix("der(") for v in part.variables]
    ports = [p for p in flat.unconnected if any(n.startswith(f"{p}.") for n in names)]
    inputs = [
        join(c._path, own)
        for c in walk(flat.tree)
        if c._path
        for own, declared in c.fields.items()
        if isinstance(declared, Variable) and declared.causality == "input" and own not in c._values
        if _holds(flat, part, getattr(c, own).sx)
    ]
    if not ports and not inputs:
        owners = {n.rpartition(".")[0] for n in names}
        ports = [p for p in flat.unconnected if p.rpartition(".")[0] in owners]
    lines = [f"{UNCONNECTED}: {', '.join(f'`{p}`' for p in ports[:MOST])}."] if ports else []
    if inputs:
        lines.append(f"Inputs that need a value or an equation: {', '.join(f'`{i}`' for i in inputs[:MOST])}.")
    return lines


def _holds(flat: FlatModel, part: Subsystem, expression: ca.SX) -> bool:
    """Return whether an expression of the model depends on unknowns of a part."""
    symbols = scalars(flat.unknowns.symbols)
    own = {symbols[v].element_hash() for v in part.variables if v < len(symbols)}
    left = ca.substitute([expression], [flat.unknowns.eliminated[0]], [flat.unknowns.eliminated[1]])[0]
    return any(s.element_hash() in own for s in ca.symvar(left))


def _names(flat: FlatModel, part: Subsystem) -> str:
    """Return the names of the unknowns of a part, arrays as a whole; the first few of many, with their components."""
    known = flat.unknowns.names
    entries = [known[v] for v in part.variables if v < len(known)]
    whole = dict.fromkeys(re.sub(r"\[[\d,]+\](?=\)*$)", "", n) if len(entries) > SHORT else n for n in entries)
    # Prefer short paths: joints and bodies have their own names for variables of their ports.
    names = sorted(whole, key=lambda n: n.count("."))
    text = ", ".join(f"`{n}`" for n in names[:SHORT])
    more = len(names) - SHORT
    if more <= 0:
        return text
    ports = tuple(f"{c._path}." for c in walk(flat.tree) if isinstance(c, Connector))
    owners = [c for c in walk(flat.tree) if c._path and not isinstance(c, Connector) and not c._path.startswith(ports)]
    of = [c for c in owners if any(n.removeprefix("der(").startswith(f"{c._path}.") for n in names)]
    parts = ", ".join(str(Origin.of(c)) for c in of[:SHORT])
    return f"{text} and {more} more" + (f" of {parts}" if parts else "")


def _equations(flat: FlatModel, part: Subsystem) -> list[str]:
    origins = flat.equations.origins
    # Equations of the model itself first: they are the user's, and the likely mistake.
    known = sorted((origins[e] for e in part.equations if e < len(origins)), key=lambda o: bool(o.path))
    return _lines([o for o in known if o.kind != "root"], {})


def _lines(origins: list[Origin], bases: Mapping[str, str]) -> list[str]:
    """Return the places of equations, one a line; the first few of many."""
    written = dict.fromkeys(map(str, origins))
    rows = [f"  {line}{f' (inherited from {bases[line]})' if line in bases else ''}" for line in list(written)[:MOST]]
    more = len(written) - MOST
    return rows + ([f"  and {more} more"] if more > 0 else [])


def _plural(n: int) -> str:
    return "" if n == 1 else "s"
