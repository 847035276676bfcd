"""Warnings about a linearisation point: it is not an equilibrium, or the linear system is periodic."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized
from acausal.errors import caution
from acausal.flatten.component_tree import walk
from acausal.language.functions import time
from acausal.solve.initialization.equilibrium_test import at_rest, counters, rates_allowed
from acausal.solve.initialization.steady_rotation import SteadyRotation, changes, cyclic_spaces, steady_rotation
from acausal.solve.point import Point
from acausal.solve.problem import Problem

NAMED = 3  # rates that a warning names


def check_point(problem: Problem, at: Point, slopes_at: Callable[[Point], np.ndarray]) -> None:
    """Warn if deviations from a point do not follow a linear system with constant matrices.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        The point of linearisation.
    slopes_at : callable
        Returns the derivatives of rates and outputs by states and inputs at a point.
    """
    by_time, constant = _depends(problem.compiled)
    rates = problem.local(at).value[: problem.nx]
    if constant or not (by_time or len(_moving(problem, at, rates))) or at_rest(problem, at):
        return
    spaces = cyclic_spaces(problem, at)
    turn = steady_rotation(problem, at, spaces)
    if turn is None:
        rates = SteadyRotation(spaces[0], np.zeros(problem.nx), np.inf).others(problem, at)
        moving = _moving(problem, at, rates)
        if len(moving):
            caution(_no_equilibrium_text(problem, at.time, rates, moving))
    elif changing := _changing(problem, slopes_at(at), slopes_at(turn.on(problem, at, 1.0))):
        caution(_periodic_text(problem, turn, changing))


@memoized
def _depends(compiled: CompiledModel) -> tuple[bool, bool]:
    """Return whether the equations of motion depend on time, and whether they are linear with constant coefficients."""
    running, unknowns = compiled.reduced.running, ca.vertcat(compiled.reduced.x, compiled.reduced.z)
    column = ca.vertcat(running.ode, running.alg, 0)
    by_time = any(ca.which_depends(column, time.sx, 1, True))
    linear = not unknowns.numel() or not any(ca.which_depends(column, unknowns, 2, True))
    coefficients = ca.jacobian(column, unknowns)
    return by_time, linear and not ca.depends_on(coefficients, time.sx)


def _moving(problem: Problem, at: Point, rates: np.ndarray) -> np.ndarray:
    """Return the states with nonzero rates, the largest relative to their nominal values first."""
    moving = np.setdiff1d(np.flatnonzero(~(np.abs(rates) <= rates_allowed(problem, at))), counters(problem.compiled))
    return moving[np.argsort(-np.abs(rates[moving]) / problem.nominal[moving], kind="stable")]


def _changing(problem: Problem, here: np.ndarray, there: np.ndarray) -> str:
    """Return the names of the matrices that differ between two points."""
    nx = problem.nx
    columns = np.append(problem.nominal[:nx], np.ones(here.shape[1] - nx))
    differs = changes(here * columns, there * columns)
    parts = {"A": differs[:nx, :nx], "B": differs[:nx, nx:], "C": differs[nx:, :nx], "D": differs[nx:, nx:]}
    return ", ".join(name for name, part in parts.items() if part.any())


def _no_equilibrium_text(problem: Problem, at: float, rates: np.ndarray, moving: np.ndarray) -> str:
    compiled = problem.compiled
    names = [compiled.states[k] for k in moving]
    largest = ", ".join(
        f"der({name}) = {rates[k] / problem.nominal[k]:.4g}"
        for k, name in list(zip(moving.tolist(), names, strict=True))[:NAMED]
    )
    parts = [
        part._path
        for part in walk(compiled.tree)
        if "static" in (getattr(part.fields.get("initial"), "choices", None) or ())
        and getattr(part, "initial", None) != "static"
        and any(name.startswith(f"{part._path}.") for name in names)
    ]
    static = f', or initial="static" of {", ".join(parts)}' if parts else ""
    return (
        f"{type(compiled.tree).__name__} is linearised about a point that is not an equilibrium, t = {at:g} s: {largest} in "
        "nominal values per s. Eigenvalues and frequencies are not those of small motions about a steady state. "
        f'Do this: linearize(..., initial="steady"){static}.'
    )


def _periodic_text(problem: Problem, turn: SteadyRotation, changing: str) -> str:
    compiled, size = problem.compiled, problem.nominal[: problem.nx]
    fastest = int(np.argmax(np.abs(turn.rates) / size)) if turn.rates.any() else -1
    what = f"{compiled.states[fastest]} turns" if fastest >= 0 else "time goes on"
    what_it_means = (
        "Eigenvalues at one position do not determine the stability of the motion"
        if "A" in changing
        else "Responses at one position do not hold at others"
    )
    return (
        f"the linear system of {type(compiled.tree).__name__} is periodic: {changing} change{'' if ',' in changing else 's'} as "
        f"{what}. {what_it_means}. Do this: linearise at several positions, or integrate over one period (Floquet)."
    )
