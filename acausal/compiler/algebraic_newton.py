"""Newton steps for the algebraic unknowns, block by block of the block-triangular form."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from acausal.compiler.vectorized import Vectorized
from acausal.reduce import Level, solution_levels


@dataclass(frozen=True)
class NewtonStep:
    """A Newton step for a block of algebraic unknowns, given the solution of the blocks before it.

    Parameters
    ----------
    unknowns : array of int
        Positions among the algebraic unknowns.
    linear : bool
        Whether the block is linear: one step solves it, up to round-off.
    function : Vectorized
        Function of x, z, parameters, time and constants: these unknowns after the step.
    """

    unknowns: np.ndarray
    linear: bool
    function: Vectorized


def newton_steps(
    residuals: ca.SX, z: ca.SX, arguments: list[ca.SX], unknowns: np.ndarray, equations: np.ndarray
) -> tuple[NewtonStep, ...]:
    """Return the Newton steps that solve equations for unknowns; `equations[i]` is matched with `unknowns[i]`.

    Each nonlinear block is a step of its own; the linear blocks between two of them form one step.
    """
    alg, own = residuals[equations.tolist()], z[unknowns.tolist()]
    J = ca.jacobian(alg, own)
    steps = [(level, _step(arguments, alg, J, level, unknowns)) for level in solution_levels(J, own)]
    together: list[list[tuple[Level, ca.Function]]] = []
    for level, step in steps:
        if not (level.linear and together and together[-1][-1][0].linear):
            together.append([])
        together[-1].append((level, step))
    return tuple(_joined(arguments, some, unknowns) for some in together)


def _step(arguments: list[ca.SX], alg: ca.SX, J: ca.SX, level: Level, unknowns: np.ndarray) -> ca.Function:
    """Function of x, z, parameters, time and constants: z after a Newton step in the unknowns of a level."""
    rows, columns = list(level.equations), list(level.variables)
    parts = ca.Function("part", arguments, [ca.densify(alg[rows]), J[rows, columns]])
    given = [ca.MX.sym(f"a{k}", a.numel()) for k, a in enumerate(arguments)]
    value, matrix = parts(*given)
    places = unknowns[columns].tolist()
    z = ca.MX(given[1])
    z[places] = given[1][places] - ca.solve(matrix, value, "csparse")
    return ca.Function("step", given, [z])


def _joined(arguments: list[ca.SX], steps: list[tuple[Level, ca.Function]], unknowns: np.ndarray) -> NewtonStep:
    """Join the steps of several levels into one."""
    x, z, *others = (ca.MX.sym(f"a{k}", a.numel()) for k, a in enumerate(arguments))
    found = z
    for _, step in steps:
        found = step(x, found, *others)
    chosen = np.sort(np.concatenate([unknowns[list(level.variables)] for level, _ in steps]))
    function = ca.Function("newton", [x, z, *others], [found[chosen.tolist()]])
    return NewtonStep(chosen, steps[0][0].linear, Vectorized(function))
