"""Whether a model is at rest: all its derivatives vanish, however the point was found."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.call import Call
from acausal.compiler.once import latest, once
from acausal.compiler.rounding import terms
from acausal.policy import POLICY
from acausal.solve.diagnosis.initialization import equation_text
from acausal.solve.initialization.rank import factored
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.symbols import scalars, stacked

NEWTON = POLICY.newton


@once
def meters(compiled: CompiledModel) -> list[int]:
    """States on which nothing depends, and whose rates are not differentiated: counters that hold nothing."""
    r, system = compiled.reduced, compiled.reduced.plan.system
    used = np.array(ca.which_depends(ca.vertcat(r.ode, r.alg, ca.SX(0)), r.x, 1, False), dtype=bool)
    counting = [system.derivative[system.derivative[v]] < 0 for v in r.plan.states]
    return np.flatnonzero(~used & np.array(counting, dtype=bool)).tolist() if used.size else []


@once
def kinematic(compiled: CompiledModel, drifts: bool = False) -> list[int]:
    """States whose rates follow from other states without any parameter, as the position of a free body does.

    So do those of a quaternion, but for the feedback that keeps its norm; `drifts` leaves that out.
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
    """Whether all derivatives vanish, loops are closed, and equations and initial conditions hold."""
    return not _moving(problem, at, one=True) and loops_closed(problem, at) and equations_hold(problem, at)


def loops_closed(problem: Problem, at: Point) -> bool:
    """Whether all constraints hold."""
    return not problem.compiled.constraints.size or bool(
        np.max(np.abs(problem.closure_errors(at))) <= NEWTON.consistent
    )


def equations_hold(problem: Problem, at: Point) -> bool:
    """Whether algebraic equations and initial conditions hold."""
    nx, local = problem.nx, problem.local(at)
    allowed = _allowed(local.jacobian, at.y, problem.nominal, NEWTON.consistent)
    return bool(np.all(np.abs(local.value[nx:]) <= allowed[nx:]))


def rates_allowed(problem: Problem, at: Point) -> np.ndarray:
    """What the derivatives of the states may be where they vanish."""
    J = problem.local(at).jacobian.tocsr()[: problem.nx]
    return _allowed(J, at.y, problem.nominal, POLICY.rest.still) + abs(J)[:, problem.nx :] @ _unsure(problem, at)


def motion_text(problem: Problem, at: Point) -> str:
    """Say what moves where everything else has come to rest, or which conditions prevent it."""
    compiled, nx, nz, t = problem.compiled, problem.nx, problem.nz, at.time
    moving = _moving(problem, at)
    if moving:
        lines = [f"no equilibrium was found near the guesses at t = {t:g} s; what keeps moving:"]
        lines += [f"  {name} = 0: off by {value:.4g}" for name, value in moving[:5]]
        lines.append(
            "Something drives it endlessly, such as weight that nothing carries or a torque that nothing brakes: hold it, "
            "brake it, or stop the drive; or give guesses closer to rest."
        )
        return "\n".join(lines)
    local = problem.local(at)
    value, allowed = local.value, _allowed(local.jacobian, at.y, problem.nominal, NEWTON.consistent)
    lines = [f"at t = {t:g} s the model can rest, but not where its initial conditions hold:"]
    against = [k for k in range(nx + nz, len(value)) if abs(value[k]) > allowed[k]]
    for k in sorted(against, key=lambda k: -abs(value[k]))[:5]:
        condition = compiled.reduced.flat.equations.initial[k - nx - nz]
        lines.append(f"  {condition.text}: off by {value[k]:.4g} ({condition.origin})")
    wrong = [k for k in range(nx, nx + nz) if abs(value[k]) > allowed[k]]
    lines += [f"  {equation_text(compiled, k - nx)}: off by {value[k]:.4g}" for k in wrong[:5]]
    lines.append("Make them guesses, guess(...) instead of fixed(...), or leave the initial equations out.")
    return "\n".join(lines)


def _moving(problem: Problem, at: Point, one: bool = False) -> list[tuple[str, float]]:
    """Derivatives that do not vanish, the largest first; with `one`, the one that does so most clearly is enough."""
    names, call, (rows, columns, shape), _ = derivatives(problem.compiled)
    given = at.x, at.z, problem.p, at.time, at.constants.vector, 0.0
    value, entries = call(*given)
    J = scipy.sparse.csr_matrix((entries, (rows, columns)), shape=shape)
    allowed = _allowed(J, at.y, problem.nominal, POLICY.rest.still)
    if not np.all(np.abs(value) <= allowed):
        allowed = allowed + abs(J)[:, problem.nx :] @ _unsure(problem, at)
    wrong = np.flatnonzero(~(np.abs(value) <= allowed))
    order = np.argsort(-np.abs(value[wrong]) / allowed[wrong], kind="stable")[:1]
    for some in (wrong[order], wrong) if one else (wrong,):
        moving = some[~(np.abs(value[some]) <= allowed[some] + _beside_rounding(problem, at, J[some], some))]
        if len(moving):
            break
    order = moving[np.argsort(-np.abs(value[moving]))]
    return [(names[k], float(value[k])) for k in order]


def _beside_rounding(problem: Problem, at: Point, J: scipy.sparse.csr_matrix, rows: np.ndarray) -> np.ndarray:
    """What rows may be besides that move nothing, as a frame on an axis at the end of a chain: their slopes are rounding."""
    if not len(rows):
        return np.zeros(0)
    call, places = _terms(problem.compiled, tuple(rows.tolist()))
    entries = call(at.x, at.z, problem.p, at.time, at.constants.vector, 0.0)[0]
    whole = scipy.sparse.csr_matrix((entries, places), shape=J.shape)
    most, adds_up = (abs(M) @ problem.nominal for M in (J, whole))
    return np.where(most <= POLICY.ranks.rank * adds_up, POLICY.rest.still * adds_up, 0.0)


def _unsure(problem: Problem, at: Point) -> np.ndarray:
    """How far the rounding of their equations moves the algebraic unknowns: stiff parts at rest accelerate by it."""
    nx, nz = problem.nx, problem.nz
    J = problem.local(at).jacobian[nx : nx + nz].tocsc()
    if not (nz and np.all(np.isfinite(J.data))):
        return np.zeros(nz)
    signs = np.random.default_rng(0).choice([-1.0, 1.0], (nz, POLICY.rest.signs))
    solve = factored(J[:, nx:], problem.nominal[nx:], POLICY.ranks.rank)
    return np.nan_to_num(np.max(np.abs(solve(_rounding(J, at.y)[:, None] * signs)), axis=1))


@once
def derivatives(
    compiled: CompiledModel,
) -> tuple[list[str], Call, tuple[np.ndarray, np.ndarray, tuple[int, int]], list[int]]:
    """Names of all derivatives but those of meters, values and Jacobian, its pattern, and of which unknowns the first are."""
    r = compiled.reduced
    plan, elements = r.plan, scalars(r.unknowns)
    apart = {plan.states[k] for k in meters(compiled)}
    pairs = [(v, d) for v, d in enumerate(plan.system.derivative) if d >= 0 and v not in apart]
    pairs += [(q.coordinate, q.rate) for q in plan.constrained.projections]
    names = [f"der({r.names[v]})" for v, _ in pairs] + [f"der({r.names[v]})" for v in r.flat.unknowns.declared]
    column = stacked([*[elements[d] for _, d in pairs], *r.flat.unknowns.declared.values()])
    column = ca.densify(r.resolve(column))
    J = ca.jacobian(column, ca.vertcat(r.x, r.z))
    call = Call(ca.Function("derivatives", compiled.arguments, [column, J]))
    rows, columns = (np.array(k, dtype=int) for k in J.sparsity().get_triplet())
    return names, call, (rows, columns, J.shape), [v for v, _ in pairs]


@latest(2)
def _terms(compiled: CompiledModel, rows: tuple[int, ...]) -> tuple[Call, tuple[np.ndarray, np.ndarray]]:
    """Sizes of what adds up in some rows of the Jacobian of the derivatives, and their places, see `rounding.terms`."""
    J = derivatives(compiled)[1].function.call(compiled.arguments)[1]
    J = ca.vertcat(*(J[k, :] for k in rows))
    places = tuple(np.array(k, dtype=int) for k in J.sparsity().get_triplet())
    column = stacked(scalars(J.nz[:]))
    return Call(ca.Function("terms", compiled.arguments, [terms(compiled.arguments, column)])), (places[0], places[1])


def _allowed(J: Any, y: np.ndarray, nominal: np.ndarray, part: float) -> np.ndarray:
    """What each row may be: a part of what nominal values make of it, of 1 if it holds constants only, and rounding."""
    most = abs(J) @ nominal
    return part * np.where(most > 0, most, 1.0) + _rounding(J, y)


def _rounding(J: Any, y: np.ndarray) -> np.ndarray:
    """Rounding of rows, by that of their terms."""
    return NEWTON.terms * np.finfo(float).eps * (abs(J) @ np.abs(y))
