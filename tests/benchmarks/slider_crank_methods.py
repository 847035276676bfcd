"""Benchmark: what makes the ringing slider-crank cheap, on the equations derived by hand.

    python -m tests.benchmarks.slider_crank_methods

When the torque stops at 0.7 s, the undamped crank rings at up to 5 kHz with amplitudes that nobody looks at, and a step
control that sees velocities follows. Methods: BDF of order 2 (IDAS) and the L-stable Rosenbrock method of order 5 of
CasADi, each with a factor on the absolute tolerance of all velocities. Errors are the largest of 401 points against the
time-converged solution of the same model, as a fraction of the range; the dissipated energy as a fraction of the supplied one.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from rich.console import Console
from rich.table import Table

from tests.benchmarks.slider_crank_by_hand import HandModel, build

SWITCH, STOP, INTERVALS = 0.7, 1.6, 400
REPEATS = 3


@dataclass(frozen=True)
class Method:
    """How to integrate.

    Attributes
    ----------
    plugin : str
        Of `casadi.integrator`: idas or rosenbrock.
    tolerance : float
        Relative; times the size of each state, 1 for angles and displacements, absolute.
    velocities : float, optional
        Size of every rate, angular velocity included, for the absolute tolerance; by default the fastest circular
        frequency at the start times the size of the coordinate: then a vibration weighs what its displacement weighs.
    elastic_only : bool
        Give that size to the rates of elastic coordinates alone.
    coordinates : float
        Size of the elastic coordinates.
    options : dict
        Of the plugin, over those chosen here.
    """

    plugin: str
    tolerance: float
    velocities: float | None = None
    elastic_only: bool = False
    coordinates: float = 1.0
    options: tuple[tuple[str, Any], ...] = ()


@dataclass(frozen=True)
class Run:
    """One run: a column of the model's outputs per time, energy supplied and stored, and the cost."""

    outputs: np.ndarray
    supplied: np.ndarray
    stored: np.ndarray
    solve_seconds: float
    steps: int
    factorisations: int
    residual_evaluations: int

    @property
    def dissipated(self) -> float:
        """What the method itself dissipated, as a fraction of the supplied energy."""
        return (self.supplied[-1] - self.stored[-1]) / self.supplied[-1]


def at_rest(model: HandModel) -> np.ndarray:
    """Algebraic unknowns at the start."""
    dae = model.dae
    residual = ca.substitute(dae["alg"], ca.vertcat(dae["t"], dae["p"], dae["x"]), ca.DM.zeros(2 + len(model.kinds)))
    solver = ca.rootfinder("start", "newton", {"x": dae["z"], "g": residual}, {"linear_solver": "csparse"})
    return np.array(solver(x0=0)["x"]).ravel()


def fastest(model: HandModel) -> float:
    """Largest circular frequency at the start."""
    dae = model.dae
    known = ca.vertcat(dae["x"], dae["z"], dae["t"], dae["p"])
    blocks = [ca.jacobian(dae[f], dae[y]) for f in ("ode", "alg") for y in ("x", "z")]
    start = [*np.zeros(len(model.kinds)), *at_rest(model), 0, 0]
    f_x, f_z, g_x, g_z = (np.array(block) for block in ca.Function("blocks", [known], blocks)(start))
    return float(np.abs(np.linalg.eigvals(f_x - f_z @ np.linalg.solve(g_z, g_x))).max())


def sizes(model: HandModel, method: Method) -> np.ndarray:
    """Size of each state in the error test."""
    if method.velocities is None:
        rate, elastic_rate = fastest(model), fastest(model) * method.coordinates
    else:
        rate, elastic_rate = 1.0 if method.elastic_only else method.velocities, method.velocities
    size = {"angle": 1.0, "rate": rate}
    return np.array([size.get(k, elastic_rate if k[0] == "d" else method.coordinates) for k in model.kinds])


def _scaled(model: HandModel, size: np.ndarray, z_size: float) -> dict[str, ca.SX]:
    """The DAE in unknowns over their size."""
    x, z, dae = ca.SX.sym("x", len(size)), ca.SX.sym("z", model.dae["z"].numel()), model.dae
    known = [dae["ode"], dae["alg"], dae["quad"]]
    ode, alg, quad = ca.substitute(known, [dae["x"], dae["z"]], [size * x, z_size * z])
    return {"t": dae["t"], "p": dae["p"], "x": x, "z": z, "ode": ode / size, "alg": alg, "quad": quad}


def _options(method: Method, outputs: int) -> dict[str, Any]:
    chosen: dict[str, Any] = {"reltol": method.tolerance, "abstol": method.tolerance, "quad_err_con": False}
    if method.plugin == "idas":
        chosen |= {"max_multistep_order": 2, "suppress_algebraic": True, "calc_ic": True, "nonlin_conv_coeff": 0.05}
        chosen |= {"linear_solver": "csparse", "max_num_steps": 1_000_000}
    else:
        # one run of steps across all outputs, where the default starts anew after each; a short first step, because
        # the torque jumps
        chosen |= {"control_group_size": [outputs], "step0": 3e-5}
    return chosen | dict(method.options)


def simulate(model: HandModel, method: Method, repeats: int = 1) -> Run:
    """Integrate from rest, in one call before and one after the torque stops.

    Parameters
    ----------
    model : HandModel
        The DAE.
    method : Method
        Integrator, tolerance and weights.
    repeats : int
        Runs; the fastest counts in `solve_seconds`, without the construction of the integrators.
    """
    # IDAS can leave algebraic unknowns out of the error test, the other method must not see them
    size, z_size = sizes(model, method), 1.0 if method.plugin == "idas" else 1e10
    dae = _scaled(model, size, z_size)
    grid = np.linspace(0.0, STOP, INTERVALS + 1)
    cut = round(SWITCH / STOP * INTERVALS)
    x, z = np.zeros((len(size), len(grid))), np.zeros((model.dae["z"].numel(), len(grid)))
    supplied, counts, seconds = np.zeros(len(grid)), np.zeros(3, int), 0.0
    z[:, 0] = at_rest(model)
    for on, first, last in ((1.0, 0, cut), (0.0, cut, INTERVALS)):
        times, options = grid[first : last + 1], _options(method, last - first)
        integrator = ca.integrator("run", method.plugin, dae, times[0], list(times[1:]), options)
        taken = []
        for _ in range(repeats):
            start = time.perf_counter()
            run = integrator(x0=x[:, first] / size, z0=z[:, first] / z_size, p=on)
            taken.append(time.perf_counter() - start)
        seconds += min(taken)
        here = slice(first + 1, last + 1)
        x[:, here], z[:, here] = np.array(run["xf"]) * size[:, None], np.array(run["zf"]) * z_size
        supplied[here] = supplied[first] + np.array(run["qf"]).ravel()
        stats = integrator.stats()
        names = ("nsteps", "nlinsetups", "nfevals") if method.plugin == "idas" else ("n_steps", "n_jac", "n_rhs")
        counts += [stats[name] for name in names]
    stored = np.array(model.energy(x, z)).ravel()
    return Run(np.array(model.outputs(x, z)), supplied, stored, seconds, *(int(n) for n in counts))


CONVERGED = Method("rosenbrock", 1e-5, 10.0)
METHODS = (
    Method("idas", 1e-3, 1.0),
    *(Method("idas", 1e-4, size, elastic_only=True) for size in (10.0, 68.0, 1e3)),
    Method("idas", 1e-4, 1e3),
    *(Method("idas", 1e-5, 1e3, coordinates=size) for size in (1.0, 0.1, 0.01)),
    Method("idas", 1e-6, 1e4),
    Method("rosenbrock", 1e-4, 1.0),
    *(Method("rosenbrock", tolerance, 1e3) for tolerance in (1e-4, 3e-5, 1e-5)),
    *(Method("rosenbrock", tolerance) for tolerance in (1e-3, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6)),
)


def main() -> None:
    """Print the table."""
    model = build()
    exact = simulate(model, CONVERGED).outputs
    spread = np.ptp(exact, axis=1)
    table = Table("method", "tolerance", "rates", "elastic q", "ms", "steps", "LU", "residuals")
    for name in ("slider", "mid", "dissipated"):
        table.add_column(name)
    for method in METHODS:
        run = simulate(model, method, REPEATS)
        error = np.abs(run.outputs - exact).max(axis=1) / spread
        rates = "fastest" if method.velocities is None else f"{method.velocities:g}" + " elastic" * method.elastic_only
        row = [
            method.plugin,
            f"{method.tolerance:g}",
            rates,
            f"{method.coordinates:g}",
            f"{1e3 * run.solve_seconds:.0f}",
        ]
        row += [str(n) for n in (run.steps, run.factorisations, run.residual_evaluations)]
        table.add_row(*row, f"{error[1]:.1e}", f"{error[3]:.1e}", f"{run.dissipated:.1e}")
    Console(width=125).print(table)


if __name__ == "__main__":
    main()
