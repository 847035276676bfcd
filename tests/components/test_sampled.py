"""Python functions as sampled blocks: order of data flow, delays, state, failures, and sampled control in closed form."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

import acausal as ac
from acausal import Model, Scalar, der, parameter, time, variable
from components.blocks import Gain, Integrator, Sampled
from models import Bricard

PERIOD = 0.1


class Sum:
    """Sum of all inputs."""

    def __init__(self) -> None:
        self.total = 1e9

    def reset(self) -> None:
        self.total = 0.0

    def __call__(self, time: float, u: Any) -> Any:
        self.total += u
        return self.total


class Count:
    """Number of calls."""

    n = 0

    def __call__(self, time: float, u: Any) -> int:
        self.n += 1
        return self.n


class PI:
    """Proportional gain and sum, called by a method."""

    def __init__(self, k: float, Ti: float) -> None:
        self.k, self.Ti, self.i = k, Ti, 0.0

    def law(self, time: float, e: float) -> float:
        self.i += e * PERIOD / self.Ti
        return self.k * (e + self.i)


CONTROLLER = PI(2.0, 1.0)


class Controlled(Model):
    """Lag under a sampled PI controller."""

    stop_time = 3.0
    gain: Scalar = parameter("of the lag", default=1)
    controller = Sampled(f=CONTROLLER.law, period=PERIOD)
    x: Scalar = variable("output", start=0, fixed=True)

    def equations(self):
        yield self.controller.u == 1 - self.x
        yield der(self.x) == -self.x + self.gain * self.controller.y


def by_hand(gain: float = 1.0) -> float:
    """The lag after 30 samples."""
    x, own, a = 0.0, PI(2.0, 1.0), np.exp(-PERIOD)
    for k in range(30):
        x = a * x + (1 - a) * gain * own.law(k * PERIOD, 1 - x)
    return x


@pytest.mark.parametrize("method", [None, "idas", "rosenbrock"])
def test_lag_under_a_sampled_controller(method):
    result = ac.simulate(Controlled(), method=method, tolerance=1e-9)
    assert result["x"][-1] == pytest.approx(by_hand(), rel=1e-7)
    assert result.stats.events == 30


def test_every_run_begins_alike():
    model = ac.compile(Controlled())
    first = ac.simulate(model)["x"]
    np.testing.assert_array_equal(ac.simulate(model)["x"], first)
    np.testing.assert_array_equal(ac.simulate(pickle.loads(pickle.dumps(model)))["x"], first)
    assert ac.simulate(model, parameters={"gain": 0.5}, tolerance=1e-9)["x"][-1] == pytest.approx(
        by_hand(0.5), rel=1e-7
    )
    assert CONTROLLER.i == 0


def network(seed: int) -> tuple[type[Model], np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Sampled sums that read one another without a cycle and themselves, declared in any order; some outputs are late."""
    rng = np.random.default_rng(seed)
    n = 6
    flow = rng.permutation(n)
    A = rng.integers(-1, 2, (n, n)) * (rng.random((n, n)) < 0.6)
    delay = rng.integers(0, 2, n)
    own = rng.integers(-1, 2, n) / 2

    def equations(self):
        for k in range(n):
            inside = sum(A[k, j] * getattr(self, f"s{j}").y for j in range(n) if flow[j] < flow[k] or delay[j])
            yield getattr(self, f"s{k}").u == inside + own[k] * getattr(self, f"s{k}").y + np.sin(k) * time

    parts = {f"s{k}": Sampled(f=Sum(), delay=int(delay[k]), period=PERIOD) for k in range(n)}
    return type("Network", (Model,), {**parts, "equations": equations, "__module__": __name__}), A, flow, delay, own


@pytest.mark.parametrize("seed", range(8))
def test_functions_act_in_the_order_of_data_flow(seed):
    cls, A, flow, delay, own = network(seed)
    n, order = len(flow), np.argsort(flow)
    y, kept, total = np.zeros(n), np.zeros(n), np.zeros(n)
    for instant in np.arange(6) * PERIOD:
        y = np.where(delay == 1, kept, y)
        before = y.copy()
        for k in order:
            inside = sum(A[k, j] * y[j] for j in range(n) if flow[j] < flow[k] or delay[j])
            total[k] += inside + own[k] * (before if not delay[k] else y)[k] + np.sin(k) * instant
            kept[k] = total[k]
            if not delay[k]:
                y[k] = total[k]
    result = ac.simulate(cls(), stop_time=0.55)
    np.testing.assert_allclose([result[f"s{k}.y"][-1] for k in range(n)], y, rtol=1e-12)


def test_in_a_cycle_the_first_one_declared_acts_first():
    class Cycle(Model):
        a = Sampled(f=lambda t, u: u + 1)
        b = Sampled(f=lambda t, u: 2 * u)

        def equations(self):
            yield self.a.u == self.b.y
            yield self.b.u == self.a.y

    result = ac.simulate(Cycle(), stop_time=0.25)
    a = b = 0
    for _ in range(3):
        a = b + 1
        b = 2 * a
    assert (result["a.y"][-1], result["b.y"][-1]) == (a, b)


def test_what_samplers_of_other_rates_read():
    class Rates(Model):
        fast = Sampled(f=Count(), period=0.1, u=0)
        gain = Gain(k=10)
        slow = Sampled(f=lambda t, u: u, period=0.3, offset=0.2)
        late = Sampled(f=lambda t, u: u, period=0.1, delay=1, y_start=-1)

        def equations(self):
            yield self.gain.u == self.fast.y
            yield self.slow.u == self.gain.y
            yield self.late.u == self.fast.y

    result = ac.simulate(Rates(), stop_time=1.0, intervals=1000)
    n = np.floor(result.time / 0.1 + 1e-9)
    np.testing.assert_array_equal(result["fast.y"], n + 1)
    np.testing.assert_array_equal(result["late.y"], np.where(n == 0, -1, n))
    held = np.floor((result.time - 0.2) / 0.3 + 1e-9)
    np.testing.assert_allclose(result["slow.y"], np.where(held < 0, 0, 10 * (3 * held + 3)))


def test_instants_before_the_start_are_passed_over():
    class Late(Model):
        s = Sampled(f=lambda t, u: t, period=0.25, offset=0.1, u=0)
        x = Integrator(u=1)

    result = ac.simulate(Late(), start_time=5.2, stop_time=6.0)
    np.testing.assert_allclose(np.unique(result["s.y"]), [0, 5.35, 5.6, 5.85])


def test_state_feedback_of_a_crane_with_an_observer():
    """Two functions of vectors, against the same recursion with the transition matrix of the plant."""
    g, length, T = 9.81, 2.0, 0.05
    A = np.array([[0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1], [0, 0, -g / length, 0]])
    B = np.array([0, 1, 0, -1 / length])
    whole = expm(T * np.block([[A, B[:, None]], [np.zeros((1, 5))]]))
    F, G = whole[:4, :4], whole[:4, 4]
    K = np.array([1.0, 2.0, 3.0, -1.0])
    L = np.array([[0.9, 0.0], [2.0, 0.1], [0.0, 0.9], [0.1, 1.0]])

    class Observer:
        def __init__(self) -> None:
            self.x = np.zeros(4)

        def __call__(self, time: float, u: np.ndarray) -> np.ndarray:
            measured, force = u[:2], u[2]
            self.x = F @ self.x + G * force
            self.x = self.x + L @ (measured - self.x[[0, 2]])
            return self.x

    class Crane(Model):
        observer = Sampled(f=Observer(), inputs=3, outputs=4, period=T)
        feedback = Sampled(f=lambda t, u: -K @ u, inputs=4, period=T)
        x: Any = variable("state", shape=(4,), start=(1, 0, 0.1, 0), fixed=True)

        def equations(self):
            yield self.observer.u[0] == self.x[0]
            yield self.observer.u[1] == self.x[2]
            yield self.observer.u[2] == self.feedback.y
            yield self.feedback.u == self.observer.y
            yield der(self.x) == A @ self.x + B * self.feedback.y

    result = ac.simulate(Crane(), stop_time=5.0, tolerance=1e-10)
    x, force, own = np.array([1, 0, 0.1, 0]), 0.0, Observer()
    for k in range(100):
        force = -K @ own(k * T, np.array([x[0], x[2], force]))
        x = F @ x + G * force
    np.testing.assert_allclose(result["x"][-1], x, atol=1e-7)


def test_a_function_is_called_once_at_an_instant_where_a_run_goes_back():
    """With these settings one slice of the run is repeated, with other states."""

    class Counted(Bricard):
        counter = Sampled(f=Count(), period=0.01, u=0)

    result = ac.simulate(Counted(), intervals=20, constraints="states", method="rosenbrock")
    np.testing.assert_array_equal(result["counter.y"], np.floor(result.time / 0.01 + 1e-9) + 1)


def broken(function: Any, **values: Any) -> Model:
    """A model with a function that fails."""
    return type(
        "Broken", (Model,), {"s": Sampled(f=function, u=time, **values), "stop_time": 1.0, "__module__": __name__}
    )()


@pytest.mark.parametrize(
    ("function", "text"),
    [
        (
            lambda t, u: 1 / (0.5 - t) if t < 0.45 else 1 / 0,
            r"t = 0.5 s.*`?s \(Sampled.*ZeroDivisionError: division by zero",
        ),
        (lambda t, u: np.nan if t > 0.45 else 0, r"t = 0.5 s.*s \(Sampled.*it returns nan, which is not finite"),
        (lambda t, u: [1, 2] if t > 0.45 else 0, r"t = 0.5 s.*must return one number, not an array of shape \(2,\)"),
        (lambda t, u: None if t > 0.45 else 0, r"t = 0.5 s.*s \(Sampled"),
    ],
)
def test_failures_name_block_and_time_and_leave_what_was_computed(function, text):
    with pytest.raises(ac.SimulationError, match=text) as caught:
        ac.simulate(broken(function), intervals=10)
    assert isinstance(caught.value.__cause__, Exception)
    np.testing.assert_allclose(
        caught.value.result.time, np.arange(6 if caught.value.result.time[-1] > 0.45 else 5) / 10
    )


def test_an_interrupt_in_a_function_leaves_what_was_computed():
    def law(t, u):
        if t > 0.45:
            raise KeyboardInterrupt
        return 0

    with pytest.raises(KeyboardInterrupt) as caught:
        ac.simulate(broken(law), intervals=10)
    assert len(caught.value.result.time) >= 5


def test_functions_that_cannot_be_taken():
    with pytest.raises(ac.DeclarationError, match=r"`f` of s .* is 3; it must be a function"):
        ac.simulate(broken(3))
    with pytest.raises(ac.InitializationError, match="takes 1 positional argument but 2 were given"):
        ac.simulate(broken(lambda u: 0))
    with pytest.raises(ac.DeclarationError, match="cannot be copied for a run: cannot pickle"):
        ac.simulate(broken(Locked()))


class Locked:
    """A function with a lock, which has no copies."""

    def __init__(self) -> None:
        self.generator = (k for k in range(3))

    def __call__(self, time: float, u: float) -> float:
        return next(self.generator)


def test_functions_are_not_called_in_a_linear_system():
    with pytest.warns(ac.AcausalWarning, match="functions of `controller` are not called"):
        linear = ac.linearize(Controlled())
    np.testing.assert_allclose(linear.A, [[-1]])
    assert CONTROLLER.i == 0


@pytest.mark.parametrize("export", [ac.export_fmu, ac.export_dae])
def test_functions_are_not_exported(export, tmp_path):
    path = tmp_path / "controlled.fmu"
    with pytest.raises(ac.ExportError, match="calls functions in Python, which cannot be exported: `controller`"):
        export(Controlled(), path)
    assert not path.exists()
