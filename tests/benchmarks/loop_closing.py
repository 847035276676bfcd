"""How closed loops stay closed: states chosen by pivots against projection, scene by scene in one run."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from rich.table import Table

import acausal as ac
from models import SliderCrank
from tests.benchmarks.slider_crank_by_hand import build
from tests.benchmarks.slider_crank_methods import CONVERGED, INTERVALS, STOP, SWITCH, simulate
from tests.models.test_loops import CASES, PUBLISHED

WAYS = ("states", "projection")
TOLERANCE, REPEATS = 1e-6, 3
LEGEND = (
    f"Tolerance {TOLERANCE:g}. Error: largest at the published values, as a fraction of the value or of 1 "
    "(slider-crank: slider position, as a fraction of its range, against the hand-derived model converged in time). "
    "Gap: largest violation of a loop at the outputs, in m or rad. Ratio: integration time, projection / states."
)


@dataclass(frozen=True)
class Scene:
    """A run and how its result is judged."""

    name: str
    make: Callable[[], ac.Model]
    stop: float
    intervals: int
    method: str
    error: Callable[[ac.Result], float]
    gap: Callable[[ac.Result], float]


@dataclass(frozen=True)
class Row:
    """One run."""

    scene: str
    way: str
    used: str
    steps: int
    factorisations: int
    residuals: int
    calls: int
    seconds: float
    error: float
    gap: float


def published_error(name: str) -> Callable[[ac.Result], float]:
    """Largest error at the published values."""

    def error(result: ac.Result) -> float:
        found = []
        for at, _, values in PUBLISHED[name]:
            row = int(np.argmin(np.abs(result.time - at)))
            assert abs(result.time[row] - at) < 1e-12
            found += [abs(result[k][row] - v) / max(1, abs(v)) for k, v in values.items()]
        return float(max(found))

    return error


def case(name: str, stop: float, intervals: int) -> Scene:
    """Return a scene of the tests."""
    known = CASES[name]
    assert known.gap is not None
    title = f"{name}, {stop:g} s"
    gap = known.gap
    return Scene(
        title, known.make, stop, intervals, "auto", published_error(name), lambda r: float(np.abs(gap(r)).max())
    )


def crank_error(result: ac.Result) -> float:
    """Error of the slider position until the torque stops."""
    exact = simulate(build(), CONVERGED).outputs[1]
    return float(np.abs(result["slider_position"] - exact[: len(result.time)]).max() / np.ptp(exact))


def crank_gap(result: ac.Result) -> float:
    """Distance of the rod's end from the slider, along the bars from the bearing."""
    (u, v, *_, turn), (du, dv, *_) = (result[f"{bar}.node_deflection"][:, -1].T for bar in ("crank_bar", "rod_bar"))
    phi = result["bearing.phi"]
    end = (0.152 + u + 1j * v) * np.exp(1j * phi)
    end = end + (0.304 + du + 1j * dv) * np.exp(1j * (phi + turn + result["pin.phi"]))
    return float(np.abs(end - result["guide.s"]).max())


CRANK = round(SWITCH / STOP * INTERVALS)
SCENES = (
    case("four-bar", 5.0, 50),
    case("four-bar-spatial", 2.0, 50),
    case("bricard", 10.0, 100),
    case("bricard", 100.0, 1000),
    case("squeezer", 0.03, 100),
    case("n-four-bar, N=2", 10.0, 100),
    Scene("slider-crank, 0.7 s", SliderCrank, SWITCH, CRANK, "rosenbrock", crank_error, crank_gap),
)


def rows(scenes: Iterable[Scene] = SCENES, repeats: int = REPEATS) -> list[Row]:
    """Run every scene both ways."""
    found = []
    for scene in scenes:
        compiled = ac.compile(scene.make())
        how = {"stop_time": scene.stop, "intervals": scene.intervals, "tolerance": TOLERANCE, "method": scene.method}
        for way in WAYS:
            runs = [ac.simulate(compiled, constraints=way, **how) for _ in range(repeats)]
            stats = min((r.stats for r in runs), key=lambda s: s["integration_seconds"])
            names = ("constraints", "steps", "factorisations", "residual_evaluations", "calls", "integration_seconds")
            found.append(Row(scene.name, way, *(stats[k] for k in names), scene.error(runs[0]), scene.gap(runs[0])))
    return found


def table(found: list[Row]) -> Table:
    """Rows of a scene side by side; the ratio of integration times with the second."""
    out = Table("scene", "constraints", "steps", "LU", "residuals", "calls", "ms", "ratio", "error", "gap")
    first: dict[str, float] = {}
    for r in found:
        base = first.setdefault(r.scene, r.seconds)
        out.add_row(
            r.scene if r.way == WAYS[0] else "",
            r.way if r.used == r.way else f"{r.way}: {r.used}",
            *(str(n) for n in (r.steps, r.factorisations, r.residuals, r.calls)),
            f"{1e3 * r.seconds:.1f}",
            "" if r.way == WAYS[0] else f"{r.seconds / base:.2f}",
            f"{r.error:.1e}",
            f"{r.gap:.0e}",
        )
    return out
