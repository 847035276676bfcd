"""The report of a compilation, as data and as text."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca

from acausal.core import why_not
from acausal.flatten.component_tree import walk
from acausal.flatten.flat_model import FlatClosure, FlatUnknowns
from acausal.language import fields as f
from acausal.reduce import ReducedModel
from acausal.reduce.tables import bent_tables
from acausal.symbols import dense, scalars, vec

SHOWN = 12
WIDTH = 100  # columns
FEW = 6
ENTRY = re.compile(r"(.*)\[(\d+)\](\)*)")


@dataclass(frozen=True)
class AtStart:
    """Findings at consistent initial values.

    Parameters
    ----------
    dropped : tuple of int
        Redundant loop closures, found by rank.
    singular : bool
        Whether the start is a singular configuration.
    independent : tuple of str
        Independent states: the loops determine the others.
    """

    dropped: tuple[int, ...] = ()
    singular: bool = False
    independent: tuple[str, ...] = ()


def report(reduced: ReducedModel, local: ca.Function, found: AtStart, seconds: Mapping[str, float]) -> dict[str, Any]:
    """Return sizes at each stage, states, blocks, removed equations, and seconds of each stage.

    Parameters
    ----------
    reduced : ReducedModel
        The equations.
    local : casadi.Function
        Function of the equations and, as its second output, their Jacobian.
    found : AtStart
        Findings at a start.
    seconds : mapping of str to float
        Time of each stage, in s.
    """
    flat, plan = reduced.flat, reduced.plan
    sizes = [len(block.variables) for block in plan.blocks]
    return {
        "model": type(flat.tree).__name__,
        **flat.counts,
        "equations_reduced": len(plan.states) + len(plan.algebraic),
        "differentiated": len(plan.differentiated),
        "states": list(reduced.states),
        "preferences": [int(plan.system.preference[k]) for k in plan.states],
        "algebraic": list(reduced.algebraic),
        "assigned": len(plan.assigned),
        "observed": len(plan.observed),
        "blocks": len(sizes),
        "largest_block": max(sizes, default=0),
        "jacobian_nonzeros": int(local.nnz_out(1)),
        "operations": int(local.n_instructions()),
        "defaults": {path: flat.parameters.bound[path] for path in flat.parameters.defaults},
        "structural_zeros": list(flat.parameters.structural_zeros),
        "stays_zero": list(flat.stays_zero),
        "algebraic_loops": algebraic_loops(reduced),
        "bent_tables": bent_tables(flat, reduced.plan),
        "loops": loops_at(reduced, found),
        "redundant_constraints": [str(o) for o in flat.equations.redundant if o.kind.startswith("connection of")],
        "redundant_in_parts": parts_at(reduced, found),
        "independent_states": list(found.independent),
        "break_switches": len(flat.discontinuities.switches),
        "core_missing": why_not(),
        "seconds": dict(seconds),
    }


def summary(r: Mapping[str, Any]) -> str:
    """Return a report as text."""
    lines = [
        f"{r['model']}: {len(r['states'])} states, {len(r['algebraic'])} algebraic unknowns",
        f"  flattened     {r['equations_flat']:6d} equations, {r['unknowns_flat']} unknowns",
        f"  simplified    {r['equations_simplified']:6d} equations, {r['unknowns_simplified']} unknowns: removed "
        f"{r['constants']} constants and {r['aliases']} aliases, {r['redundant']} redundant equations",
        f"  reduced       {r['differentiated']:6d} equations differentiated, {r['assigned']} solved explicitly, "
        f"{r['observed']} only observed",
        f"  integrated    {r['equations_reduced']:6d} equations: {len(r['states'])} states, "
        f"{len(r['algebraic'])} algebraic unknowns; {r['blocks']} blocks, the largest of {r['largest_block']}",
        f"  states        {_list(r['states'])}{_why(r['preferences'])}",
        f"  algebraic     {_list(r['algebraic'])}",
        f"  exact zeros   {_list(r['structural_zeros'])}",
    ]
    if r["defaults"]:
        lines.append(f"  defaults      {_list([f'{path} (from {others})' for path, others in r['defaults'].items()])}")
    if r["stays_zero"]:
        names = compressed(r["stays_zero"])
        more = f" and {len(names) - FEW} more" if len(names) > FEW else ""
        lines.append(
            f"  stays zero    {', '.join(names[:FEW])}{more}, by {r['unknowns_at_zero']} unknowns: a disturbance across needs "
            "a start value or a force"
        )
    if r["bent_tables"]:
        lines.append(
            f'  tables        {_list(r["bent_tables"])}: accelerations jump at their points; not with kind="cubic"'
        )
    lines += [f"  signal loop   {_list(names)}: solved together" for names in r["algebraic_loops"]]
    lines += [f"  {loop['kind']:14}{_loop_text(loop)}" for loop in r["loops"]]
    if r["redundant_in_parts"]:
        lines.append(f"  redundant     {_redundant(r['redundant_in_parts'])}")
    if r["independent_states"]:
        lines.append(
            f"  independent   {_list(r['independent_states'])}: the other states follow from the loops; chosen by "
            "pivoting at the start, and again where the pivots become small"
        )
    missing = r["core_missing"]
    lines.append(f"  integrator    {f'CasADi, which takes longer than the core: {missing}' if missing else 'the core'}")
    seconds = r["seconds"]
    lines.append("  seconds       " + ", ".join(f"{k} {v:.3f}" for k, v in seconds.items()))
    how = {"subsequent_indent": " " * 16, "break_long_words": False, "break_on_hyphens": False}
    return "\n".join(textwrap.fill(line, WIDTH, **how) for line in lines)


def compressed(names: Sequence[str]) -> list[str]:
    """Return names with consecutive entries of a vector as one slice: q[3], q[4], q[5] as q[3:6]."""
    found = list[
        tuple[str, str, int, int]
    ]()  # text before and after the indices, the first one, the one after the last
    for name in names:
        entry = ENTRY.fullmatch(name)
        before, index, after = entry.groups() if entry else (name, "-1", "")
        if found and found[-1][:2] == (before, after) and found[-1][3] == int(index) > 0:
            found[-1] = (*found[-1][:3], int(index) + 1)
        else:
            found.append((before, after, int(index), int(index) + 1))
    return [
        name if first < 0 else f"{name}[{first}{f':{end}' if end > first + 1 else ''}]{after}"
        for name, after, first, end in found
    ]


def algebraic_loops(reduced: ReducedModel) -> list[list[str]]:
    """Return the inputs and outputs of blocks that are solved for together, loop by loop."""
    parts = [part for part in walk(reduced.flat.tree) if part is not reduced.flat.tree]
    fields = [(part, name, field) for part in parts for name, field in part.fields.items()]
    signals = {
        s.element_hash()
        for part, name, field in fields
        if isinstance(field, f.Variable) and field.causality in ("input", "output")
        for s in scalars(dense(vec(getattr(part, name).sx)))
    }
    unknowns = scalars(reduced.unknowns)
    blocks = [block.variables for block in reduced.plan.blocks if len(block.variables) > 1]
    return [
        [reduced.names[k] for k in block]
        for block in blocks
        if all(unknowns[k].element_hash() in signals for k in block)
    ]


def loops_at(reduced: ReducedModel, at_start: AtStart) -> list[dict[str, Any]]:
    """Return parts, closure and redundant constraints of each loop."""
    loops = reduced.flat.loops
    dropped_of: list[list[FlatClosure]] = [[] for _ in loops.cuts]
    for k in sorted(at_start.dropped):
        if loops.closures[k].loop >= 0:
            dropped_of[loops.closures[k].loop].append(loops.closures[k])
    found = []
    for loop, dropped in zip(loops.cuts, dropped_of, strict=True):
        by_rank = len(dropped)
        found.append(
            {
                "kind": loop.kind,
                "closed_by": [loop.a, loop.b],
                "where": loop.where,
                "parts": list(loop.parts),
                "constraints": loop.constraints,
                "redundant": loop.dropped + by_rank,
                "redundant_by_rank": by_rank,
                "undetermined": [*loop.undetermined, *_flows(reduced.flat.unknowns, dropped)],
                "singular_start": at_start.singular,
            }
        )
    return found


def parts_at(reduced: ReducedModel, at_start: AtStart) -> list[dict[str, Any]]:
    """Return the redundant constraints stated by parts, and their undetermined forces."""
    flat = reduced.flat
    dropped = [flat.loops.closures[k] for k in sorted(at_start.dropped) if flat.loops.closures[k].loop < 0]
    return [
        *[{"constraint": str(origin), "undetermined": []} for origin in flat.loops.folded],
        *[
            {"constraint": str(flat.equations.origins[c.row]), "undetermined": _flows(flat.unknowns, [c])}
            for c in dropped
        ],
    ]


def _flows(unknowns: FlatUnknowns, closures: list[FlatClosure]) -> list[str]:
    """Return the names of the flows that work on closures."""
    if not closures:
        return []
    flows = {s.element_hash() for c in closures for s in ca.symvar(c.dual)}
    moving = {unknowns.symbols[k].element_hash() for k in unknowns.declared}
    names = zip(unknowns.names, scalars(unknowns.symbols), strict=True)
    return [name for name, s in names if s.element_hash() in flows - moving]


def _loop_text(loop: dict[str, Any]) -> str:
    a, b = loop["closed_by"]
    left = loop["constraints"] - loop["redundant"]
    text = f"through {_list(loop['parts'])}, closed where {a} meets {b} ({loop['where']}): "
    text += f"{loop['redundant']} of its {loop['constraints']} constraints redundant and dropped, {left} kept"
    if loop["redundant_by_rank"]:
        text += f"; {loop['redundant_by_rank']} of them found by rank at the start"
    if loop["undetermined"]:
        text += f"; undetermined, and set to 0 or so that they do no work: {_list(loop['undetermined'])}"
    if loop["singular_start"]:
        text += "; the start is a singular configuration: all constraints are kept, the velocity selects the branch"
    return text


def _redundant(found: list[dict[str, Any]]) -> str:
    text = f"{_list([one['constraint'] for one in found])}: dropped, as they follow from other constraints"
    flows = list(dict.fromkeys(name for one in found for name in one["undetermined"]))
    return text + (
        f"; undetermined, and shared with the other constraints by least norm: {_list(flows)}" if flows else ""
    )


def _list(names: list[str]) -> str:
    if not names:
        return "none"
    text = ", ".join(names[:SHOWN])
    return text + (f", ... ({len(names)} in all)" if len(names) > SHOWN else "")


def _why(preferences: list[int]) -> str:
    preferred = sum(p > 0 for p in preferences)
    return f" ({preferred} of them preferred by their components)" if preferred else ""
