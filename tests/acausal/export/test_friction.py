"""Set-valued laws in exported models: what `simulate` finds, redundant laws and loops included; brakes that hold."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("fmpy")

import acausal as ac
from tests.acausal.export.hybrid import exported, simulated
from tests.acausal.solve.events.cranks import Parallelogram, friction, slider_crank
from tests.acausal.solve.events.test_friction import Block, Brakes, Struck
from tests.acausal.solve.events.test_friction_in_loops import Braked

PINS = {f"f{k}.tau_sliding": 0.5 for k in "abcd"}
LOADED = {1: 0.5, 2: 1.0, 3: 2.0}
MACHINES = {
    "one contact": (Block(), {}, 6.0),
    "a blow": (Struck(), {}, 3.0),
    "brakes": (Brakes(), {}, 3.0),
    "two brakes on one shaft": (Braked(), {}, 5.0),
    "four pins": (Parallelogram(), PINS, 3.0),
    "an engine at rest": (slider_crank(w=0.0, g=9.81), friction(LOADED), 1.0),
}


@pytest.mark.filterwarnings("ignore:more joints stick:acausal.AcausalWarning")
@pytest.mark.parametrize("machine", MACHINES)
def test_an_fmu_runs_as_simulate_does(machine, tmp_path):
    model, parameters, stop = MACHINES[machine]
    compiled = ac.compile(model, parameters=parameters)
    how = {"stop_time": stop, "tolerance": 1e-6}
    run = ac.simulate(compiled, parameters=parameters, intervals=40, method="rosenbrock", **how)
    path = exported(compiled, tmp_path / "machine.fmu", 3, parameters=parameters, **how)
    found = simulated(path, "CoSimulation", stop, start_values={"solver.damping": 1})
    at = np.searchsorted(run.time, found["time"] * (1 + 1e-12), side="right") - 1
    for name in (name for name in found.dtype.names[1:] if not name.startswith("integrated.")):
        own = np.asarray(run[name])[at]
        np.testing.assert_allclose(found[name], own, rtol=0, atol=1e-12 * (np.ptp(own) or 1.0), err_msg=name)


@pytest.mark.filterwarnings("ignore:.*faster than they are checked:acausal.AcausalWarning")
@pytest.mark.parametrize("version", [2, 3])
def test_brakes_hold_however_long_the_run_is(version, tmp_path):
    """They stop within 7 ms; what an event leaves of their speeds would stay."""
    path = exported(ac.compile(Brakes()), tmp_path / "a.fmu", version, stop_time=1000.0)
    w = 70 / 27
    found = simulated(path, "CoSimulation", 1000.0, output=["a.phi", "b.phi"])
    assert found["a.phi"][-1] == pytest.approx((10**2 - w**2) / 1e4 + w**2 / 1e3, rel=1e-8)
    assert found["b.phi"][-1] == pytest.approx(-(5**2) / 1.2e4 + w**2 / 8e3 + w**2 / 1e3, rel=1e-8)
