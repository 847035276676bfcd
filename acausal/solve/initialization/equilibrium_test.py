"""Equilibrium test: all derivatives vanish but for round-off, however the point was found."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.call import Call
from acausal.compiler.memo import memoized, memoized_latest
from acausal.compiler.rounding import terms
from acausal.policy import POLICY
from acausal.solve.diagnosis.initialization import equation_text
from acausal.solve.initialization.rank import factored
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.symbols import scalars, stacked

NEWTON = POLICY.newton


@memoized
def counters(compiled: CompiledModel) -> list[int]:
    """States on which no equation depends and whose rates are not differentiated, such as integrals of a power."""
    r, system = compiled.reduced, compiled.reduced.plan.system
    used = np.array(ca.which_depends(ca.vertcat(r.ode, r.alg, ca.SX(0)), r.x, 1, False), dtype=bool)
    counting = [system.derivative[system.derivative[v]] < 0 for v in r.plan.states]
    return np.flatnonzero(~used & np.array(counting, dtype=bool)).tolist() if used.size else []


@memoized
def kinematic(compiled: CompiledModel, drifts: bool = False) -> list[int]:
    """States whose rates follow from other states without any parameter, such as the position of a free body.

    `drifts` ignores the feedback of invariants, so that quaternions are kinematic, too.
    """
    if not compiled.nx:
        return []
    r = compiled.reduced
    constants = r.constants[:-1] if drifts else r.constants  # the last one is the feedback
    given = ca.vertcat(r.p, constants, ca.SX.sym("none"))
    forced = np.array(ca.which_depends(ca.vertcat(r.alg, r.ode, 0), given, 1, True)[:-1], dtype=bool)
    unknowns = compiled.dependence.needing(np.flatnonzero(forced[: compiled.nz]).tolist())
    through = ca.vertcat(*(r.z[k] for k in sorted(unknowns)), ca.SX.sym("none"))
    driven = forced[compiled.nz :] | np.array(ca.which_depends(ca.vertcat(r.ode, 0), through, 1, True)[:-1], dtype=bool)
    uses = np.zeros((compiled.nx, compiled.nx), dtype=bool)
    uses[tuple(np.array(k, dtype=int) for k in ca.jacobian_sparsity(r.ode, r.x).get_triplet())] = True  # type: ignore[attr-defined]
    return np.flatnonzero(~driven & uses[:, driven].any(axis=1)).tolist()


def at_rest(problem: Problem, at: Point) -> bool:
    """Return whether all derivatives vanish, loops are closed, and equations and initial conditions hold."""
    return not _moving(problem, at, one=True) and loops_closed(problem, at) and equations_hold(problem, at)


def loops_closed(problem: Problem, at: Point) -> bool:
    """Return whether all constraints hold."""
    return not problem.compiled.constraints.size or bool(
        np.max(np.abs(problem.closure_errors(at))) <= NEWTON.consistent
    )


def equations_hold(problem: Problem, at: Point) -> bool:
    """Return whether algebraic equations and initial conditions hold."""
    nx, local = problem.nx, problem.local(at)
    allowed = _tolerance(local.jacobian, at.y, problem.nominal, NEWTON.consistent)
    return bool(np.all(np.abs(local.value[nx:]) <= allowed[nx:]))


def rates_allowed(problem: Problem, at: Point) -> np.ndarray:
    """Tolerances within which the derivatives of the states count as 0."""
    J = problem.local(at).jacobian.tocsr()[: problem.nx]
    return _tolerance(J, at.y, problem.nominal, POLICY.rest.still) + abs(J)[:, problem.nx :] @ _noise(problem, at)


def motion_text(problem: Problem, at: Point) -> str:
    """Return the message on rates that do not vanish, or on conditions that the equilibrium violates."""
    compiled, nx, nz, t = problem.compiled, problem.nx, problem.nz, at.time
    moving = _moving(problem, at)
    if moving:
        lines = [f"no equilibrium was found near the guesses at t = {t:g} s; these rates remain:"]
        lines += [f"  {name} = 0: off by {value:.4g}" for name, value in moving[:5]]
        lines.append(
            "An unbalanced force drives it, such as a weight without support or a torque without a brake: support it, brake "
            "it, or stop the drive; or give guesses closer to an equilibrium."
        )
        return "\n".join(lines)
    local = problem.local(at)
    value, allowed = local.value, _tolerance(local.jacobian, at.y, problem.nominal, NEWTON.consistent)
    lines = [f"at t = {t:g} s the model has an equilibrium, but it violates initial conditions:"]
    against = [k for k in range(nx + nz, len(value)) if abs(value[k]) > allowed[k]]
    for k in sorted(against, key=lambda k: -abs(value[k]))[:5]:
        condition = compiled.reduced.flat.equations.initial[k - nx - nz]
        lines.append(f"  {condition.text}: off by {value[k]:.4g} ({condition.origin})")
    wrong = [k for k in range(nx, nx + nz) if abs(value[k]) > allowed[k]]
    lines += [f"  {equation_text(compiled, k - nx)}: off by {value[k]:.4g}" for k in wrong[:5]]
    lines.append("Make them guesses, guess(...) instead of fixed(...), or leave the initial equations out.")
    return "\n".join(lines)


def _moving(problem: Problem, at: Point, one: bool = False) -> list[tuple[str, float]]:
    """Derivatives that do not vanish, the largest first; with `one`, only the largest relative to its tolerance if any."""
    names, call, (rows, columns, shape), _ = derivatives(problem.compiled)
    given = at.x, at.z, problem.p, at.time, at.constants.vector, 0.0
    value, entries = call(*given)
    J = scipy.sparse.csr_matrix((entries, (rows, columns)), shape=shape)
    allowed = _tolerance(J, at.y, problem.nominal, POLICY.rest.still)
    if not np.all(np.abs(value) <= allowed):
        allowed = allowed + abs(J)[:, problem.nx :] @ _noise(problem, at)
    wrong = np.flatnonzero(~(np.abs(value) <= allowed))
    order = np.argsort(-np.abs(value[wrong]) / allowed[wrong], kind="stable")[:1]
    for some in (wrong[order], wrong) if one else (wrong,):
        moving = some[~(np.abs(value[some]) <= allowed[some] + _slope_round_off(problem, at, J[some], some))]
        if len(moving):
            break
    order = moving[np.argsort(-np.abs(value[moving]))]
    return [(names[k], float(value[k])) for k in order]


def _slope_round_off(problem: Problem, at: Point, J: scipy.sparse.csr_matrix, rows: np.ndarray) -> np.ndarray:
    """Further tolerance of rows whose slopes are round-off, as for a frame on the axis at the end of a chain."""
    if not len(rows):
        return np.zeros(0)
    call, places = _slope_terms(problem.compiled, tuple(rows.tolist()))
    entries = call(at.x, at.z, problem.p, at.time, at.constants.vector, 0.0)[0]
    whole = scipy.sparse.csr_matrix((entries, places), shape=J.shape)
    most, adds_up = (abs(M) @ problem.nominal for M in (J, whole))
    return np.where(most <= POLICY.ranks.rank * adds_up, POLICY.rest.still * adds_up, 0.0)


def _noise(problem: Problem, at: Point) -> np.ndarray:
    """Error of the algebraic unknowns by round-off of their equations: it accelerates stiff parts in equilibrium."""
    nx, nz = problem.nx, problem.nz
    J = problem.local(at).jacobian[nx : nx + nz].tocsc()
    if not (nz and np.all(np.isfinite(J.data))):
        return np.zeros(nz)
    signs = np.random.default_rng(0).choice([-1.0, 1.0], (nz, POLICY.rest.signs))
    solve = factored(J[:, nx:], problem.nominal[nx:], POLICY.ranks.rank)
    return np.nan_to_num(np.max(np.abs(solve(_round_off(J, at.y)[:, None] * signs)), axis=1))


@memoized
def derivatives(
    compiled: CompiledModel,
) -> tuple[list[str], Call, tuple[np.ndarray, np.ndarray, tuple[int, int]], list[int]]:
    """Names of all derivatives but of counters, their values and Jacobian, its pattern, and the unknowns of the first ones."""
    r = compiled.reduced
    plan, elements = r.plan, scalars(r.unknowns)
    left_out = {plan.states[k] for k in counters(compiled)}
    pairs = [(v, d) for v, d in enumerate(plan.system.derivative) if d >= 0 and v not in left_out]
    pairs += [(q.coordinate, q.rate) for q in plan.constrained.projections]
    names = [f"der({r.names[v]})" for v, _ in pairs] + [f"der({r.names[v]})" for v in r.flat.unknowns.declared]
    column = stacked([*[elements[d] for _, d in pairs], *r.flat.unknowns.declared.values()])
    column = ca.densify(r.resolve(column))
    J = ca.jacobian(column, ca.vertcat(r.x, r.z))
    call = Call(ca.Function("derivatives", compiled.arguments, [column, J]))
    rows, columns = (np.array(k, dtype=int) for k in J.sparsity().get_triplet())
    return names, call, (rows, columns, J.shape), [v for v, _ in pairs]


@memoized_latest(2)
def _slope_terms(compiled: CompiledModel, rows: tuple[int, ...]) -> tuple[Call, tuple[np.ndarray, np.ndarray]]:
    """Sizes of the terms of some rows of the Jacobian of the derivatives, and their places, see `rounding.terms`."""
    J = derivatives(compiled)[1].function.call(compiled.arguments)[1]
    J = ca.vertcat(*(J[k, :] for k in rows))
    places = tuple(np.array(k, dtype=int) for k in J.sparsity().get_triplet())
    column = stacked(scalars(J.nz[:]))
    return Call(ca.Function("terms", compiled.arguments, [terms(compiled.arguments, column)])), (places[0], places[1])


def _tolerance(J: Any, y: np.ndarray, nominal: np.ndarray, part: float) -> np.ndarray:
    """Tolerance of each row: a part of its change with nominal values, of 1 for a constant row, and its round-off."""
    most = abs(J) @ nominal
    return part * np.where(most > 0, most, 1.0) + _round_off(J, y)


def _round_off(J: Any, y: np.ndarray) -> np.ndarray:
    """Round-off of rows, from that of their terms."""
    return NEWTON.terms * np.finfo(float).eps * (abs(J) @ np.abs(y))
