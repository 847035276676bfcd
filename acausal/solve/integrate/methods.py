"""Methods of integration: the multistep method that follows everything, the one-step method that damps.

The one-step method (Rosenbrock, L-stable, order 5) sees rates only as far as they change coordinates: their size in the
error test is that of the coordinate times the fastest eigenvalue. Vibrations too small to be seen in the coordinates are
then damped instead of followed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal.compiler.call import Call
from acausal.compiler.dae import UNSEEN
from acausal.policy import POLICY
from acausal.solve.integrate.ladder import Way
from acausal.solve.integrate.settings import Settings
from acausal.solve.integrate.trace import Leg
from acausal.solve.points import Point, Rows
from acausal.solve.problem import Problem

CALLS = POLICY.calls


@dataclass(frozen=True)
class Setup:
    """Integrator of CasADi, its options, and the sizes of states and algebraic unknowns that it sees as 1, if it does."""

    plugin: str
    options: dict[str, Any]
    sizes: tuple[np.ndarray, np.ndarray] | None = None

    def give(self, call: Call, at: Point, p: np.ndarray) -> None:
        """Write where a call begins, and its parameters."""
        x_size, z_size = self.sizes or (1.0, 1.0)
        own = self.sizes[0] if self.sizes else []
        given = {"x0": at.x / x_size, "z0": at.z / z_size, "p": np.concatenate([p, own])}
        for k, name in enumerate(call.function.name_in()):
            if name in given:
                call.inputs[k][:] = given[name]
        call.clear()

    def leg(self, call: Call, at: Point, times: np.ndarray, steps: int = 0) -> Leg:
        """Return what a call from a point has found at its output times; integrals of power that it has not are 0."""
        out = dict(zip(call.function.name_out(), call.outputs, strict=True))
        n, (x_size, z_size) = call.function.size2_out("xf"), self.sizes or (1.0, 1.0)
        x, z = out["xf"].reshape(n, -1) * x_size, out["zf"].reshape(n, -1) * z_size
        energy = out["qf"].reshape(n, 2).copy() if out["qf"].size else np.zeros((n, 2))
        return Leg(Rows.within(times[1:], x, z, at.constants.vector), energy, at.constants, steps)


@dataclass(frozen=True)
class Method:
    """A method of integration.

    Attributes
    ----------
    set_up : callable
        Returns the `Setup` of a call, from the model, how the run and this call are to be integrated, where it begins, start
        and output times in s, and the errors that rounding causes, see `rounding`.
    counts : tuple of str
        What it calls its steps, factorisations and evaluations of the equations.
    multistep : bool
        Whether its order has a limit. Such methods follow every vibration, steps of the others cost several times as much.
    """

    set_up: Callable[[Problem, Settings, Way, Point, np.ndarray, np.ndarray], Setup]
    counts: tuple[str, str, str]
    multistep: bool

    def counted(self, stats: Mapping[str, Any]) -> tuple[int, ...]:
        """Return steps, factorisations and evaluations of a call."""
        return tuple(int(stats.get(name, 0)) for name in self.counts)


def _multistep(
    problem: Problem, settings: Settings, way: Way, at: Point, times: np.ndarray, floor: np.ndarray
) -> Setup:
    """IDAS: order limit, algebraic unknowns out of the error test, weights from nominal values.

    IDAS takes all first derivatives as 0 unless it computes them itself: the quick way lets it compute them, if any
    matter; the careful one starts with a step so short that they do not, and with the linear solver that does not rely on
    its pivots.
    """
    c, tolerance, nominal, span = problem.compiled, way.tolerance, settings.nominal, times[-1] - times[0]
    rates = problem.values(at)[: c.nx]
    weights = tolerance * (np.abs(at.x) + nominal[: c.nx])
    steepest = float(np.max(np.abs(rates) * span / weights, initial=0.0))
    options = {
        "reltol": tolerance,
        "abstolv": np.maximum(tolerance * nominal, floor).tolist(),
        "max_multistep_order": way.order,
        "suppress_algebraic": True,
        "max_num_steps": way.max_steps,
        "disable_internal_warnings": True,
        "quad_err_con": False,
        # Errors of a loose Newton iteration excite lightly damped vibrations, which then cost steps; near a singular
        # position of a loop they are enlarged.
        "nonlin_conv_coeff": CALLS.newton_in_loops if c.constraints.size else CALLS.newton,
        "show_eval_warnings": False,
        "linear_solver": "qr" if way.careful or c.nx + c.nz > CALLS.large else "csparse",
        "calc_ic": steepest > 1 and not (way.gentle or way.careful),
    }
    if (way.gentle or way.careful) and steepest > 1:
        options["step0"] = 10.0 ** -np.ceil(np.log10(steepest / CALLS.gentle))
    return Setup("idas", options)


def _one_step(
    problem: Problem, settings: Settings, way: Way, _at: Point, times: np.ndarray, _floor: np.ndarray
) -> Setup:
    """Rosenbrock method: one sequence of steps across all outputs, begun with a step that the fastest vibration resolves."""
    tolerance, fastest = way.tolerance, settings.fastest
    size = settings.nominal[: problem.nx].copy()
    for coordinate, rate in problem.rates:
        size[rate] = max(size[rate], size[coordinate] * fastest)
    options = {
        "reltol": tolerance,
        "abstol": tolerance,
        "control_group_size": [len(times) - 1],
        "quad_err_con": False,
        "max_num_steps": max(POLICY.rescue.fewest_long, way.max_steps),
        "show_eval_warnings": False,
    }
    if fastest > 0:
        options["step0"] = min(CALLS.first, 10.0 ** -np.ceil(np.log10(fastest * (times[-1] - times[0]))))
    return Setup("rosenbrock", options, (size, UNSEEN * problem.nominal[problem.nx :]))


# In the order in which they are taken: each leaves less to follow, or less to solve, than the one before it.
METHODS = {
    "idas": Method(_multistep, ("nsteps", "nlinsetups", "nfevals"), multistep=True),
    "rosenbrock": Method(_one_step, ("n_steps", "n_jac", "n_rhs"), multistep=False),
}


def chosen(method: str) -> tuple[str, ...]:
    """Return the methods that a run may take, the first one first, by the name that `simulate` was given."""
    own = {"auto": tuple(METHODS), "resolve": tuple(name for name, m in METHODS.items() if m.multistep)}
    return own.get(method, (method,))


def rounding(problem: Problem, at: Point) -> np.ndarray:
    """Errors of states (0) and algebraic unknowns that rounding of the equations causes, as powers of ten.

    A Newton iteration cannot get nearer than |g_z^-1| (|g_x| |x| + |g_z| |z|) times the relative rounding error.
    """
    nx = problem.nx
    J = np.abs(g := problem.local(at).jacobian[nx : nx + problem.nz].toarray())
    sizes = J @ np.abs(at.y)
    try:
        reach = np.abs(np.linalg.inv(g[:, nx:])) @ sizes
    except np.linalg.LinAlgError:
        reach = np.zeros(problem.nz)
    nominal = problem.nominal[nx:]
    floor = nominal * 10.0 ** np.ceil(np.log10(np.maximum(CALLS.rounding * reach / nominal, np.finfo(float).tiny)))
    return np.concatenate([np.zeros(nx), np.where(np.isfinite(floor), floor, 0.0)])
