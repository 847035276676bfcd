"""Benchmark: what a body from FE matrices costs, against the number of its modes.

    python -m tests.benchmarks.fe
    python -m tests.benchmarks.fe --bases

Operations with Jacobian, processor time of compiling and of a run, and steps: of a body without any symmetry that moves freely
under a load, and of `fe-pendulum`. Every model is compiled after a small one, which loads what is loaded once. With --bases the
tip of the pendulum for several bases, against the body with 100 modes.
"""

from __future__ import annotations

import sys
import time
import warnings
from functools import cache
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal import Model, chain, connect, fixed, part, parts, structural
from components import FixedTranslation, Spherical, World, WorldForce, WorldTorque
from components.fe import FEBody, ReducedBody, box, reduce_body
from models import FEPendulum
from models.fe_pendulum import COUNTS, HINGE, MASS, SIZE, TIP

MODES = (5, 10, 20, 40)
# Compiling a body without symmetry, and running the pendulum, in s, of a prototype that was written for these bodies alone.
PROTOTYPE = {5: (0.08, 0.03), 10: (0.14, 0.14), 20: (0.36, 0.46), 40: (1.7, 1.3)}
STOP, TOLERANCE = 0.3, 1e-7


@cache
def lopsided(modes: int) -> ReducedBody:
    """A block whose density and stiffness differ from node to node: no integral over its mass vanishes."""
    M, K, nodes = box((0.5, 0.3, 0.2), (4, 3, 2), "hex8", E=1e8, nu=0.3, rho=2000.0)
    rng = np.random.default_rng(0)
    M.setdiag(M.diagonal() + np.repeat(rng.uniform(0, 2, len(nodes)), 3))
    frames = {"root": [0, 1, 5], "tip": [-1 % len(nodes), -2 % len(nodes), -6 % len(nodes)]}
    return reduce_body(M, K, nodes, frames=frames, hold="root", modes=modes)


class Lopsided(Model):
    """It moves freely, with a force and a torque that turn with its far end."""

    modes: int = structural("number of modes", default=2, minimum=1)
    world = World()
    force = WorldForce(force=(5.0, 3.0, -4.0), resolve_in_frame="frame_b")
    torque = WorldTorque(torque=(0.5, 0.2, -0.3), resolve_in_frame="frame_b")

    @part
    def body(self):
        start: dict = {"r_0": fixed((0, 0, 0)), "v_0": fixed((0, 0, 0)), "w_a": fixed((1, 2, 3)), "angles_fixed": True}
        return FEBody(reduced=lopsided(self.modes), **start)

    def connections(self):
        yield connect(self.body.tip, self.force.frame_b)
        yield connect(self.body.tip, self.torque.frame_b)


def measure(model: Model) -> dict[str, Any]:
    """Operations, seconds of processor time to compile and to run, and steps."""
    seconds = []
    for _ in range(3):
        before = time.process_time()
        compiled = ac.compile(model)
        seconds.append(time.process_time() - before)
    ac.simulate(compiled, stop_time=STOP / 100, tolerance=TOLERANCE)
    runs = []
    for _ in range(3):
        before = time.process_time()
        result = ac.simulate(compiled, stop_time=STOP, tolerance=TOLERANCE)
        runs.append(time.process_time() - before)
    return {
        "operations": compiled.report["operations"],
        "compile": min(seconds),
        "run": min(runs),
        "steps": result.stats["steps"],
    }


def costs() -> Table:
    """What bodies cost, against the number of modes."""
    ac.compile(Lopsided())
    table = Table(
        "body", "modes", "operations", "per modes^2", "compile, s", "(prototype)", "steps", "run, s", "(prototype)"
    )
    for modes in MODES:
        for name, model in (("lopsided, free", Lopsided(modes=modes)), ("fe-pendulum", FEPendulum(modes=modes))):
            lopsided(modes)
            found, known = measure(model), PROTOTYPE[modes]
            pendulum = name == "fe-pendulum"
            table.add_row(
                *(name, str(modes), f"{found['operations']:,}", f"{found['operations'] / modes**2:.0f}"),
                *(f"{found['compile']:.2f}", "" if pendulum else f"{known[0]:g}"),
                *(str(found["steps"]), f"{found['run']:.2f}", f"{known[1]:g}" if pendulum else ""),
            )
    return table


HELD = {"hinge": "xyz", "tip": "z"}
BASES: dict[str, dict[str, Any]] = {
    "hinge held": {"hold": HELD},
    "Craig-Bampton, hinge held": {"hold": HELD, "basis": "craig-bampton"},
    "mean axes": {"hold": "mean-axis"},
    "three nodes, on balls": {"hold": (2, 50, 0)},
    "mean axes, on balls": {"hold": "mean-axis"},
}
FINE, TRIED = 100, (9, 18, 40)


def rod(frames: dict[str, Any], modes: int, **how: Any) -> FEBody:
    """The rod of the pendulum, reduced otherwise."""
    M, K, nodes = box(SIZE, COUNTS, "hex8", E=1e7, nu=0.49, rho=MASS / (SIZE[0] * SIZE[1] * SIZE[2]))
    return FEBody(reduced=reduce_body(M, K, nodes, frames=frames, modes=modes, **how), check_range=False)


def hinged(modes: int, **how: Any) -> Model:
    """The pendulum with a rod of some basis, its hinge the average of the nodes."""

    class Other(FEPendulum):
        @part
        def body(self):
            return rod({"hinge": HINGE, "tip": [TIP]}, modes, **how)

    return Other()


def on_balls(modes: int, **how: Any) -> Model:
    """The same with a ball joint at each node of the hinge: nine constraints, as a clamped line of nodes has."""

    class Balls(Model):
        world = World(g=9.81, n=(0, 0, -1))

        @parts
        def place(self):
            return [FixedTranslation(r=(0, SIZE[1] * k / 2, 0)) for k in range(3)]

        @parts
        def ball(self):
            rest: dict = {"angles_fixed": True, "w_rel": fixed((0, 0, 0))}
            return [Spherical(), Spherical(**rest), Spherical()]

        @part
        def body(self):
            return rod({f"node_{k}": [HINGE[k]] for k in range(3)} | {"tip": [TIP]}, modes, **how)

        def connections(self):
            for k in range(3):
                yield chain(self.world, self.place[k], self.ball[k], self.body.frames[f"node_{k}"])

    return Balls()


def swing(model: Model) -> np.ndarray:
    """Height of the tip over the time of the scene."""
    return ac.simulate(model, stop_time=FEPendulum.stop_time, tolerance=1e-7)["body.tip.r_0"][:, 2]


def bases() -> Table:
    """How near to the body with many modes each basis comes."""
    reference = swing(hinged(FINE, hold=HELD))
    table = Table("basis", *(f"{modes} modes, m" for modes in TRIED), title="largest deviation of the tip")
    for name, how in BASES.items():
        make = on_balls if "balls" in name else hinged
        table.add_row(name, *(f"{np.abs(swing(make(modes, **how)) - reference).max():.1e}" for modes in TRIED))
    return table


def main() -> None:
    """Print the tables."""
    warnings.simplefilter("ignore", ac.AcausalWarning)
    Console(width=120).print(bases() if "--bases" in sys.argv else costs())


if __name__ == "__main__":
    main()
