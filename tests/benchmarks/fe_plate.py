"""Benchmark: steps in reconfigured inertial frames beside the floating frame and the rigid body, on the plate of their paper.

    python -m tests.benchmarks.fe_plate
    python -m tests.benchmarks.fe_plate --mesh hex20 --picture docs/pictures/reconfigured.png

Figures 4 to 13 of the paper in one picture (mm, under the half sine of `fe-plate`), a table of the differences from the floating
frame for several motions and from the rigid plate in what the figures show, the gap that remains as dt -> 0 against the
spin, what an error costs, and which method pays for which load. It takes a minute and a half.
"""

from __future__ import annotations

import argparse
import time
import warnings
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal import piecewise, sin
from acausal import time as acausal_time
from components.fe import FrameLoad, FrameMotion, simulate_reconfigured
from models import FEPlate
from models.fe_plate import plate

MESH = str(Path(__file__).parents[1] / "reference/fe/plate_fe_h25.npz")
MODES, DAMPING, DT = 10, 0.05, 1e-4
# Motions: name, spin in rad/s, whether the half sine acts, stop time in s.
MOTIONS = (
    ("pulse", (0, 0, 0), True, 0.3),
    ("about y", (0, 20, 0), False, 0.15),
    ("about z", (0, 0, 20), False, 0.15),
    ("about all axes", (10, 10, 10), False, 0.15),
    ("tumbling", (2, -6, 3), False, 0.3),
)
SPINS = (1.6, 3.2, 6.4, 12.8)
# What decides which method pays: name, force on the end, whether it tumbles, damping, breaks of the force.
BLOW = 4e-4
LOADS = (
    ("pulse", "pulse", (0, 0, 0), 0.05, (0.1,)),
    ("tumbling", "none", (2, -6, 3), 0.0, ()),
    ("blow of 0.4 ms", "blow", (0, 0, 0), 0.0, (BLOW,)),
)
TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
COUNTS = (480, 960, 1920, 3840, 7680, 15360, 30720)
BEST = 1e-9
WANTED = (1e-2, 1e-4)


def pulse(t: float) -> tuple[float, float, float]:
    """Force on the end of the plate in N."""
    force = 50 / 2**0.5 * np.sin(np.pi * t / 0.1) * (t < 0.1)
    return force, 0.0, force


def steps(
    mesh: str, variant: str, spin: Any, pushed: bool, stop: float, dt: float = DT, modes: int = MODES
) -> FrameMotion:
    """The plate by steps in inertial frames."""
    loads = [FrameLoad("end", force=pulse)] if pushed else []
    damping = DAMPING if pushed else 0.0
    return simulate_reconfigured(
        plate(mesh, MODES).first(modes), loads, stop, dt, variant=variant, damping=damping, spin=spin
    )


@cache
def floating(mesh: str, spin: Any, pushed: bool, stop: float, tolerance: float = 1e-9, intervals: int = 0) -> ac.Result:
    """The plate in its floating frame."""
    model = FEPlate(mesh=mesh, spin=spin, load="pulse" if pushed else "none", damping=DAMPING if pushed else 0.0)
    return ac.simulate(model, stop_time=stop, tolerance=tolerance, intervals=intervals or round(stop / DT))


def gap(motion: FrameMotion, found: ac.Result) -> tuple[float, float]:
    """Largest difference of the angular velocity in rad/s, and of P1 by component in mm."""
    every = (len(motion.time) - 1) // (len(found.time) - 1)
    w = motion.w[::every] - found["body.w_a"]
    place = motion.place("P1")[::every] - found["body.P1.r_0"]
    return float(np.abs(w).max()), float(1e3 * np.abs(place).max())


def differences(mesh: str) -> Table:
    """Both variants against the floating frame."""
    table = Table("motion", "spin [rad/s]", "variant", "w [rad/s]", "of the largest", "P1 [mm]", title=f"dt {DT:g} s")
    for name, spin, pushed, stop in MOTIONS:
        found = floating(mesh, spin, pushed, stop)
        largest = np.linalg.norm(found["body.w_a"], axis=1).max()
        for variant in ("paper", "corrected"):
            w, place = gap(steps(mesh, variant, spin, pushed, stop), found)
            table.add_row(name, str(spin), variant, f"{w:.2g}", f"{w / largest:.2g}", f"{place:.2g}")
    return table


def limits(mesh: str) -> Table:
    """What remains of the corrected variant as dt -> 0: the cube of the spin, as long as the deformation goes with its square."""
    table = Table("spin about (1, 1, 1) [rad/s]", "w [rad/s]", "over the cube", title="corrected, dt 2.5e-5 s, 0.04 s")
    for size in SPINS:
        spin = (size / 3**0.5,) * 3
        w, _ = gap(steps(mesh, "corrected", spin, False, 0.04, dt=2.5e-5), floating(mesh, spin, False, 0.04))
        table.add_row(f"{size:g}", f"{w:.2g}", f"{w / size**3:.2g}")
    return table


class Struck(FEPlate):
    """The plate under a blow in place of the pulse."""

    def equations(self):
        force = piecewise((500.0 * sin(np.pi * acausal_time / BLOW), acausal_time < BLOW), 0)
        yield self.push.force == (force, 0, force)
        yield self.body.P1.r_0 == (self.P1_x, self.P1_y, self.P1_z)
        yield self.body.w_a == (self.w_x, self.w_y, self.w_z)


def blow(t: float) -> tuple[float, float, float]:
    """Force of the blow in N."""
    force = 500 * np.sin(np.pi * t / BLOW) * (t < BLOW)
    return force, 0.0, force


def worth(mesh: str) -> Table:
    """The cheapest run of each method for an error of its own: of the velocity of P1, of the largest one, at 60 times."""
    names = (
        "load",
        "modes",
        "error",
        "compile s",
        "floating: steps, s",
        "tolerance: steps, s",
        "steps of one size, s",
        "gap of both",
    )
    table = Table(*names, title="0.3 s, process seconds; of steps with their building")
    for name, load, spin, damping, breaks in LOADS:
        for modes in (5, 10):
            make = Struck if load == "blow" else FEPlate
            settings = {} if load == "blow" else {"load": load}
            scene = partial(make, mesh=mesh, modes=modes, spin=spin, damping=damping, **settings)
            force = {"pulse": pulse, "blow": blow}.get(load)
            push = [FrameLoad("end", force=force, breaks=breaks)] if force else []
            body = plate(mesh, modes)
            body.frequencies  # noqa: B018
            move = partial(simulate_reconfigured, body, push, 0.3, damping=damping, spin=spin)
            compiled, compiling = _timed(lambda make=scene: ac.compile(make()), 1)
            runs = [
                _series(lambda tol, m=compiled: ac.simulate(m, stop_time=0.3, tolerance=tol, intervals=60)),
                _series(lambda tol, move=move: move(tolerance=tol, intervals=60)),
            ]
            runs.append([*_counted(move), runs[1][-1]])
            gap = np.abs(runs[0][-1][0] - runs[1][-1][0]).max() / np.abs(runs[0][-1][0]).max()
            for wanted in WANTED:
                found = (_cheapest(run, wanted) for run in runs)
                table.add_row(name, str(modes), f"{wanted:g}", f"{compiling:.2f}", *found, f"{gap:.1e}")
    return table


Measured = tuple[np.ndarray, int, float]


def _series(run: Any) -> list[Measured]:
    """Velocity of P1, steps and seconds, for each tolerance and the best last."""
    found = []
    for tolerance in (*TOLERANCES, BEST):
        result, seconds = _timed(lambda tol=tolerance: run(tol), 1 if tolerance == BEST else 2)
        if isinstance(result, ac.Result):
            velocity = np.einsum("tij,ti->tj", result["body.P1.R.T"], result["body.P1.v"])
            found.append((velocity, result.stats.steps, seconds))
        else:
            found.append((result.velocity("P1"), result.steps, seconds))
    return found


def _counted(move: Any) -> list[Measured]:
    """The same for numbers of steps of one size."""
    found = []
    for count in COUNTS:
        result, seconds = _timed(lambda n=count: move(dt=0.3 / n), 2)
        found.append((result.velocity("P1")[:: count // 60], count, seconds))
    return found


def _cheapest(runs: list[Measured], wanted: float) -> str:
    best = runs[-1][0]
    fits = [run for run in runs[:-1] if np.abs(run[0] - best).max() <= wanted * np.abs(best).max()]
    if not fits:
        return "none"
    _, steps, seconds = min(fits, key=lambda run: run[2])
    return f"{steps}, {seconds:.3f}"


def costs(mesh: str) -> Table:
    """Steps, operations and seconds for an error of the angular velocity under the pulse."""
    table = Table("method", "step or tolerance", "steps", "error of w [rad/s]", "process s", title="pulse, 0.3 s")
    model = ac.compile(FEPlate(mesh=mesh, damping=DAMPING))
    exact = floating(mesh, (0, 0, 0), True, 0.3)
    for tolerance in (1e-4, 1e-6, 1e-8):
        found, seconds = _timed(lambda tol=tolerance: ac.simulate(model, stop_time=0.3, tolerance=tol, intervals=300))
        error = np.abs(found["body.w_a"] - exact["body.w_a"][::10]).max()
        table.add_row("floating frame", f"{tolerance:g}", str(found.stats.steps), f"{error:.1e}", f"{seconds:.3f}")
    for variant in ("paper", "corrected"):
        for dt in (5e-4, 2.5e-4, 1e-4, 5e-5):
            motion, seconds = _timed(lambda v=variant, h=dt: steps(mesh, v, (0, 0, 0), True, 0.3, dt=h))
            every = round(5e-4 / dt)
            error = np.abs(motion.w[::every] - exact["body.w_a"][::5]).max()
            counts = f"{len(motion.time) - 1} of {motion.march.operations}"
            table.add_row(variant, f"{dt:g} s", counts, f"{error:.1e}", f"{seconds:.3f}")
    push = [FrameLoad("end", force=pulse, breaks=(0.1,))]
    for tolerance in (1e-2, 1e-4, 1e-6):
        motion, seconds = _timed(
            lambda tol=tolerance: simulate_reconfigured(
                plate(mesh, MODES), push, 0.3, tolerance=tol, intervals=60, damping=DAMPING
            )
        )
        error = np.abs(motion.w - exact["body.w_a"][::50]).max()
        counts = f"{motion.steps} of {motion.march.operations // 2}, {motion.rejected} rejected"
        table.add_row("corrected", f"{tolerance:g}", counts, f"{error:.1e}", f"{seconds:.3f}")
    return table


def _timed(run: Any, times: int = 3) -> tuple[Any, float]:
    """Least processor time of some runs."""
    best, found = np.inf, None
    for _ in range(times):
        began = time.process_time()
        found = run()
        best = min(best, time.process_time() - began)
    return found, best


def figures(mesh: str) -> Table:
    """What the figures compare: largest differences of the printed variant from the rigid plate, Newton-Euler by the engine."""
    flexible = steps(mesh, "paper", (0, 0, 0), True, 0.3)
    rigid = steps(mesh, "corrected", (0, 0, 0), True, 0.3, modes=0)
    model = FEPlate(mesh=mesh, formulation="rigid")
    scene = ac.simulate(model, stop_time=0.3, tolerance=1e-9, intervals=round(0.3 / DT))
    w, al = scene["body.w_a"], scene["body.z_a"]
    place = scene["body.P1.r_0"]
    a = np.einsum("tij,ti->tj", scene["body.P1.R.T"], scene["body.P1.a"])
    embedded, X = flexible.acceleration("P1", embedded=True), place[0]
    inward = np.einsum("tij,ti->tj", flexible.T, np.cross(flexible.w, np.cross(flexible.w, X)))
    table = Table("figure", "of", "largest difference", "largest value", title=f"pulse, printed variant, dt {DT:g} s")
    for figure, what, unit, found, known in (
        ("", "rigid plate by steps: angular velocity", "rad/s", rigid.w, w),
        ("", "rigid plate by steps: P1", "mm", 1e3 * rigid.place("P1"), 1e3 * place),
        ("", "rigid plate by steps: acceleration of P1", "mm/s2", 1e3 * rigid.acceleration("P1"), 1e3 * a),
        ("5, 8", "angular acceleration, flexible", "rad/s2", flexible.al, al),
        ("6, 9", "angular velocity, flexible", "rad/s", flexible.w, w),
        (
            "7",
            "P1 along y, flexible",
            "mm",
            1e3 * (flexible.place("P1") - place[0])[:, 1],
            1e3 * (place - place[0])[:, 1],
        ),
        ("10, 11", "acceleration of P1, embedded", "mm/s2", 1e3 * embedded, 1e3 * a),
        ("10, 11", "the same without w x (w x X)", "mm/s2", 1e3 * (embedded - inward), 1e3 * a),
        ("12, 13", "acceleration of P1, flexible", "mm/s2", 1e3 * flexible.acceleration("P1"), 1e3 * a),
    ):
        table.add_row(figure, what, f"{np.abs(found - known).max():.3g} {unit}", f"{np.abs(known).max():.3g} {unit}")
    return table


def draw(mesh: str, path: str) -> None:
    """Figures 4 to 13."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    flexible = steps(mesh, "paper", (0, 0, 0), True, 0.3)
    rigid = steps(mesh, "corrected", (0, 0, 0), True, 0.3, modes=0)
    t, body, rest = flexible.time, 1e3 * flexible.acceleration("P1"), 1e3 * rigid.acceleration("P1")
    rbm = 1e3 * flexible.acceleration("P1", embedded=True)
    shown = 1e3 * (flexible.place("P1") - flexible.place("P1")[0])
    panels = [
        ("4: force in N", [("x = z", [pulse(x)[0] for x in t])]),
        ("5: angular acceleration in rad/s2", [("x", flexible.al[:, 0]), ("z", flexible.al[:, 2])]),
        ("6: angular velocity in rad/s", [("x", flexible.w[:, 0]), ("z", flexible.w[:, 2])]),
        ("7: displacement of P1 along y in mm", [("y", shown[:, 1])]),
        ("8: angular acceleration about y", [("flexible", flexible.al[:, 1]), ("rigid", rigid.al[:, 1])]),
        ("9: angular velocity about y", [("flexible", flexible.w[:, 1]), ("rigid", rigid.w[:, 1])]),
        ("10: P1 along x in mm/s2, embedded", [("embedded", rbm[:, 0]), ("rigid", rest[:, 0])]),
        ("11: along z, embedded", [("embedded", rbm[:, 2]), ("rigid", rest[:, 2])]),
        ("12: along x, flexible", [("flexible", body[:, 0]), ("rigid", rest[:, 0])]),
        ("13: along z, flexible", [("flexible", body[:, 2]), ("rigid", rest[:, 2])]),
    ]
    figure, axes = plt.subplots(5, 2, figsize=(11, 13), sharex=True, layout="constrained")
    for axis, (title, curves) in zip(axes.flat, panels, strict=True):
        for k, (label, values) in enumerate(curves):
            axis.plot(t, values, "--" if k else "-", lw=1, label=label)
        axis.set_title(title, fontsize=9)
        axis.legend(fontsize=7)
    for axis in axes[-1]:
        axis.set_xlabel("time in s")
    figure.savefig(path, dpi=90)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mesh", default=MESH, help="hex20, tet10, or a .npz file as of fe-plate")
    parser.add_argument("--picture", default="fe-plate-figures.png", help="file of the picture")
    given = parser.parse_args()
    warnings.simplefilter("ignore", ac.AcausalWarning)
    console = Console()
    for table in (differences, figures, limits, costs, worth):
        console.print(table(given.mesh))
    draw(given.mesh, given.picture)


if __name__ == "__main__":
    main()
