"""Memory of the core that one run leaves to the next: nothing of what was computed with it shows."""

from __future__ import annotations

import gc

import numpy as np
import pytest

import acausal as ac
from acausal.core.library import Pool
from models import SCENES, SpinUp

pytestmark = pytest.mark.filterwarnings("ignore::acausal.AcausalWarning")


def bits(model: ac.CompiledModel, **options: object) -> list[bytes]:
    """All outputs, and what the run took."""
    result = ac.simulate(model, method="auto", **options)  # pyright: ignore[reportArgumentType]
    counts = [result.stats[name] for name in ("steps", "factorisations", "residual_evaluations")]
    return [np.array(counts).tobytes(), *(np.asarray(result[name]).tobytes() for name in result.outputs)]


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch) -> list[bool]:
    """Of all memory that is taken, whether it had served before."""
    seen, found, take = set[int](), list[bool](), Pool.take

    def watched(pool: Pool) -> int:
        memory = take(pool)
        found.append(memory in seen)
        seen.add(memory)
        return memory

    monkeypatch.setattr(Pool, "take", watched)
    return found


@pytest.mark.parametrize("name", ["spin-up", "squeezer", "four-bar", "car-axis", "fe-plate"])
def test_runs_do_not_depend_on_those_before(name: str, served: list[bool]) -> None:
    scene = SCENES[name]
    stop = 0.1 * float(getattr(scene, "stop_time"))  # noqa: B009
    fresh = bits(ac.compile(scene()), stop_time=stop, tolerance=1e-7)
    model = ac.compile(scene())
    rough = bits(model, stop_time=stop, tolerance=1e-4)
    bits(model, stop_time=stop, tolerance=1e-3, intervals=37)
    assert bits(model, stop_time=stop, tolerance=1e-7) == fresh
    assert bits(model, stop_time=stop, tolerance=1e-4) == rough
    assert any(served)


def test_other_parameters_and_back(served: list[bool]) -> None:
    model = ac.compile(SpinUp())
    first, other = (bits(model, parameters={"omega": omega}, tolerance=1e-5) for omega in (4.0, 9.0))
    assert first != other
    assert bits(model, parameters={"omega": 4.0}, tolerance=1e-5) == first
    assert bits(model, parameters={"omega": 9.0}, tolerance=1e-5) == other
    assert any(served)


def test_memory_is_given_back() -> None:
    """What idles is what was in use at once, however many runs there were."""
    before = pools()
    model = ac.compile(SpinUp())
    for tolerance in np.geomspace(1e-3, 1e-6, 12):
        ac.simulate(model, tolerance=float(tolerance))
    idle = [len(pool._idle) for pool in pools() if pool not in before]
    assert max(idle) in (1, 2, 3)


def pools() -> list[Pool]:
    return [found for found in gc.get_objects() if isinstance(found, Pool)]
