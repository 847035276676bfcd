"""Reduction of a flat model: symbolic execution of its solution plan."""

from __future__ import annotations

import casadi as ca

from acausal.errors import StructurallySingularError, UnbalancedModelError
from acausal.flatten import FlatModel
from acausal.flatten.origin import Origin
from acausal.language.functions import initial, time
from acausal.reduce.constrain import constrain
from acausal.reduce.explain import explain
from acausal.reduce.explicit import solve_explicit
from acausal.reduce.flat_incidence import Incidence, jacobian, system_of
from acausal.reduce.hidden_constraints import with_hidden_constraints
from acausal.reduce.input_derivatives import refuse_differentiated_inputs
from acausal.reduce.reduced_model import ReducedModel
from acausal.reduce.tables import table_kinks
from acausal.structure import Plan, StructuralSingularity, Subsystem, analyse
from acausal.symbols import inlined, scalars


def plan_of(flat: FlatModel) -> tuple[FlatModel, Plan, Incidence]:
    """Return a flat model with its hidden constraints, its solution plan, and the Jacobian of its residuals.

    Raises
    ------
    UnbalancedModelError
        If the model has too many or too few equations.
    StructurallySingularError
        If the counts match but some unknowns cannot be determined.
    DeclarationError
        If the derivative of an input of the whole model is needed.
    """
    system, linear = system_of(flat)
    if (shown := with_hidden_constraints(flat, linear)) is not flat:
        flat, (system, linear) = shown, system_of(shown)
    try:
        plan = analyse(system)
        refuse_implicit(plan)
    except StructuralSingularity as singularity:
        chains = sum(d >= 0 for d in flat.unknowns.derivative)
        surplus = len(flat.equations.origins) - (len(flat.unknowns.names) - chains)
        kind = UnbalancedModelError if surplus else StructurallySingularError
        raise kind(explain(flat, singularity, surplus)) from None
    refuse_differentiated_inputs(flat, plan)
    return flat, plan, linear


def refuse_implicit(plan: Plan) -> None:
    """Raise StructuralSingularity for a constraint through variables that do not follow explicitly from states."""
    implicit = set(plan.constrained.reached).difference(v for v, _ in plan.constrained.following)
    if implicit:
        block = next(block for block in plan.blocks if implicit.intersection(block.variables))
        raise StructuralSingularity(under=(Subsystem.of(block.equations, block.variables),))


def reduce(flat: FlatModel, plan: Plan, linear: Incidence) -> ReducedModel:
    """Return the reduced model: differentiate, solve explicitly and substitute by the plan.

    Parameters
    ----------
    flat : FlatModel
        The model.
    plan : Plan
        Plan from `plan_of`.
    linear : Incidence
        Jacobian of the residuals, from `plan_of`.
    """
    created = [ca.SX.sym(f"der{k}") for k in plan.created]
    written = flat.unknowns.symbols.numel() + len(created)
    created += [ca.SX.sym(f"x{k}") for k in range(plan.system.n_variables - written)]
    unknowns = ca.vertcat(flat.unknowns.symbols, *created)
    residuals, explicit = _differentiate(flat, plan, unknowns, linear)
    elements = scalars(unknowns)
    projections = constrain(flat, plan, elements, residuals, explicit)

    def solved(pairs: tuple[tuple[int, int], ...]) -> tuple[ca.SX, ca.SX]:
        symbols = ca.vertcat(*[elements[v] for v, _ in pairs])
        return symbols, solve_explicit(pairs, residuals, explicit, elements, plan)

    x = ca.vertcat(*[elements[k] for k in plan.states])
    z = ca.vertcat(*[elements[k] for k in plan.algebraic])
    ode = ca.vertcat(*[elements[plan.system.derivative[k]] for k in plan.states])
    alg = ca.vertcat(*[residuals[k] for k in plan.residuals])
    assigned, values = solved(plan.assigned)
    if plan.assigned:
        values, (ode, alg) = inlined(assigned, values, [ode, alg])
    observed = solved(plan.observed)
    definitions = ca.vertcat(assigned, observed[0]), ca.vertcat(values, observed[1])
    continuous = flat.discontinuities.continuous + _switching(flat, plan, residuals)
    names = _names(flat, plan)
    return ReducedModel(
        flat,
        plan,
        unknowns,
        names,
        x,
        z,
        ode,
        alg,
        definitions,
        projections,
        continuous,
        tuple(residuals),
        table_kinks(flat, plan),
    )


def _switching(flat: FlatModel, plan: Plan, residuals: list[ca.SX]) -> tuple[tuple[ca.SX, Origin], ...]:
    """Return the differentiated residuals that depend on switches, with their origins."""
    constants, origins = flat.discontinuities.constants, flat.equations.origins
    if not constants.numel():
        return ()
    source = [*range(len(origins)), *plan.differentiated]
    found = []
    for row in dict.fromkeys(plan.differentiated):
        if ca.depends_on(residuals[row], constants):
            first = row
            while first >= len(origins):
                first = source[first]
            found.append((residuals[row], origins[first]))
    return tuple(found)


def _names(flat: FlatModel, plan: Plan) -> tuple[str, ...]:
    """Return the names of all unknowns; an integrated variable has the name of its coordinate."""
    names = list(flat.unknowns.names)
    for k in plan.created:
        names.append(f"der({names[k]})")
    names += [""] * (plan.system.n_variables - len(names))
    for constraint in plan.constrained.constraints:
        for multiplier in constraint.multipliers:
            names[multiplier] = f"projection[{multiplier}]"
    for p in plan.constrained.projections:
        names[p.state], names[p.state_rate] = names[p.coordinate], f"der({names[p.coordinate]}) integrated"
    return tuple(names)


def _differentiate(
    flat: FlatModel, plan: Plan, unknowns: ca.SX, linear: Incidence
) -> tuple[list[ca.SX], dict[tuple[int, int], ca.SX]]:
    """Return the residuals with the differentiated ones appended, and the constant coefficients."""
    elements = scalars(unknowns)
    seeds = [elements[d] if d >= 0 else ca.SX(0) for d in plan.system.derivative]
    for k, expression in flat.unknowns.declared.items():
        if plan.system.derivative[k] < 0:
            seeds[k] = expression
    for p in plan.constrained.projections:
        seeds[p.coordinate] = elements[p.rate]
    at, direction = ca.vertcat(unknowns, time.sx), ca.vertcat(*seeds, 1)
    residuals, explicit = scalars(flat.equations.residuals), dict(linear.explicit)
    for row, columns in linear.cancelled.items():
        gone = ca.vertcat(*[elements[k] for k in columns])
        residuals[row] = ca.substitute(residuals[row], gone, ca.SX.zeros(len(columns)))
    others = ca.vertcat(time.sx, initial.sx, flat.discontinuities.constants)
    first = len(residuals)
    residuals += [ca.SX(0)] * len(plan.differentiated)
    for level in _orders(plan, first):
        column = ca.vertcat(*[residuals[plan.differentiated[row - first]] for row in level])
        derivative = ca.densify(ca.jtimes(column, at, direction))
        for row, entry in zip(level, scalars(derivative), strict=True):
            residuals[row] = entry
        explicit.update({(level[i], j): c for (i, j), c in jacobian(derivative, unknowns, others).explicit.items()})
    return residuals, explicit


def _orders(plan: Plan, first: int) -> list[list[int]]:
    """Return the rows of first derivatives, of second derivatives, and so on."""
    order, found = dict[int, int](), dict[int, list[int]]()
    for row, source in enumerate(plan.differentiated, first):
        order[row] = order.get(source, 0) + 1
        found.setdefault(order[row], []).append(row)
    return [found[k] for k in sorted(found)]
