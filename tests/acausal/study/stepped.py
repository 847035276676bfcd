"""A model with runs of its own: explicit steps of order 1 and 2 of x' = -rate x, and runs that go wrong."""

import time as clock
from functools import partial

import numpy as np

import acausal as ac
from acausal import DeclarationError, Formulation, Model, Scalar, der, output, parameter, quantity, variable


def steps(model, stop_time, times, dt, order=1, progress=None):
    """Explicit Euler or midpoint steps, shortened so that outputs lie at their ends."""
    h = times[1] / np.ceil(times[1] / dt - 1e-9)
    z = -model.value("rate") * h
    factor = 1 + z if order == 1 else 1 + z + z * z / 2
    count = np.rint(times / h)
    if progress:
        progress(1.0, int(count[-1]))
    seconds = 1e-5 * count[-1] * order
    return ac.result_of(times, {"s": factor**count}, model=model, steps=int(count[-1]), solve_seconds=seconds)


def exact(model, stop_time, times, tolerance):
    """The solution, but for what a tolerance leaves."""
    return ac.result_of(times, {"s": np.exp(-model.value("rate") * times) * (1 + tolerance)}, model=model)


def failing(model, stop_time, times, tolerance):
    raise DeclarationError("this run knows why it cannot\nand says more in a second line")


def broken(model, stop_time, times, tolerance):
    return {}["nothing"]


def other(model, stop_time, times, tolerance):
    return times


def short(model, stop_time, times, tolerance):
    return ac.simulate(model, stop_time=stop_time, intervals=7)


def alone(model, stop_time, times, tolerance):
    return ac.result_of(times, {"y": (times, "1")})


def wild(model, stop_time, times, tolerance):
    return ac.result_of(
        times, {"s": np.exp(-times)[:, None] @ [1], "x": np.where(times < 1, times, np.nan)}, model=model
    )


def slow(model, stop_time, times, tolerance, **more):
    for k in range(200):
        clock.sleep(0.05)
        more["progress"](k / 200, k)


class Stepped(Model):
    """Two kinds of steps, and the engine as the reference."""

    stop_time = 2.0
    formulations = (
        Formulation("engine"),
        Formulation("Euler", run=steps, dt=(0.1, 0.05, 0.025)),
        Formulation("midpoint", run=partial(steps, order=2), dt=(0.1, 0.05)),
        Formulation("exact", run=exact),
    )
    rate: Scalar = parameter("rate", unit="1/s", default=1.0)
    x: Scalar = output("decays, twice")
    s: Scalar = variable("decays", start=1.0, fixed=True)

    def equations(self):
        yield der(self.s) == -self.rate * self.s
        yield self.x == 2 * self.s * quantity(1, "1")
