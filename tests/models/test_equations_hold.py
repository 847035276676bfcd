"""Whatever is read satisfies the equations of the model: all components, scenes and small machines, methods and tolerances."""

from __future__ import annotations

from itertools import product

import pytest

import acausal as ac
from acausal import Model
from models import SCENES
from tests.acausal.solve.machines import Axis, Fall, Tether, Two
from tests.components.test_properties import SCENES as WITH_COMPONENT
from tests.shared import compiled, pairwise, worst_equation

SHORT = {"free-vibration": 0.02, "pendulum": 0.3, "spin-up": 5.0, "slider-crank": 0.75, "bricard": 2.0}
# Where one method alone takes minutes to follow vibrations, or does not get past a flat position.
RINGS = {(1e-5, "idas"), (1e-8, "idas")}
FLAT = {(tolerance, "rosenbrock") for tolerance in (1e-3, 1e-5, 1e-8)}
CHOOSY = {"slider-crank": RINGS, "pendulum": RINGS, "free-vibration": RINGS, "n-four-bar": FLAT}
# Scenes in which IDAS ends at a tolerance of 1e-3: the force of a tyre has kinks where its damper is limited.
STEEP = {"Tyre"}
MACHINES: dict[str, tuple[type[Model], float]] = {c.__name__: (c, 1.0) for c in (Axis, Fall, Tether, Two)}
MODELS = MACHINES | {name: (c, SHORT.get(name, c.stop_time / 3)) for name, c in SCENES.items()}


QUICK = [name for name in MODELS if name not in ("slider-crank", "squeezer", "bricard")]
LONG = [name for name in MODELS if name not in QUICK]


@pytest.mark.filterwarnings("ignore:.*linear frames")
@pytest.mark.parametrize(
    ("name", "tolerance", "method"),
    [
        *pairwise(QUICK, [1e-3, 1e-5, 1e-8], ["idas", "rosenbrock"]),
        *(pytest.param(*c, marks=pytest.mark.slow) for c in product(LONG, [1e-3, 1e-5, 1e-8], ["idas", "rosenbrock"])),
    ],
)
def test_every_equation_holds_at_every_output(name, tolerance, method):
    cls, stop = MODELS[name]
    model = compiled(cls)
    options = {"tolerance": tolerance, "intervals": 60, "method": method}
    if name in CHOOSY and (tolerance, method) in CHOOSY[name]:
        options["method"] = "auto"
    result = ac.simulate(model, stop_time=stop, **options)
    assert worst_equation(result, model) < 1e-10


@pytest.mark.parametrize("name", WITH_COMPONENT)
def test_every_equation_holds_around_every_component(name):
    model = compiled(WITH_COMPONENT[name])
    loose = 1e-5 if name in STEEP else 1e-3
    for tolerance, method in ((loose, "idas"), (1e-6, "rosenbrock")):
        result = ac.simulate(model, stop_time=0.5, tolerance=tolerance, method=method, intervals=20)
        assert worst_equation(result, model) < 1e-10
