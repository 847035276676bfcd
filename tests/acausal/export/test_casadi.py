"""Exported models read by CasADi, which evaluates them at any point, against the results that they come from."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from models import SCENES
from tests.acausal.export.hybrid import exported
from tests.shared import CONTRACT, compiled, every_other

# Stop times within which elastic scenes are quick; the parallelogram comes to lie flat.
STOPS = {"free-vibration": 0.01, "pendulum": 0.02, "slider-crank": 0.02, "n-four-bar": 0.5}
INTERVALS = 40


def read(path: Path, folder: Path) -> ca.DaeBuilder:
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder)
    return ca.DaeBuilder("m", str(folder), {})


def rate(result: ac.Result, state: str) -> np.ndarray | None:
    """The derivative of a state where it is a variable of the model, maybe of another name."""
    try:
        return result[f"der({state})"]
    except ac.AcausalError as error:
        other = re.search(r"Read `(.+?)`", str(error))
        return result[other[1]] if other else None


@pytest.mark.parametrize("version", every_other([2, 3]))
@pytest.mark.parametrize("scene", SCENES)
def test_rates_and_outputs_at_the_points_of_a_run(scene: str, version: int, tmp_path: Path) -> None:
    model, stop = compiled(SCENES[scene]), STOPS.get(scene, CONTRACT[scene][1] / 4)
    dae = read(exported(model, tmp_path / "a.fmu", version), tmp_path / "read")
    result = ac.simulate(model, stop_time=stop, intervals=INTERVALS)
    # Of loops the states themselves are told apart from what is projected on the constraints: results hold this.
    states = [name.removeprefix("integrated.") for name in dae.x()]
    x, y = (np.column_stack([result[name] for name in names]) for names in (states, dae.y()))
    f, p = dae.create("f", ["t", "x", "p"], ["ode", "y"]), dae.start(dae.p())
    found = [[np.ravel(part) for part in f(t, at, p)] for t, at in zip(result.time, x, strict=True)]
    ode, shown = (np.array(part) for part in zip(*found, strict=True))
    assert np.max(np.abs(shown - y) / np.maximum(np.max(np.abs(y), axis=0), 1e-6)) < 1e-9
    for k, state in enumerate(states):
        own = rate(result, state)
        assert own is None or np.max(np.abs(ode[:, k] - own)) <= 1e-9 * max(1.0, np.max(np.abs(own)))


@pytest.mark.parametrize("version", [2, 3])
def test_parameters(version: int, tmp_path: Path) -> None:
    dae = read(exported(compiled(SCENES["simple-pendulum"]), tmp_path / "a.fmu", version), tmp_path / "read")
    f, names, p = dae.create("f", ["x", "p"], ["ode"]), np.array(dae.p()), np.array(dae.start(dae.p()))
    assert "world.g" in names
    twice = p * np.where(names == "world.g", 2, 1)
    assert np.allclose(f([0.3, 0.2], twice)[1], 2 * f([0.3, 0.2], p)[1], rtol=1e-12)


@pytest.mark.parametrize("version", [2, 3])
def test_jacobians_by_time_and_states(version: int, tmp_path: Path) -> None:
    dae = read(exported(compiled(SCENES["car-axis"]), tmp_path / "a.fmu", version), tmp_path / "read")
    f = dae.create("f", ["t", "x"], ["ode", "y"])
    at, h = np.array([0.4, 0.05, -0.01, 0.02, 0.03]), 1e-6
    by_time, by_states = (np.vstack([np.array(j) for j in f.jacobian()(at[0], at[1:], 0, 0)[k::2]]) for k in (0, 1))
    for k, column in enumerate(np.hstack([by_time, by_states]).T):
        up, down = (
            np.vstack([np.array(part) for part in f(y[0], y[1:])]) for y in at + h * np.outer([1, -1], np.eye(5)[k])
        )
        assert column == pytest.approx((up - down).ravel() / (2 * h), rel=1e-6, abs=1e-6)
