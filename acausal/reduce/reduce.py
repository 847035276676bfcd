"""reduce(): carry out a Plan on the symbols of a flat model."""

from __future__ import annotations

import casadi as ca

from acausal.errors import StructurallySingularError, UnbalancedModelError
from acausal.flatten import FlatModel
from acausal.language.functions import initial, time
from acausal.reduce.explain import explain
from acausal.reduce.incidence import Linear, jacobian, system_of
from acausal.reduce.reduced_model import ReducedModel
from acausal.structure import Plan, StructuralSingularity, analyse
from acausal.symbols import scalars


def plan_of(flat: FlatModel) -> tuple[Plan, Linear]:
    """Analyse the structure of a flat model.

    Raises
    ------
    UnbalancedModelError
        If the model has too many or too few equations.
    StructurallySingularError
        If the counts match but some unknowns cannot be determined.
    """
    system, linear = system_of(flat)
    try:
        return analyse(system), linear
    except StructuralSingularity as singularity:
        chains = sum(d >= 0 for d in flat.derivative)
        surplus = len(flat.origins) - (len(flat.names) - chains)
        kind = UnbalancedModelError if surplus else StructurallySingularError
        raise kind(explain(flat, singularity, surplus)) from None


def reduce(flat: FlatModel, plan: Plan, linear: Linear) -> ReducedModel:
    """Differentiate, solve explicitly and substitute as the plan says.

    Parameters
    ----------
    flat : FlatModel
        The model.
    plan : Plan
        From `plan_of`.
    linear : Linear
        Jacobian of its residuals, from `plan_of`.
    """
    created = [ca.SX.sym(f"der{k}") for k in plan.created]
    unknowns = ca.vertcat(flat.unknowns, *created)
    names = list(flat.names)
    for k in plan.created:
        names.append(f"der({names[k]})")
    residuals, explicit = _differentiate(flat, plan, unknowns, linear)
    elements = scalars(unknowns)

    def solved(pairs: tuple[tuple[int, int], ...]) -> tuple[ca.SX, ca.SX]:
        symbols = ca.vertcat(*[elements[v] for v, _ in pairs])
        return symbols, _solve(pairs, residuals, explicit, elements, plan)

    x = ca.vertcat(*[elements[k] for k in plan.states])
    z = ca.vertcat(*[elements[k] for k in plan.algebraic])
    ode = ca.vertcat(*[elements[plan.system.derivative[k]] for k in plan.states])
    alg = ca.vertcat(*[residuals[k] for k in plan.residuals])
    assigned, values = solved(plan.assigned)
    if plan.assigned:
        values, ode, alg = _inline(assigned, values, ode, alg)
    observed = solved(plan.observed)
    definitions = ca.vertcat(assigned, observed[0]), ca.vertcat(values, observed[1])
    return ReducedModel(flat, plan, unknowns, tuple(names), x, z, ode, alg, definitions)


def _inline(symbols: ca.SX, values: ca.SX, ode: ca.SX, alg: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX]:
    definitions, others = ca.substitute_inplace([symbols], [values], [ode, alg])
    return definitions[0], others[0], others[1]


def _differentiate(
    flat: FlatModel, plan: Plan, unknowns: ca.SX, linear: Linear
) -> tuple[list[ca.SX], dict[tuple[int, int], ca.SX]]:
    """Append the differentiated equations, all of one level in one call."""
    elements = scalars(unknowns)
    seeds = [elements[d] if d >= 0 else ca.SX(0) for d in plan.system.derivative]
    for k, expression in flat.declared.items():
        if plan.system.derivative[k] < 0:
            seeds[k] = expression
    at, direction = ca.vertcat(unknowns, time.sx), ca.vertcat(*seeds, 1)
    residuals, explicit = scalars(flat.residuals), dict(linear.explicit)
    first, total = len(residuals), len(residuals) + len(plan.differentiated)
    modes = ca.vertcat(*[mode for mode, _ in flat.switches])
    while len(residuals) < total:
        start = len(residuals)
        sources = list(plan.differentiated[start - first :])
        ready = next((k for k, e in enumerate(sources) if e >= start), len(sources))
        level = ca.vertcat(*[residuals[e] for e in sources[:ready]])
        derivative = ca.densify(ca.jtimes(level, at, direction))
        residuals.extend(scalars(derivative))
        coefficients = jacobian(derivative, unknowns, ca.vertcat(time.sx, initial.sx, modes)).explicit
        explicit.update({(start + i, j): c for (i, j), c in coefficients.items()})
    return residuals, explicit


def _solve(
    pairs: tuple[tuple[int, int], ...],
    residuals: list[ca.SX],
    explicit: dict[tuple[int, int], ca.SX],
    elements: list[ca.SX],
    plan: Plan,
) -> ca.SX:
    """Solve each (unknown, equation) for its unknown: v = -r(v = 0) / c.

    Rows that do not contain each other's unknown are treated in one substitution.
    """
    owner = {v: k for k, (v, _) in enumerate(pairs)}
    colour = [0] * len(pairs)
    taken: list[set[int]] = [set() for _ in pairs]
    for k, (v, e) in enumerate(pairs):
        inside = [owner[u] for u in plan.system.rows[e] if u in owner and u != v]
        used = taken[k].union(colour[j] for j in inside if j < k)
        colour[k] = next(c for c in range(len(pairs) + 1) if c not in used)
        for j in inside:
            taken[j].add(colour[k])
    values: list[ca.SX] = [ca.SX(0)] * len(pairs)
    for c in range(max(colour, default=-1) + 1):
        chosen = [k for k in range(len(pairs)) if colour[k] == c]
        symbols = ca.vertcat(*[elements[pairs[k][0]] for k in chosen])
        column = ca.vertcat(*[residuals[pairs[k][1]] for k in chosen])
        rest = ca.substitute([column], [symbols], [ca.SX.zeros(len(chosen))])[0]
        for k, r in zip(chosen, scalars(rest), strict=True):
            v, e = pairs[k]
            coefficient = explicit[e, v]
            values[k] = -r if coefficient.is_one() else r if coefficient.is_minus_one() else -r / coefficient
    return ca.vertcat(*values)
