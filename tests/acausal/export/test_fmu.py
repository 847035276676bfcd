"""Exported models against simulations by acausal, with fmpy as importer."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("fmpy")

from fmpy import read_model_description
from fmpy.validation import validate_fmu

import acausal as ac
import models
from tests.acausal.export.hybrid import Ball, Hybrid, Struck, exported, opened, simulated
from tests.acausal.solve.events.test_friction import Block as Block
from tests.acausal.solve.events.test_jumps_in_loops import JumpingBennett, JumpingSpatial
from tests.benchmarks.events.scenes import Drive, SampledPendulum, StickSlip
from tests.hard.bennett import ASKEW, Bennett
from tests.reference import n_four_bar

# Stop times within which a converged run is quick.
SCENES: dict[str, tuple[Any, float]] = {
    "free-vibration": (models.FreeVibration(), 0.1),
    "pendulum": (models.FlexiblePendulum(), 0.1),
    "spin-up": (models.SpinUp(), 20.0),
    "slider-crank": (models.SliderCrank(crank="rigid", rod="rigid"), 1.0),
    "simple-pendulum": (models.SimplePendulum(), 5.0),
    "squeezer": (models.Squeezer(), 0.02),
    "bricard": (models.Bricard(), 5.0),
    "governor": (models.Governor(), 3.0),
    "car-axis": (models.CarAxis(), 1.0),
    "four-bar": (models.FourBar(), 3.0),
    "four-bar-spatial": (models.FourBarSpatial(), 2.0),
    "ball": (Ball(), 1.9),
    "hybrid": (Hybrid(wanted=0.4), 2.0),
    "struck": (Struck(), 1.5),
    "stiction": (Block(), 6.0),
    "stick-slip": (StickSlip(), 3.0),
    "drive": (Drive(), 2.0),
    "sampled": (SampledPendulum(), 1.0),
    "bennett": (Bennett(begins=4.0, turned=ASKEW), 3.0),
    "jumping": (JumpingSpatial(), 0.4),
    "jumping-bennett": (JumpingBennett(), 0.4),
}
SOLVED_BY_CVODE = (
    *("simple-pendulum", "slider-crank", "squeezer", "bricard", "governor", "four-bar", "ball", "hybrid", "struck"),
    *("stiction", "stick-slip", "drive", "sampled", "bennett", "jumping", "jumping-bennett"),
)


LONG = ("bennett", "bricard", "governor", "squeezer")


def each_in_turn(scenes: Iterable[str]) -> list[Any]:
    """Two of three scenes with one version; the other one, the third and the longest scenes are among the slow tests."""
    found: list[Any] = []
    for k, scene in enumerate(scenes):
        marks = [pytest.mark.slow] if scene in LONG or k % 3 == 2 else []
        found += [pytest.param(scene, 2 + k % 2, marks=marks), pytest.param(scene, 3 - k % 2, marks=pytest.mark.slow)]
    return found


def columns(result: ac.Result, names: tuple[str, ...] = ()) -> dict[str, np.ndarray]:
    """Outputs of a run, or other variables, entry by entry, as importers name them."""
    found = {}
    for name in names or result.outputs:
        value = result[name]
        for index in np.ndindex(value.shape[1:]):
            key = f"{name}[{','.join(map(str, index))}]" if index else name
            found[key] = value[(slice(None), *index)]
    return found


def error(found: Any, exact: dict[str, np.ndarray]) -> float:
    """Largest error of any output, over its range."""
    return max(float(np.max(np.abs(found[k] - v)) / (np.ptp(v) or 1.0)) for k, v in exact.items())


@pytest.mark.parametrize(("scene", "version"), each_in_turn(SCENES))
def test_co_simulation_is_as_exact_as_simulate(scene: str, version: int, tmp_path: Path) -> None:
    model, stop = SCENES[scene]
    compiled = ac.compile(model)
    path = exported(compiled, tmp_path / "a.fmu", version)
    assert validate_fmu(str(path)) == []
    given = {"stop_time": stop, "intervals": 40}
    names = compiled.outputs or compiled.states
    tolerance = 1e-10 if stop > 0.1 else 1e-8
    exact = columns(ac.simulate(compiled, tolerance=tolerance, method="idas", **given), names)
    own = error(columns(ac.simulate(compiled, tolerance=1e-5, **given), names), exact)
    found = simulated(path, "CoSimulation", stop, relative_tolerance=1e-5, output=list(exact))
    assert len(found) == 41
    assert error(found, exact) <= 2 * own + 1e-8


def test_closed_loops_go_back_to_their_constraints(tmp_path: Path) -> None:
    model, stop = SCENES["four-bar-spatial"]
    compiled = ac.compile(model)
    path = exported(compiled, tmp_path / "a.fmu", 3)
    given = {"stop_time": stop, "intervals": 40}
    exact = columns(ac.simulate(compiled, tolerance=1e-10, **given))
    own = error(columns(ac.simulate(compiled, tolerance=1e-6, **given)), exact)
    found = simulated(path, "CoSimulation", stop, relative_tolerance=1e-6, output=list(exact))
    assert error(found, exact) <= 1.5 * own  # twice where errors that lead away from the constraints add up


def test_small_states_have_the_sizes_that_a_run_finds(tmp_path: Path) -> None:
    model, stop = SCENES["car-axis"]
    compiled = ac.compile(model)
    path = exported(compiled, tmp_path / "a.fmu", 3)
    given = {"stop_time": stop, "intervals": 40}
    exact = columns(ac.simulate(compiled, tolerance=1e-10, method="idas", **given))
    own = ac.simulate(compiled, tolerance=1e-7, **given)
    found = simulated(path, "CoSimulation", stop, relative_tolerance=1e-7, output=list(exact))
    assert error(found, exact) <= 1.2 * error(columns(own), exact)
    nominal = {float(v.nominal) for v in read_model_description(str(path)).modelVariables if v.nominal}
    least = min(own.stats["sizes"].values())
    assert least < 0.1
    assert min(nominal) == pytest.approx(least, rel=0.1)  # what a loose run at other places reaches


@pytest.mark.parametrize(("scene", "version"), each_in_turn(SOLVED_BY_CVODE))
def test_model_exchange(scene: str, version: int, tmp_path: Path) -> None:
    model, stop = SCENES[scene]
    compiled = ac.compile(model)
    path = exported(compiled, tmp_path / "a.fmu", version)
    names = compiled.outputs or compiled.states
    exact = columns(ac.simulate(compiled, tolerance=1e-9, method="idas", stop_time=stop, intervals=40), names)
    runs = (
        simulated(path, "ModelExchange", stop, relative_tolerance=tolerance, output=list(exact))
        for tolerance in (1e-4, 1e-7)
    )
    loose, tight = (error(run, exact) for run in runs)
    assert tight < 1e-4
    assert tight < loose or loose < 1e-6


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_a_beam_with_damping_suits_importers(kind: str, tmp_path: Path) -> None:
    compiled = ac.compile(models.FlexiblePendulum(), parameters={"beam.beta": 1e-3})
    path = exported(compiled, tmp_path / "a.fmu", 3)
    exact = columns(ac.simulate(compiled, tolerance=1e-8, method="idas", stop_time=0.5, intervals=40))
    # At 1e-6 errors of CVode scatter from 6e-4 to 1.6e-3 where the tolerance changes by a tenth, or the last bits do.
    assert error(simulated(path, kind, 0.5, relative_tolerance=3e-7), exact) < 1e-3


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize(
    ("scene", "changes"),
    [
        ("four-bar", {"b1.r[0]": 0.45, "b3.r[0]": -0.3, "damper.d": 0.2, "b2.density": 9000.0}),
        ("squeezer", {"K2.r[0]": -0.0285, "K1.m": 0.1, "spring.c": 3000.0}),
        ("governor", {"rod1.r[0]": 1.05, "ball1.m": 6.0}),
        ("hybrid", {"tau": 0.2, "late": 1.1, "wanted": 0.3, "step": 0.2}),
    ],
)
def test_a_changed_parameter_equals_a_run_with_that_value(
    scene: str, changes: dict[str, float], kind: str, tmp_path: Path
) -> None:
    model, stop = SCENES[scene]
    compiled = ac.compile(model)
    path = exported(compiled, tmp_path / "a.fmu", 2 if kind == "CoSimulation" else 3)
    given = {"stop_time": stop, "intervals": 40, "parameters": changes, "method": "idas"}
    exact = columns(ac.simulate(compiled, tolerance=1e-9, **given))
    found = simulated(path, kind, stop, relative_tolerance=1e-8, start_values=changes)
    assert error(found, exact) < 2e-5


def test_a_parameter_that_is_0_can_be_kept(tmp_path: Path) -> None:
    model = models.FlexiblePendulum(elements=2)
    path = exported(model, tmp_path / "a.fmu", 3, free="beam.beta")
    for beta in (0.0, 1e-3):
        compiled = ac.compile(model, parameters={"beam.beta": beta})
        exact = columns(ac.simulate(compiled, tolerance=1e-8, method="idas", stop_time=0.1, intervals=40))
        found = simulated(path, "CoSimulation", 0.1, relative_tolerance=1e-7, start_values={"beam.beta": beta})
        assert error(found, exact) < 1e-5
    exported(model, path, 3)
    with pytest.raises(Exception, match=r"beam\.beta"):
        simulated(path, "CoSimulation", 0.1, start_values={"beam.beta": 1e-3})


def test_start_values_of_states_can_be_set(tmp_path: Path) -> None:
    path = exported(ac.compile(Ball()), tmp_path / "a.fmu", 3)
    found = simulated(path, "CoSimulation", 0.5, start_values={"h": 3.0, "v": 1.0})
    t = found["time"]
    np.testing.assert_allclose(found["height"], 3 + t - 9.81 * t**2 / 2, atol=1e-9)


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_inputs_that_vary(kind: str, version: int, tmp_path: Path) -> None:
    """A filter without its load: tau x' + x = u + 2 held, of which the second part is a known staircase."""
    path = exported(
        ac.compile(Hybrid(), parameters={"wanted": 0.5, "late": 9.0, "step": 8.0}), tmp_path / "a.fmu", version
    )
    t = np.linspace(0, 2, 2001)
    signal = np.array(list(zip(t, 0.5 + 0.4 * np.sin(3 * t), strict=True)), dtype=[("time", float), ("wanted", float)])
    found = simulated(path, kind, 2.0, 400, input=signal)

    def slope(time: float, x: float, held: float) -> float:
        return (2 * held + 0.5 + 0.4 * np.sin(3 * time) - x) / 0.3

    x, held, h, exact = 0.2, 0.0, 2.0 / 4000, [0.2]
    for k in range(4000):
        time = k * h
        if time >= 0.05 and not held:
            held = 0.5 + 0.4 * np.sin(0.15) - x
        a = slope(time, x, held)
        b = slope(time + h / 2, x + h * a / 2, held)
        x += h * slope(time + h / 2, x + h * b / 2, held)
        exact.append(x)
    # Importers hold an input, which changes by 1.2/s at most, between communication points; the value that is held counts twice.
    np.testing.assert_allclose(found["y"], np.clip(exact[::10], -0.3, 0.9), atol=3 * 1.2 * 2.0 / 400)


@contextmanager
def started(path: Path, kind: str) -> Iterator[Any]:
    """An FMU that has been initialised."""
    with opened(path, kind) as (fmu, description):
        fmu.enterInitializationMode(**({"startTime": 0.0} if description.fmiVersion == "3.0" else {}))
        fmu.exitInitializationMode()
        yield fmu, description


def references(description: Any, *names: str) -> list[int]:
    by_name = {v.name: v.valueReference for v in description.modelVariables}
    return [by_name[name] for name in names]


@pytest.mark.parametrize("scene", ["four-bar", "squeezer", "spin-up", "hybrid", "governor"])
def test_derivatives_are_those_of_differences(scene: str, tmp_path: Path) -> None:
    path = exported(ac.compile(SCENES[scene][0]), tmp_path / "a.fmu", 3)
    with started(path, "ModelExchange") as (fmu, description):
        fmu.updateDiscreteStates()
        fmu.enterContinuousTimeMode()
        n = len(description.derivatives)
        rates = [d.variable.valueReference for d in description.derivatives]
        outputs = [o.variable.valueReference for o in description.outputs]
        states = [d.variable.derivative.valueReference for d in description.derivatives]
        x = np.array(fmu.getFloat64(states))
        rng = np.random.default_rng(0)
        x += 1e-3 * rng.standard_normal(n)
        seed = rng.standard_normal(n)

        def values(at: np.ndarray) -> np.ndarray:
            fmu.setContinuousStates((np.ctypeslib.as_ctypes(np.ascontiguousarray(at))), n)
            return np.array(fmu.getFloat64(rates + outputs))

        def differences(step: float) -> np.ndarray:
            return (values(x + step * seed) - values(x - step * seed)) / (2 * step)

        size = np.abs(values(x)) + 1
        expected = (4 * differences(1e-5) - differences(2e-5)) / 3
        values(x)
        forward = np.array(fmu.getDirectionalDerivative(rates + outputs, states, seed.tolist()))
        np.testing.assert_allclose(
            forward / size, expected / size, rtol=1e-5, atol=1e-5 * np.max(np.abs(expected / size))
        )
        weights = rng.standard_normal(len(forward))
        backward = np.array(fmu.getAdjointDerivative(rates + outputs, states, weights.tolist(), n))
        assert weights @ forward == pytest.approx(backward @ seed, rel=1e-9)


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("scene", ["four-bar", "spin-up", "hybrid", "ball"])
def test_stored_states_go_on_bit_by_bit(scene: str, version: int, tmp_path: Path) -> None:
    model, stop = SCENES[scene]
    path = exported(ac.compile(model), tmp_path / "a.fmu", version)
    h = stop / 30

    def step(fmu: Any, k: int, outputs: list[int]) -> list[float]:
        fmu.doStep(currentCommunicationPoint=k * h, communicationStepSize=h)
        return list((fmu.getReal if version == 2 else fmu.getFloat64)(outputs))

    with started(path, "CoSimulation") as (one, description), started(path, "CoSimulation") as (other, _):
        outputs = [o.variable.valueReference for o in description.outputs]
        first = [step(one, k, outputs) for k in range(10)]
        get, put, free = (f"{w}FMU{'S' if version == 3 else 's'}tate" for w in ("get", "set", "free"))
        state = getattr(one, get)()
        serialise = "serializeFMUState" if version == 3 else "serializeFMUstate"
        content = getattr(one, serialise)(state)
        rest = [step(one, k, outputs) for k in range(10, 30)]
        getattr(one, put)(state)
        assert [step(one, k, outputs) for k in range(10, 30)] == rest
        getattr(one, free)(state)
        # Another instance goes on from the bytes, while it did something else before.
        step(other, 0, outputs)
        foreign = getattr(
            other, serialise.replace("serialize", "deSerialize") if version == 2 else "deserializeFMUState"
        )(content)
        getattr(other, put)(foreign)
        assert [step(other, k, outputs) for k in range(10, 30)] == rest
        assert len(first) == 10


@pytest.mark.parametrize("version", [2, 3])
def test_flat_positions_are_crossed_or_an_error(version: int, tmp_path: Path) -> None:
    """Co-Simulation crosses them on the same branch; Model Exchange cannot tell the importer's method how."""
    path = exported(ac.compile(models.NFourBar()), tmp_path / "a.fmu", version, tolerance=1e-6)
    found = simulated(path, "CoSimulation", 10.0, 400)
    np.testing.assert_allclose(found["b0_y"], n_four_bar.upper_end(found["time"])[1], rtol=0, atol=1e-2)
    with pytest.raises(Exception, match=r"[Ee]rror"):
        simulated(path, "ModelExchange", 10.0, 400)
    assert simulated(path, "ModelExchange", 0.7, 28)["b0_y"][-1] < 0.15


@pytest.mark.parametrize(("kind", "version"), [("CoSimulation", 2), ("ModelExchange", 3)])
def test_other_constraints_of_loops_are_kept_on_the_way(kind: str, version: int, tmp_path: Path) -> None:
    """Forces that are not determined stay small; with one choice they rise to 4e4 N."""
    path = exported(ac.compile(SCENES["bennett"][0]), tmp_path / "a.fmu", version)
    names = [f"joint[{joint}].frame_a.f[{k}]" for joint in range(4) for k in range(3)]
    found = simulated(path, kind, 3.0, 600, output=names)
    largest = max(float(np.abs(found[name]).max()) for name in names)
    assert 30 < largest < 100


@pytest.mark.parametrize("version", [2, 3])
def test_vibrations_are_damped_where_that_is_set(version: int, tmp_path: Path) -> None:
    compiled = ac.compile(models.SliderCrank(crank_elements=2, rod_elements=2))
    path = exported(compiled, tmp_path / "a.fmu", version)
    given = {"stop_time": 0.9, "intervals": 40}
    exact = columns(ac.simulate(compiled, tolerance=1e-7, method="resolve", **given))
    own = error(columns(ac.simulate(compiled, tolerance=1e-4, method="rosenbrock", **given)), exact)
    few = {"relative_tolerance": 1e-4, "output": list(exact)}
    steps = {"solver.most_steps": 50}
    damped = simulated(path, "CoSimulation", 0.9, start_values={"solver.damping": 1, **steps}, **few)
    assert error(damped, exact) < 2 * own
    with pytest.raises(Exception, match=r"[Dd]iscard|[Ee]rror"):
        simulated(path, "CoSimulation", 0.9, start_values=steps, **few)
    assert error(simulated(path, "CoSimulation", 0.9, **few), exact) < 0.1 * own


@pytest.mark.parametrize("version", [2, 3])
def test_limits_of_parameters(version: int, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = exported(ac.compile(models.FourBar()), tmp_path / "a.fmu", version)
    with pytest.raises(Exception, match=r"[Ee]rror"):
        simulated(path, "CoSimulation", 0.1, start_values={"damper.d": -1.0})
    assert "`damper.d` is -1; it must be at least 0" in capfd.readouterr().out


def test_importers_may_jump_far(tmp_path: Path) -> None:
    compiled = ac.compile(models.FourBar())
    path = exported(compiled, tmp_path / "a.fmu", 3)
    result = ac.simulate(compiled, tolerance=1e-9, stop_time=3.0, intervals=15)
    with started(path, "ModelExchange") as (fmu, description):
        fmu.updateDiscreteStates()
        fmu.enterContinuousTimeMode()
        states = [d.variable.derivative.name for d in description.derivatives]
        outputs = [o.variable.valueReference for o in description.outputs]
        for k in (0, 7, 15, 4, 11):
            x = np.ascontiguousarray([result[name.removeprefix("integrated.")][k] for name in states])
            fmu.setTime(float(result.time[k]))
            fmu.setContinuousStates(np.ctypeslib.as_ctypes(x), len(x))
            assert fmu.getFloat64(outputs)[0] == pytest.approx(result["j1_phi"][k], abs=1e-12)
