"""Threads that share a compiled model, or results, get what one thread would, bit by bit."""

from __future__ import annotations

import io
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, fixed, output, parameter, piecewise, reinit, sin, variable, when
from acausal.compiler.call import quiet
from models import FourBar, SpinUp


class Pendulum(Model):
    """A pendulum."""

    k: Scalar = parameter("stiffness", default=4.0)
    x: Scalar = output("angle")
    v: Scalar = variable("its rate")

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -self.k * sin(self.x)


class Ball(Model):
    """A ball that bounces, with drag that changes with the direction."""

    g: Scalar = parameter("gravity", default=9.81)
    h: Scalar = output("height", unit="1")
    v: Scalar = variable("speed", select=ac.ALWAYS)

    def equations(self):
        yield der(self.h) == self.v
        yield der(self.v) == -self.g + piecewise((0.2, self.v < 0), -0.2)
        yield when((self.h < 0) & (self.v < 0), reinit(self.v, -0.7 * self.v))


TASKS = [
    (Pendulum(x=fixed(1.0), v=fixed(0.0)), "k", (3.0, 4.0, 5.0), {"stop_time": 5.0}),
    (Pendulum(x=fixed(1.0), v=fixed(0.0)), "k", (4.0, 40.0), {"stop_time": 5.0, "method": "rosenbrock"}),
    (Ball(h=fixed(1.0), v=fixed(0.0)), "g", (9.0, 10.0), {"stop_time": 1.0}),
    (FourBar(), "world.g", (9.0, 9.81), {"stop_time": 0.5, "tolerance": 1e-4}),
    (SpinUp(), "omega", (3.0, 4.0), {"stop_time": 2.0, "tolerance": 1e-4}),
]


@pytest.fixture(scope="module")
def jobs():
    """Jobs on shared compiled models, several of each at a time, and what one thread gets."""
    made = [(ac.compile(model), name, values, options) for model, name, values, options in TASKS]
    work = [
        (compiled, {"parameters": {name: value}, "intervals": 50, **options})
        for compiled, name, values, options in made
        for value in values
    ]
    return work, [read(ac.simulate(compiled, **options)) for compiled, options in work]


def read(result):
    return {name: np.array(result[name]) for name in (*result.outputs, "time")}


def assert_same(found, expected):
    for one, other in zip(found, expected, strict=True):
        assert one.keys() == other.keys()
        assert all(np.array_equal(one[name], other[name]) for name in one)


@pytest.mark.parametrize("threads", [2, 4])
@pytest.mark.parametrize("round_", range(3))
def test_shared_models(jobs, threads, round_):
    work, expected = jobs
    order = np.random.default_rng(round_).permutation(len(work))
    with ThreadPoolExecutor(threads) as pool:
        futures = {k: pool.submit(lambda k=k: read(ac.simulate(work[k][0], **work[k][1]))) for k in order}
        found = [futures[k].result() for k in range(len(work))]
    assert_same(found, expected)


@pytest.mark.slow
def test_models_that_are_compiled_by_threads():
    def task(model, name, value, options):
        return read(ac.simulate(model, parameters={name: value}, intervals=50, **options))

    work = [(model, name, values[0], options) for model, name, values, options in TASKS]
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda arguments: task(*arguments), work))
    assert_same(found, [task(*arguments) for arguments in work])


def test_threads_that_read_one_result():
    compiled = ac.compile(FourBar())
    names = ["j1.phi", "j1.w", "world.frame_b.r_0", "j1.frame_a.f", "j1.frame_b.t", "j1_phi", "j1_w"]
    options = {"stop_time": 0.5, "tolerance": 1e-4, "intervals": 40}
    expected = [np.array(ac.simulate(compiled, **options)[name]) for name in names]
    for _ in range(5):
        result = ac.simulate(compiled, **options)
        with ThreadPoolExecutor(4) as pool:
            found = list(pool.map(lambda name, result=result: result[name], names * 4))
        assert all(np.array_equal(a, b) for a, b in zip(found, expected * 4, strict=True))


def test_linearise_and_summary_beside_a_run():
    compiled = ac.compile(Pendulum(x=fixed(1.0), v=fixed(0.0)))
    serial = ac.linearize(compiled).A

    def task(k):
        if k % 3 == 0:
            return np.array_equal(ac.linearize(compiled).A, serial)
        return "states" in compiled.summary() if k % 3 == 1 else ac.simulate(compiled, stop_time=1.0).time.size == 401

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(task, range(24)))


def test_a_progress_callback_may_read_and_run():
    compiled = ac.compile(Pendulum(x=fixed(1.0), v=fixed(0.0)))
    before = ac.simulate(compiled, stop_time=1.0)
    seen = []

    def show(fraction, steps):
        if len(seen) < 2:
            other = ac.simulate(compiled, stop_time=1.0, parameters={"k": 9.0})
            seen.append((np.array(before["v"]), np.array(other["v"])))

    options = {"stop_time": 3000.0, "tolerance": 1e-9, "intervals": 20, "method": "idas"}
    watched = ac.simulate(compiled, progress=show, **options)
    assert np.array_equal(watched["x"], ac.simulate(compiled, **options)["x"])
    assert seen
    assert all(np.array_equal(own, before["v"]) and not np.array_equal(own, other) for own, other in seen)


def test_what_other_threads_print_meanwhile_is_not_taken_for_a_complaint(monkeypatch):
    stream, ready = io.StringIO(), threading.Event()
    monkeypatch.setattr(sys, "stderr", stream)

    other = threading.Thread(target=lambda: (ready.wait(5), print("other", file=sys.stderr)))
    other.start()
    with quiet() as noise:
        print("own", file=sys.stderr)
        ready.set()
        other.join()
    assert noise.getvalue() == "own\n"
    assert stream.getvalue() == "other\n"


def test_an_error_in_one_thread_does_not_stop_the_others():
    compiled = ac.compile(Pendulum(x=fixed(1.0), v=fixed(0.0)))

    def task(k):
        try:
            return ac.simulate(compiled, stop_time=1.0, parameters={"k": 4.0} if k % 2 else {"nothing": 1.0})
        except ac.DeclarationError:
            return None

    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(task, range(12)))
    assert [result is not None for result in found] == [bool(k % 2) for k in range(12)]
    assert all(np.array_equal(found[1]["x"], r["x"]) for r in found[1::2])
