"""FMUs for Model Exchange as parts: against the models themselves, closed forms, and what they cannot do."""

from __future__ import annotations

import pickle
import re
import subprocess
import sys
import zipfile
from functools import partial
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, connect, der, discrete, input, output, parameter, quantity, variable, when
from acausal.core.build.compiling import SOURCE, own_compiler
from components.blocks import Step, ZeroOrderHold
from components.translational import Mass, Position

pytest.importorskip("fmpy")

from components.fmu import FMU
from tests.components.oscillator import Spring
from tests.components.oscillator import oscillator as exchanging

HERE = Path(__file__).parent


oscillator = partial(exchanging, kind="model_exchange")


class Ball(Model):
    """A ball that bounces on the ground under a force."""

    e: Scalar = parameter("coefficient of restitution", default=0.7)
    F: Scalar = input("force", unit="N", start=0)
    h: Scalar = output("height", unit="m")
    v: Scalar = output("speed", unit="m/s")
    n: Scalar = discrete("bounces", start=0)

    def equations(self):
        yield der(self.h) == self.v
        yield quantity(2, "kg") * (der(self.v) + 9.81) == self.F
        yield when(self.h < 0, ac.reinit(self.v, -self.e * self.v), ac.reinit(self.n, self.n + 1))

    def initial_equations(self):
        yield self.h == quantity(1, "m")
        yield self.v == quantity(0, "m/s")


class Held(Model):
    """A lag behind a sampled input, with direct feedthrough to one output alone."""

    u: Scalar = input("input")
    y: Scalar = output("lag")
    through: Scalar = output("input and lag")
    x: Scalar = variable("state", start=0, fixed=True)
    hold = ZeroOrderHold(sample_period=0.1)

    def equations(self):
        yield self.hold.u == self.u
        yield quantity(1, "s") * der(self.x) == self.hold.y + ac.sin(5 * ac.time) - self.x
        yield self.y == self.x
        yield self.through == 2 * self.u + self.x


def changed(path, to, **attributes):
    """A copy of an FMU whose description says something else."""
    with zipfile.ZipFile(path) as old, zipfile.ZipFile(to, "w", zipfile.ZIP_DEFLATED) as new:
        for name in old.namelist():
            content = old.read(name)
            if name == "modelDescription.xml":
                for key, value in attributes.items():
                    content, n = re.subn(
                        rb"(<ModelExchange[^>]* " + key.encode() + rb'=")\w+', rb"\g<1>" + value.encode(), content
                    )
                    assert n
            new.writestr(name, content)
    return to


@pytest.fixture(scope="module", params=[2, 3])
def files(request, tmp_path_factory):
    """The models as FMUs of FMI 2 or 3."""
    folder = tmp_path_factory.mktemp("fmu")
    for model in (Spring(), Ball(), Held()):
        ac.export_fmu(model, folder / f"{type(model).__name__}.fmu", fmi_version=request.param)
    return folder


@pytest.mark.parametrize("method", ["rosenbrock", "idas"])
def test_oscillator(files, method):
    model = ac.compile(oscillator(files / "Spring.fmu"))
    for k in (100, 400, 100):
        result = ac.simulate(model, stop_time=1, tolerance=1e-9, method=method, parameters={"spring.k": k})
        np.testing.assert_allclose(result["x"], 0.1 * np.cos(np.sqrt(k) * result.time), atol=1e-7)
        np.testing.assert_allclose(result["spring.F"], k * result["x"], atol=1e-4)
    with pytest.warns(ac.AcausalWarning, match="not an equilibrium"):
        A = ac.linearize(model).A
    np.testing.assert_allclose(A, [[0, 1, 0], [0, 0, -100], [0, 1, 0]], atol=1e-6)


def test_differences_where_there_are_no_directional_derivatives(files, tmp_path):
    version = (
        "s" if "Derivatives=" in zipfile.ZipFile(files / "Spring.fmu").read("modelDescription.xml").decode() else ""
    )
    path = changed(
        files / "Spring.fmu", tmp_path / "spring.fmu", **{f"providesDirectionalDerivative{version}": "false"}
    )
    exact, found = (ac.simulate(oscillator(p), stop_time=1, tolerance=1e-9) for p in (files / "Spring.fmu", path))
    assert abs(found.stats["steps"] - exact.stats["steps"]) <= 2
    np.testing.assert_allclose(found["x"], exact["x"], atol=1e-8)


def test_events_of_state(files):
    class Bouncing(Model):
        ball = FMU(files / "Ball.fmu", kind="model_exchange")
        wind = Step(height=4, start_time=1.2)

        def connections(self):
            yield connect(self.wind.y, self.ball.F)

    class Itself(Model):
        ball, wind = Ball(), Step(height=4, start_time=1.2)

        def connections(self):
            yield connect(self.wind.y, self.ball.F)

    model = ac.compile(Bouncing())
    runs = [
        ac.simulate(m, stop_time=2.0, tolerance=1e-9, parameters={"ball.e": e})
        for m in (model, Itself())
        for e in (0.7, 0.8)
    ]
    found = runs[0]  # read after other runs
    first = np.sqrt(2 / 9.81)
    assert found.stats["event_times"][0] == pytest.approx(first, abs=1e-9)
    assert found.stats["event_times"][1] == pytest.approx(2.4 * first, abs=1e-8)
    at = np.linspace(0, 2, 401)
    for k, name in [(k, name) for k in (0, 1) for name in ("ball.h", "ball.v")]:
        values = [np.interp(at, result.time, result[name]) for result in (runs[k], runs[k + 2])]
        beside = np.min(np.abs(at[:, None] - np.array(runs[k].stats["event_times"])[None, :]), axis=1) > 0.006
        np.testing.assert_allclose(values[0][beside], values[1][beside], atol=1e-5)


def test_time_events_and_direct_feedthrough(files):
    def closed(inner):
        class Closed(Model):
            lag = inner
            r: Scalar = variable("reference")

            def equations(self):
                yield self.r == ac.sine(f=0.4)
                yield self.lag.u == self.r - 0.3 * self.lag.through

        return Closed()

    found, right = (
        ac.simulate(closed(lag), stop_time=2, tolerance=1e-8)
        for lag in (FMU(files / "Held.fmu", kind="model_exchange"), Held())
    )
    for name in ("lag.y", "lag.through", "lag.u"):
        np.testing.assert_allclose(found[name], right[name], atol=1e-6)

    class Sparse(Model):
        lag = FMU(files / "Held.fmu", kind="model_exchange")

        def equations(self):
            yield self.lag.u == 1 - self.lag.y

    loops = re.findall("signal loop.*", ac.compile(closed(FMU(files / "Held.fmu", kind="model_exchange"))).summary())
    assert loops
    assert "signal loop" not in ac.compile(Sparse()).summary()


def test_what_it_cannot_do(files, tmp_path):
    class Drive(Model):
        ball, drive, mass = FMU(files / "Ball.fmu", kind="model_exchange", F=0), Position(), Mass(m=1)

        def connections(self):
            yield connect(self.ball.h, self.drive.s_ref)
            yield connect(self.drive.flange, self.mass.flange_a)

    with pytest.raises(
        ac.DeclarationError, match=r"ball \(FMU\).* the output h of Ball.fmu .* return a force and take a motion"
    ):
        ac.compile(Drive())
    with pytest.raises(ac.ExportError, match="`spring`"):
        ac.export_fmu(oscillator(files / "Spring.fmu"), tmp_path / "oscillator.fmu")
    with pytest.raises(ac.DeclarationError, match="co_simulation, model_exchange"):
        FMU(files / "Spring.fmu", kind="me")
    with pytest.raises(ac.DeclarationError, match="powers"):
        FMU(files / "Spring.fmu", kind="model_exchange", powers=[("v", "F")])


def test_an_fmu_that_saves_no_state_has_no_events(files, tmp_path):
    word = next(w for w in ("canGetAndSetFMUstate", "canGetAndSetFMUState") if w in read(files / "Spring.fmu"))
    spring, ball = (changed(files / f"{n}.fmu", tmp_path / f"{n}.fmu", **{word: "false"}) for n in ("Spring", "Ball"))
    model = ac.compile(oscillator(spring))
    for k in (100, 400):
        result = ac.simulate(model, stop_time=1, tolerance=1e-9, parameters={"spring.k": k})
        np.testing.assert_allclose(result["x"], 0.1 * np.cos(np.sqrt(k) * result.time), atol=2e-8)

    class Alone(Model):
        part = FMU(ball, kind="model_exchange", F=0)

    with pytest.raises(ac.SimulationError, match=r"part .*cannot save its state"):
        ac.simulate(Alone(), stop_time=1)


def read(path):
    return zipfile.ZipFile(path).read("modelDescription.xml").decode()


@pytest.fixture(scope="module")
def counter(tmp_path_factory):
    """An FMU that asks for its events at the ends of steps, and has discrete inputs and outputs."""
    if not own_compiler():
        pytest.skip("there is no C compiler")
    folder = tmp_path_factory.mktemp("counter")
    system = {"linux": ("linux64", "so"), "darwin": ("darwin64", "dylib"), "win32": ("win64", "dll")}[sys.platform]
    library = folder / f"counter.{system[1]}"
    flags = ["-shared", "-fPIC", "-Wall", "-Wextra", "-Werror", f"-I{SOURCE}"]
    subprocess.run([*own_compiler(), *flags, str(HERE / "counter.c"), "-o", str(library)], check=True)
    with zipfile.ZipFile(folder / "counter.fmu", "w") as file:
        file.write(HERE / "counter.xml", "modelDescription.xml")
        file.write(library, f"binaries/{system[0]}/{library.name}")
    return folder / "counter.fmu"


@pytest.mark.parametrize("method", ["rosenbrock", "idas"])
def test_events_at_the_ends_of_steps_and_discrete_signals(counter, method):
    class Counting(Model):
        part = FMU(counter)
        x: Scalar = variable("what keeps steps short", start=1, fixed=True)
        v: Scalar = variable("its rate", unit="1/s", start=0, fixed=True)
        total: Scalar = variable("turns")

        def equations(self):
            yield der(self.x) == self.v
            yield der(self.v) == -quantity(1000, "1/s2") * self.x
            yield self.part.speed == 2 + ac.sin(ac.time)
            yield self.part.on == ac.piecewise((1, ac.time < 1.5), (0, ac.time < 2.25), 1)
            yield self.total == self.part.x + self.part.n

    result = ac.simulate(Counting(), stop_time=4, tolerance=1e-8, method=method)
    t = result.time
    on = np.where(t < 1.5, t, np.where(t < 2.25, 1.5, t))
    way = 2 * on - np.cos(on) + 1 - np.where(t >= 2.25, 2 * 0.75 + np.cos(1.5) - np.cos(2.25), 0)
    np.testing.assert_allclose(result["total"], way, atol=1e-6)
    assert result["part.n"][-1] == np.floor(way[-1])
    assert 1 < result["part.x"].max() < 1.3  # it falls at the end of a step, not before


def test_copies_and_pickles(files):
    part = FMU(files / "Spring.fmu", kind="model_exchange")
    assert type(pickle.loads(pickle.dumps(part))) is type(part)
