"""The scenes against numbers that nobody here made: the beam paper, hand-derived and geometrically exact programs."""

from __future__ import annotations

import csv
import inspect
import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
import models
from models import SCENES, FlexiblePendulum, FreeVibration, SimplePendulum, SpinUp
from tests.reference import cantilever, pendulum
from tests.shared import CONTRACT

ROOT = Path(models.__file__).parents[1]
SPIN_UP = {"stop_time": 20.0, "tolerance": 1e-8}
QUICK = ("simple-pendulum", "four-bar", "spin-up")


@pytest.mark.parametrize(
    ("volumes", "lowest"), [(5, -0.54748), (20, -0.53502), pytest.param(40, -0.53448, marks=pytest.mark.slow)]
)
def test_spin_up(volumes, lowest):
    result = ac.simulate(SpinUp(volumes=volumes), **SPIN_UP)
    assert result["tip_deflection"].min() == pytest.approx(lowest, abs=3e-4)
    assert result["angle"][-1] == pytest.approx(4 * (20 - 15 / 2), rel=1e-12)
    if volumes == 40:
        assert result["tip_extension"][-1] == pytest.approx(1.06e-4, abs=1e-6)


def test_spin_up_ends_with_the_stretch_of_centrifugal_force():
    """A rod that turns steadily is rho omega^2 L^3 / 3 E longer; what vibration is left takes away little."""
    result = ac.simulate(SpinUp(volumes=20), **SPIN_UP)
    stretch = 2767 * 4**2 * 8**3 / (3 * 6.895e10)
    late = result.time > 15.5
    assert result["tip_extension"][late].max() == pytest.approx(stretch, rel=0.01)


def one_beam(omega: float) -> SpinUp:
    return SpinUp(formulation="fem", volumes=5, elements_per_volume=2, omega=omega)


def test_one_linear_beam_holds_below_its_first_frequency():
    result = ac.simulate(one_beam(2.0), **SPIN_UP)
    assert result["tip_deflection"].min() == pytest.approx(-0.3436, abs=5e-4)
    assert np.abs(result["tip_deflection"][result.time > 15]).max() < 0.1


@pytest.mark.parametrize("max_order", [None, 2])
def test_one_linear_beam_is_unstable_above_its_first_frequency(max_order):
    """At 4 rad/s centrifugal force grows faster with deflection than the linear stiffness does."""
    EJ, rho_A = 6.895e10 * 8.214e-9, 2767 * 7.299e-5
    assert 2 < cantilever.bending_frequencies(8.0, rho_A, EJ, 1)[0] < 4
    result = ac.simulate(one_beam(4.0), stop_time=10.2, tolerance=1e-8, max_order=max_order)
    deflection = np.abs(result["tip_deflection"])
    assert deflection[-1] == pytest.approx(9.084, abs=2e-2)
    assert (np.diff(deflection[result.time > 8.0]) > 0).all()
    assert result.stats["steps"] < 20_000


PENDULUM = {"stop_time": 1.0, "tolerance": 1e-6}


@pytest.fixture(scope="module")
def swings() -> dict[str, ac.Result]:
    return {f: ac.simulate(FlexiblePendulum(formulation=f), energy=True, **PENDULUM) for f in ("fem", "substructured")}


@pytest.mark.parametrize("formulation", ["fem", "substructured"])
def test_pendulum_keeps_its_energy(swings, formulation):
    """7.825 J: the weight of 3.989 kg, lifted by half the length above the lowest position."""
    result = swings[formulation]
    beam = result.tree.beam
    parts = [beam] if formulation == "fem" else list(beam.volume)
    energy = sum(result[part.stored_energy()] for part in parts)
    total = 5540 * 18e-4 * 0.4 * 9.81 * 0.2
    assert total == pytest.approx(7.825, abs=2e-3)
    np.testing.assert_allclose(energy, energy[0], atol=1e-5 * total)
    assert abs(result.stats["energy_method"]) < 1e-5 * total
    assert result.stats["steps"] < 20_000


def test_pendulum_formulations(swings):
    """They agree in the swing; deflections of one linear beam lack its geometric stiffness."""
    fem, sub = swings["fem"], swings["substructured"]
    np.testing.assert_allclose(fem["swing_angle"], sub["swing_angle"], atol=0.05)
    swing = np.ptp(sub["swing_angle"])
    assert swing > 2.0
    difference = np.abs(fem["tip_deflection"] - sub["tip_deflection"]).max()
    assert difference > 0.02 * np.abs(sub["tip_deflection"]).max()
    for result in (fem, sub):
        assert result["swing_angle"][0] == 0
        tip = np.hypot(result["tip_x"], result["tip_y"])
        c, s = np.cos(result["swing_angle"]), np.sin(result["swing_angle"])
        np.testing.assert_allclose(c * result["tip_y"] - s * result["tip_x"], result["tip_deflection"], atol=1e-12)
        np.testing.assert_allclose(tip, 0.4, atol=1e-3)


@pytest.mark.parametrize(("volumes", "n"), [(5, 2), (10, 1)])
def test_substructured_pendulum_reaches_the_geometrically_exact_values(volumes, n):
    result = ac.simulate(
        FlexiblePendulum(formulation="substructured", volumes=volumes, elements_per_volume=n), **PENDULUM
    )
    assert np.abs(result["mid_deflection"]).max() == pytest.approx(1.384e-3, rel=0.01)
    assert np.abs(result["tip_deflection"]).max() == pytest.approx(5.08e-3, rel=0.01)


def test_rigid_pendulum_is_a_physical_pendulum():
    result = ac.simulate(FlexiblePendulum(formulation="rigid"), stop_time=1.0, tolerance=1e-9)
    mass = 5540 * 18e-4 * 0.4
    x, y = pendulum.physical_position(result.time, mass, 0.2, mass * 0.4**2 / 12)
    np.testing.assert_allclose(result["tip_x"], 2 * x, atol=1e-6)
    np.testing.assert_allclose(result["tip_y"], 2 * y, atol=1e-6)
    np.testing.assert_allclose(result["mid_deflection"], 0)
    np.testing.assert_allclose(result["tip_deflection"], 0, atol=1e-12)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
def test_stiff_pendulum_is_the_rigid_one(reference):
    """The reference frame does not matter where deflections are small; both swing as the rigid rod to 1 %."""
    result = ac.simulate(FlexiblePendulum(reference=reference, elements=2), **PENDULUM)
    rigid = ac.simulate(FlexiblePendulum(formulation="rigid"), **PENDULUM)
    np.testing.assert_allclose(result["tip_x"], rigid["tip_x"], atol=0.01)
    np.testing.assert_allclose(result["tip_y"], rigid["tip_y"], atol=0.01)


def pendulum_error(tolerance: float) -> float:
    """Largest error of the position over 100 s."""
    result = ac.simulate(SimplePendulum(), stop_time=100.0, tolerance=tolerance, intervals=1000)
    x, y = pendulum.position(result.time)
    return float(np.hypot(result["x"] - x, result["y"] - y).max())


def test_simple_pendulum_follows_the_tolerance():
    errors = [pendulum_error(tolerance) for tolerance in (1e-9, 1e-11)]
    assert errors[1] < 1e-6
    assert errors[1] < errors[0] / 30


@pytest.mark.parametrize("formulation", ["fem", "substructured"])
@pytest.mark.parametrize("tip", [0.01, -0.003])
def test_free_vibration_starts_at_rest_in_the_static_shape(formulation, tip):
    result = ac.simulate(FreeVibration(formulation=formulation, tip=tip), stop_time=0.01, tolerance=1e-6, intervals=2)
    # Volumes turn with the beam: the same up to the square of the slope.
    assert result["tip_deflection"][0] == pytest.approx(tip, rel=1e-9 if formulation == "fem" else 1e-4)
    np.testing.assert_allclose(result["beam.frame_b.v"][0], 0, atol=1e-12)
    np.testing.assert_allclose(result["beam.frame_b.R.w"][0], 0, atol=1e-12)
    x = np.linspace(0, 2.0, 11)
    force = 3 * 72e9 * 1e-8 / 12 / 2.0**3 * tip
    v, _ = cantilever.tip_force_deflection(x, 2.0, 72e9 * 1e-8 / 12, force)
    np.testing.assert_allclose(result["beam.node_deflection"][0][:, 1], v, atol=1e-4 * abs(tip))


def test_load_of_free_vibration_is_released():
    result = ac.simulate(FreeVibration(), stop_time=0.01, intervals=2)
    np.testing.assert_allclose(result["load.frame_b.f"][1:], 0, atol=1e-15)


def test_free_vibration_is_a_sum_of_modes():
    """Mode by mode from the finite elements: K v0 = F, q = Phi cos(w t) Phi^T M v0."""
    from scipy.linalg import eigh

    result = ac.simulate(FreeVibration(), stop_time=0.1, tolerance=1e-7, intervals=50)
    EJ = 72e9 * 1e-8 / 12
    M, K = cantilever.bending_matrices(2.0, 0.27, EJ, 10)
    squares, modes = eigh(K, M)
    start = np.linalg.solve(K, (3 * EJ / 8 * 0.01) * np.eye(20)[18])
    motion = modes @ (np.cos(np.outer(np.sqrt(squares), result.time)) * (modes.T @ M @ start)[:, None])
    np.testing.assert_allclose(result["tip_deflection"], motion[18], atol=1e-5)


def test_all_scenes_are_of_the_contract():
    assert set(SCENES) <= set(CONTRACT)
    assert {"free-vibration", "pendulum", "spin-up", "simple-pendulum"} <= set(SCENES)
    files = {path.stem for path in (ROOT / "models").glob("*.py")} - {"__init__"}
    assert files == {Path(inspect.getfile(cls)).stem for cls in SCENES.values()}


@pytest.mark.parametrize("name", sorted(SCENES))
def test_scene_file(name):
    cls = SCENES[name]
    text = Path(inspect.getfile(cls)).read_text()
    assert len(text.splitlines()) <= 60
    assert 'if __name__ == "__main__":' in text
    assert (inspect.getdoc(cls) or "").strip()
    assert cls.stop_time == CONTRACT[name][1]


def test_a_scene_runs_from_the_command_line(tmp_path):
    """In a process of its own; all scenes in one process are in test_cli_scenes.py."""
    name = "simple-pendulum"
    arguments = ["simulate", name, "--stop-time", "0.01", "--intervals", "4", "--csv", "a.csv", "--quiet"]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-c", "from acausal.cli import main; main()", *arguments]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    rows = list(csv.reader((tmp_path / "a.csv").open()))
    assert tuple(rows[0]) == ("time", *CONTRACT[name][0])
    assert len(rows) == 6
    np.testing.assert_allclose([float(row[0]) for row in rows[1:]], np.linspace(0, 0.01, 5))


@pytest.mark.parametrize(
    ("model", "changes", "stop"),
    [
        (SpinUp, {"omega": 2.0, "ramp": 10.0, "rho": 3000.0}, 12.0),
        (lambda: FreeVibration(elements=3), {"tip": 0.02, "beam.E": 7e10}, 0.1),
        (lambda: FlexiblePendulum(elements=3), {"gravity": 5.0}, 0.1),
    ],
)
def test_changed_parameters_are_those_of_a_fresh_compile(model, changes: dict[str, Any], stop: float):
    how = {"stop_time": stop, "tolerance": 1e-7, "intervals": 20}
    compiled = ac.compile(model())
    before = ac.simulate(compiled, **how)
    changed = ac.simulate(compiled, parameters=changes, **how)
    fresh = ac.simulate(model(), parameters=changes, **how)
    again = ac.simulate(compiled, **how)
    for name in before.outputs:
        scale = np.abs(fresh[name]).max()
        np.testing.assert_allclose(changed[name], fresh[name], atol=1e-6 * scale)
        np.testing.assert_array_equal(again[name], before[name])
    moved = [
        name
        for name in before.outputs
        if np.abs(changed[name] - before[name]).max() > 1e-3 * np.abs(before[name]).max()
    ]
    assert moved


@pytest.mark.filterwarnings("ignore::acausal.AcausalWarning")
@pytest.mark.parametrize("name", [pytest.param(n, marks=() if n in QUICK else pytest.mark.slow) for n in SCENES])
def test_a_run_depends_on_no_run_before(name):
    """Other parameters, tolerances, methods and a linearisation leave nothing behind in a compiled model."""
    cls, random = SCENES[name], np.random.default_rng(1)
    stop = cls.stop_time * (0.05 if name == "free-vibration" else 0.2)
    fresh, used = (ac.compile(cls()) for _ in range(2))
    values = dict(zip(used.reduced.flat.parameters.names, used.parameter_values(None), strict=True))
    for method, tolerance in (("auto", 1e-4), ("idas", 1e-7), ("rosenbrock", 1e-4)):
        changed = str(random.choice(list(values)))
        with suppress(ac.AcausalError):  # where it cannot start or go on with that value
            ac.simulate(
                used, stop_time=stop, method=method, tolerance=tolerance, parameters={changed: 1.07 * values[changed]}
            )
    ac.linearize(used)
    one, other = (ac.simulate(model, stop_time=stop, intervals=40, energy=True) for model in (fresh, used))
    for output in one.outputs:
        np.testing.assert_array_equal(one[output], other[output])
    for count in ("steps", "residual_evaluations", "energy_supplied", "energy_dissipated"):
        assert one.stats[count] == other.stats[count]


def test_results_are_read_by_path_attribute_and_expression():
    model = SpinUp()
    result = ac.simulate(model, stop_time=2.0, intervals=10)
    by_path = result["beam.frame_b.r_0"]
    assert by_path.shape == (11, 3)
    np.testing.assert_array_equal(by_path, result[model.beam.frame_b.r_0])
    np.testing.assert_array_equal(by_path, result[result.tree.beam.frame_b.r_0])
    np.testing.assert_array_equal(by_path[:, 1], result["beam.frame_b.r_0[1]"])
    np.testing.assert_array_equal(result[model.hub.phi], result["hub.phi"])
    tree = result.tree
    lengths = result[ac.sqrt(ac.dot(tree.beam.frame_b.r_0, tree.beam.frame_b.r_0)) - tree.length]
    np.testing.assert_allclose(lengths, np.linalg.norm(by_path, axis=1) - 8.0, atol=1e-12)
    np.testing.assert_allclose(result["beam.volume[4].frame_b.r_0"], by_path, atol=0)
    assert result["beam.node_r_0"].shape == (11, 6, 3)
    np.testing.assert_allclose(result["beam.node_r_0"][:, -1], by_path, atol=1e-12)
    with pytest.raises(ac.DeclarationError, match="r_0"):
        result["beam.frame_b.r0"]
