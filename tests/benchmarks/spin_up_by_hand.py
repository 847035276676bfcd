"""The spin-up manoeuvre of a substructured flexible beam, derived by hand for this one planar mechanism.

No component library: the equations below were written down for a chain of planar beam volumes and nothing else, so
that their size and speed are the mark for what a compiler makes of general components, and their results an independent
check. They follow Schiavo, Vigano, Ferretti (2006), sections 3 and 5.4, with formulas derived anew.

One volume is one Euler-Bernoulli element of length l in its own frame, tangent at its root and moving with acceleration
a, angular acceleration z and angular velocity w, all resolved in the frame. A material point x is at

    r_x = x (1 + q1/l),    r_y = H2(x) q2 + H3(x) q3    (H2, H3: the Hermite cubics of eq. (6) that belong to the tip)

and has the acceleration a + z J r - w^2 r + 2 w J r' + r'' (r', r'' in the frame; J turns by a right angle), that is,

    acc_x = a_x + (q1''/l - w^2 (1 + q1/l)) x - (z q2 + 2 w q2') H2 - (z q3 + 2 w q3') H3
    acc_y = a_y + (z (1 + q1/l) + 2 w q1'/l) x + (q2'' - w^2 q2) H2 + (q3'' - w^2 q3) H3

so every inertia term, centrifugal, Coriolis and Euler, is a product of coefficients on the basis B = (1, x, H2, H3)
with the one 4 x 4 Gram matrix of B. At an interface the next frame is turned by q3, the section's rotation as a finite
angle; the cut moment works on q3.

Unknowns of a volume: a_x, a_y, z, w (known for the first volume), the accelerations b = q'', and the cut load f_x, f_y,
t at its root.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cache
from typing import Any

import casadi as ca
import numpy as np
import sympy as sp

from acausal.core import End, make_equations
from tests.acausal.core.stepper import Stepper


@dataclass(frozen=True)
class Beam:
    """The beam of section 5.4, in SI units."""

    length: float = 8.0
    A: float = 7.299e-5
    J: float = 8.214e-9
    rho: float = 2767.0
    E: float = 6.895e10


@dataclass(frozen=True)
class HandModel:
    """Semi-explicit DAE of the manoeuvre.

    Attributes
    ----------
    dae : dict
        ``t x z ode alg`` for `casadi.integrator`; volume by volume q, q' in x and the unknowns named above in z.
    theta : casadi.Function
        Hub angle, eq. (18), and its first two derivatives, of time.
    hub_torque : int
        Place in z of the torque of the hub on the beam.
    """

    dae: dict[str, ca.SX]
    theta: ca.Function
    hub_torque: int
    beam: Beam
    volumes: int

    @property
    def n_states(self) -> int:
        """Number of differential states."""
        return self.dae["x"].numel()

    @property
    def n_algebraic(self) -> int:
        """Number of algebraic unknowns."""
        return self.dae["z"].numel()


@dataclass(frozen=True)
class HandRun:
    """One run: the tip in the frame that turns with the hub, all unknowns (a column per time), and its cost."""

    time: np.ndarray
    tip_deflection: np.ndarray
    tip_extension: np.ndarray
    states: np.ndarray
    algebraic: np.ndarray
    solve_seconds: float
    steps: int
    factorisations: int
    residual_evaluations: int
    jacobian_nonzeros: int


@cache
def element(length: float, beam: Beam) -> tuple[np.ndarray, np.ndarray]:
    """Integrals of one element, exact in the shape functions.

    Returns
    -------
    gram : ndarray
        Integral of B B' over the mass, B = (1, x, H2, H3).
    stiffness : ndarray
        For q1, q2, q3: appendix B's rows and columns of the tip, with 12EJ/l^3 and 6EJ/l^2 in their places.
    """
    x, l = sp.symbols("x l")
    xi = x / l
    basis = sp.Matrix([1, x, 3 * xi**2 - 2 * xi**3, l * (xi**3 - xi**2)])
    strain, curvature = sp.Matrix([1 / l, 0, 0]), sp.Matrix([0, *basis[2:, 0].diff(x, 2)])

    def integral(of: sp.Matrix) -> np.ndarray:
        outer = (of * of.T).applyfunc(lambda p: sp.integrate(sp.expand(p), (x, 0, l)))
        return np.array(outer.subs(l, length), dtype=float)

    stretch, bend = beam.E * beam.A * integral(strain), beam.E * beam.J * integral(curvature)
    return beam.rho * beam.A * integral(basis), stretch + bend


def hub_angle(omega: float, ramp: float) -> ca.Function:
    """Angle of the hub with its first two derivatives, eq. (18)."""
    t = ca.SX.sym("t")
    rising = omega / ramp * (t**2 / 2 + (ramp / (2 * ca.pi)) ** 2 * (ca.cos(2 * ca.pi * t / ramp) - 1))
    levels = [rising, ca.jacobian(rising, t), ca.hessian(rising, t)[0]]
    steady = [omega * (t - ramp / 2), omega, 0]
    return ca.Function("theta", [t], [ca.if_else(t < ramp, a, b) for a, b in zip(levels, steady, strict=True)])


def build(volumes: int, omega: float, ramp: float = 15.0, **beam: float) -> HandModel:
    """Write down the DAE of the manoeuvre.

    Parameters
    ----------
    volumes : int
        Substructures of the beam, one element each.
    omega, ramp : float
        Final angular velocity of the hub [rad/s] and time to reach it [s].
    **beam
        Fields of `Beam` that differ from the paper's.
    """
    section = Beam(**beam)
    l = section.length / volumes
    gram, stiffness = (ca.DM(m) for m in element(l, section))
    t = ca.SX.sym("t")
    theta = hub_angle(omega, ramp)
    # motion of the first frame; that of the others is unknown
    a_x = a_y = ca.SX(0)
    _, w, z = theta(t)
    f_x, f_y, torque = cut = _unknowns("f_x f_y t", 0)
    x, rates, unknowns, balances = [], [], [], []
    for i in range(volumes):
        q1, q2, q3, v1, v2, v3 = state = _unknowns("q1 q2 q3 v1 v2 v3", i)
        b1, b2, b3 = acceleration = _unknowns("b1 b2 b3", i)
        x += state
        rates += [v1, v2, v3, *acceleration]
        unknowns += [*acceleration, *cut]

        w2, stretch = w**2, 1 + q1 / l
        X = gram @ ca.vertcat(a_x, b1 / l - w2 * stretch, -z * q2 - 2 * w * v2, -z * q3 - 2 * w * v3)
        Y = gram @ ca.vertcat(a_y, z * stretch + 2 * w * v1 / l, b2 - w2 * q2, b3 - w2 * q3)
        # the load on the tip that each deformation's balance asks for, virtual motions (x/l, 0), (0, H2), (0, H3) ...
        p_x, p_y, p_t = ca.vertsplit(ca.vertcat(X[1] / l, Y[2], Y[3]) + stiffness @ ca.vertcat(q1, q2, q3))
        # ... keeps the next volume's load, and its rotation, out of the balances of force and of moment about the root
        balances += [X[0] - p_x - f_x, Y[0] - p_y - f_y]
        balances.append(stretch * Y[1] - q2 * X[2] - q3 * X[3] + q2 * p_x - (l + q1) * p_y - p_t - torque)
        if i + 1 == volumes:
            balances += [p_x, p_y, p_t]
            break
        c, s = ca.cos(q3), ca.sin(q3)
        f_x, f_y, torque = cut = _unknowns("f_x f_y t", i + 1)
        balances += [p_x + c * f_x - s * f_y, p_y + s * f_x + c * f_y, p_t + torque]
        # the next frame sits on this tip section
        tip_x = a_x - z * q2 - w2 * (l + q1) - 2 * w * v2 + b1
        tip_y = a_y + z * (l + q1) - w2 * q2 + 2 * w * v1 + b2
        tip_z, tip_w = z + b3, w + v3
        a_x, a_y, z, w = frame = _unknowns("a_x a_y z w", i + 1)
        balances += [c * a_x - s * a_y - tip_x, s * a_x + c * a_y - tip_y, z - tip_z, w - tip_w]
        unknowns += frame
    named = {"x": x, "z": unknowns, "ode": rates, "alg": balances}
    dae = {"t": t} | {name: ca.vertcat(*parts) for name, parts in named.items()}
    return HandModel(dae, theta, hub_torque=5, beam=section, volumes=volumes)


def _unknowns(names: str, volume: int) -> list[ca.SX]:
    return [ca.SX.sym(f"{name}_{volume}") for name in names.split()]


def tip_position(model: HandModel, states: np.ndarray) -> np.ndarray:
    """Position of the tip in the frame turning with the hub: 2 x points, by chaining the volumes' frames."""
    q = states.reshape(model.volumes, 6, -1)
    angle = np.cumsum(q[:, 2], axis=0) - q[:, 2]
    along, across = model.beam.length / model.volumes + q[:, 0], q[:, 1]
    c, s = np.cos(angle), np.sin(angle)
    return np.array([(c * along - s * across).sum(axis=0), (s * along + c * across).sum(axis=0)])


def _in_place(function: ca.Function, inputs: dict[str, np.ndarray], outputs: dict[str, np.ndarray]) -> tuple[Any, Any]:
    """Buffer of a function bound to arrays, and the call that evaluates it there."""
    buffer, evaluate = function.buffer()
    for name, array in inputs.items():
        buffer.set_arg(function.index_in(name), memoryview(array))
    for name, array in outputs.items():
        buffer.set_res(function.index_out(name), memoryview(array))
    return buffer, evaluate


def simulate(
    model: HandModel,
    tolerance: float,
    intervals: int = 400,
    max_order: int = 2,
    stop_time: float = 20.0,
    repeats: int = 1,
    **options: Any,
) -> HandRun:
    """Integrate from rest with IDAS in one call.

    Parameters
    ----------
    model : HandModel
        The DAE.
    tolerance : float
        Relative and absolute.
    intervals : int
        Of the equidistant output grid.
    max_order : int
        Of BDF; above 2 it is unstable for the undamped beam.
    stop_time : float
        End of the run [s].
    repeats : int
        Runs; the fastest counts in `solve_seconds`: consistent initialisation and integration, no construction.
    **options
        For IDAS, over those chosen here.
    """
    dae = model.dae
    grid = np.linspace(0.0, stop_time, intervals + 1)
    chosen = {
        "reltol": tolerance,
        "abstol": tolerance,
        "max_multistep_order": max_order,
        "suppress_algebraic": True,
        "calc_ic": False,
        "linear_solver": "csparse",  # a tenth faster than qr in every case of the table, with the same steps
    }
    integrator = ca.integrator("spin_up", "idas", dae, grid[0], list(grid[1:]), chosen | options)
    alg_at_start = ca.substitute(dae["alg"], dae["t"], grid[0])
    residual = ca.Function("residual", [dae["z"], dae["x"]], [alg_at_start], ["z", "x"], ["z_at_start"])
    initial = ca.rootfinder("initial", "newton", residual, {"linear_solver": "qr"})
    # a row per time, handed to CasADi as memory: turning its matrices into arrays takes as long as integrating
    x, z = np.zeros((intervals + 1, model.n_states)), np.zeros((intervals + 1, model.n_algebraic))
    initialise = _in_place(initial, {"z0": z[0], "x": x[0]}, {initial.name_out(0): z[0]})
    integrate = _in_place(integrator, {"x0": x[0], "z0": z[0]}, {"xf": x[1:], "zf": z[1:]})
    seconds = []
    for _ in range(repeats):
        z[0] = 0.0
        start = time.perf_counter()
        initialise[1]()
        integrate[1]()
        seconds.append(time.perf_counter() - start)
    stats = integrate[0].stats()
    jacobian = integrator.get_function("jacF")
    along, across = tip_position(model, x.T)
    return HandRun(
        time=grid,
        tip_deflection=across,
        tip_extension=along - model.beam.length,
        states=x.T,
        algebraic=z.T,
        solve_seconds=min(seconds),
        steps=stats["nsteps"],
        factorisations=stats["nlinsetups"],
        residual_evaluations=stats["nfevals"],
        jacobian_nonzeros=sum(jacobian.nnz_out(i) for i in range(jacobian.n_out())),
    )


def simulate_on_core(
    model: HandModel, tolerance: float, intervals: int = 400, stop_time: float = 20.0, repeats: int = 1
) -> HandRun:
    """Integrate from rest with the one-step method of the core, vibrations of rates that no step resolves left out of the error.

    Parameters and result as of `simulate`; algebraic unknowns are as they are interpolated.
    """
    dae, none = model.dae, ca.SX(0, 1)
    equations = make_equations(dae["x"], dae["z"], dae["t"], none, none, dae["ode"], dae["alg"])
    alg_at_start = ca.substitute(dae["alg"], dae["t"], 0)
    residual = ca.Function("residual", [dae["z"], dae["x"]], [alg_at_start], ["z", "x"], ["z_at_start"])
    initial = ca.rootfinder("initial", "newton", residual, {"linear_solver": "qr"})
    grid, x, z = np.linspace(0.0, stop_time, intervals + 1), np.zeros(model.n_states), np.zeros(model.n_algebraic)
    initialise = _in_place(initial, {"z0": z, "x": x}, {initial.name_out(0): z})
    rodas, rate = Stepper(equations), np.tile([0, 0, 0, 1, 1, 1], model.volumes)
    seconds = []
    for _ in range(repeats):
        z[:] = 0.0
        start = time.perf_counter()
        initialise[1]()
        found = rodas.begin(
            *(grid, x, z, np.empty(0), np.empty(0)), size=np.ones(len(x)), tolerance=tolerance, rate=rate, smooth=True
        )
        while rodas.go(10_000) == End.MORE:
            pass
        seconds.append(time.perf_counter() - start)
    states, algebraic = np.vstack([x, found.x]).T, np.vstack([z, found.z]).T
    along, across = tip_position(model, states)
    return HandRun(
        time=grid,
        tip_deflection=across,
        tip_extension=along - model.beam.length,
        states=states,
        algebraic=algebraic,
        solve_seconds=min(seconds),
        steps=rodas.progress.steps,
        factorisations=rodas.progress.steps + rodas.progress.refused,
        residual_evaluations=rodas.progress.values,
        jacobian_nonzeros=len(equations.row),
    )
