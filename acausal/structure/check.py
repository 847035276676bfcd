"""Test for structural singularity before index reduction."""

from __future__ import annotations

from acausal.structure.dulmage_mendelsohn import components, decompose
from acausal.structure.incidence import lowest
from acausal.structure.singularity import StructuralSingularity, Subsystem
from acausal.structure.system import System


def check(system: System) -> None:
    """Require a perfect matching once each chain of derivatives is one variable (Pantelides 1988, theorem 5.1).

    Raises
    ------
    StructuralSingularity
        With the over- and under-determined parts, smallest first.

    """
    root = lowest(system.derivative)
    merged = sorted(set(root))
    column = {variable: k for k, variable in enumerate(merged)}
    rows = [
        tuple({column[root[v]]: None for v in (*row, *system.closures.get(e, ()))}) for e, row in enumerate(system.rows)
    ]
    coarse = decompose(rows, len(merged))
    if not coarse.over.equations and not coarse.under.variables:
        return
    over, under = (
        tuple(Subsystem(part.equations, tuple(merged[v] for v in part.variables)) for part in components(rows, whole))
        for whole in (coarse.over, coarse.under)
    )
    raise StructuralSingularity(over, under)
