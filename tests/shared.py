"""What many tests share: models that are compiled once in a process, and choices of combinations."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterable
from functools import cache
from itertools import combinations, product
from typing import Any

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal.language.functions import feedback, initial, time

# Columns and stop time of each scene, as the contract has them.
CONTRACT: dict[str, tuple[tuple[str, ...], float]] = {
    "free-vibration": (("tip_deflection",), 1.0),
    "pendulum": (("swing_angle", "tip_deflection", "tip_x", "tip_y", "mid_deflection"), 1.0),
    "spin-up": (("angle", "tip_deflection", "tip_extension"), 20.0),
    "slider-crank": (("crank_angle", "slider_position", "rod_tip_deflection", "rod_mid_deflection"), 1.6),
    "simple-pendulum": (("x", "y"), 10.0),
    "n-four-bar": (("b0_x", "b0_y"), 10.0),
    "squeezer": (("beta", "theta", "gamma", "phi", "delta", "omega", "epsilon"), 0.03),
    "bricard": (("x", "y", "z"), 10.0),
    "governor": (("s", "rod_angle", "shaft_angle"), 10.0),
    "car-axis": (("xl", "yl", "xr", "yr"), 3.0),
    "four-bar": (("j1_phi", "j1_w"), 5.0),
    "four-bar-spatial": (("j1_phi", "j1_w"), 5.0),
    "blade": (("flap", "lag", "twist"), 2.0),
    "right-angle-frame": (("tip_x", "tip_y", "tip_z"), 10.0),
    "shaft": (("whirl_y", "whirl_z", "speed"), 10.0),
    "robot-arm": (("tip_x", "tip_y", "tip_z"), 3.0),
    "fe-pendulum": (("tip_z", "tip_vz"), 0.6),
    "fe-plate": (("P1_x", "P1_y", "P1_z", "w_x", "w_y", "w_z"), 0.3),
    "rolling-wheel-set-driving": (("x", "y", "phi"), 3.0),
}


@cache
def compiled(make: Callable[..., Any], **values: Any) -> ac.CompiledModel:
    """Return a model, compiled; values that can be hashed are those of its class."""
    return ac.compile(make(**values))


def pairwise(*choices: Iterable) -> list:
    """All combinations; those beyond a few in which every pair of choices occurs are marked slow."""
    values = [list(choice) for choice in choices]
    every = list(product(*(range(len(v)) for v in values)))
    pairs = {one: set(combinations(enumerate(one), 2)) for one in every}
    left, few = set().union(*pairs.values()), []
    while left:
        few.append(max(every, key=lambda one: len(pairs[one] & left)))
        left -= pairs[few[-1]]
    return [
        pytest.param(*(v[k] for v, k in zip(values, one, strict=True)), marks=() if one in few else pytest.mark.slow)
        for one in every
    ]


def every_other(values: Iterable) -> list:
    """All values, every other one marked slow."""
    return [pytest.param(value, marks=pytest.mark.slow) if k % 2 else value for k, value in enumerate(values)]


def heed_interrupts() -> None:
    """What is started in the background ignores interrupts, and so does what that starts."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def worst_equation(result: ac.Result, model: ac.CompiledModel) -> float:
    """Largest residual of any equation as it was stated, in parts of the sizes of its terms."""
    flat = model.reduced.flat
    column = ca.vertcat(flat.equations.residuals, flat.unknowns.symbols)
    found = result._evaluate(column)
    residuals, values = np.split(found, [flat.equations.residuals.numel()], axis=1)
    J = ca.jacobian(flat.equations.residuals, flat.unknowns.symbols)
    switches = flat.discontinuities.constants
    arguments = [flat.unknowns.symbols, flat.parameters.symbols, time.sx, switches, feedback.sx, initial.sx]
    slopes = ca.Function("slopes", arguments, [ca.fabs(J)])
    constants = result._evaluate.rows.constants
    p, worst = model.parameter_values(None), 0.0
    for k in range(0, len(result.time), 7):
        here, back = constants[k, : switches.numel()], constants[k, -1]
        terms = np.array(slopes(values[k], p, result.time[k], here, back, 0)) @ np.abs(values[k]) + 1
        worst = max(worst, float(np.max(np.abs(residuals[k]) / terms, initial=0.0)))
    return worst
