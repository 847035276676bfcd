"""Files of models, and the driver in C that integrates them."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import casadi as ca
import numpy as np

from acausal.compiler.core_equations import core_equations
from acausal.core import End, StoredModel
from acausal.core.build.compiling import CORE, FLAGS
from acausal.language.functions import time
from acausal.policy import POLICY
from acausal.solve.initialization.coordinate_partitioning import choose_projection
from acausal.solve.initialization.initial_modes import leave_singular_start, start
from acausal.solve.integrate.one_step import are_rates
from acausal.solve.problem import Problem
from models import SCENES
from tests.acausal.core.stepper import Stepper, with_powers
from tests.shared import CONTRACT, compiled

# Lengths of the first smooth segment of each scene: the torque of the slider-crank ends, the parallelogram comes to lie flat.
SPANS = {name: stop for name, (_, stop) in CONTRACT.items()} | {"slider-crank": 0.7, "n-four-bar": 0.7}
HERE = Path(__file__).parent
SANITIZED = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-g", "-O1")


@cache
def scene(name: str) -> StoredModel:
    """Return a scene as it starts; projections of its closed loops move."""
    model, span = compiled(SCENES[name]), SPANS[name]
    problem = Problem(model, model.parameter_values(None), POLICY.loops.feedback / span)
    at = leave_singular_start(
        problem, start(problem, 0.0, span / 20, "fixed"), span / 20
    )  # before anything changes by the clock
    moves = bool(model.constraints.size)
    if moves:
        at = problem.projected(at)
        at = replace(at, constants=choose_projection(problem, at, moves=True))
    r = model.reduced
    powers = ca.substitute(model.powers, r.projections.moves, moves)
    return StoredModel(
        with_powers(core_equations(model, moves), (r.x, r.z, time.sx, r.p, r.constants), powers),
        at.time,
        *(at.x, at.z, problem.p, at.constants.vector),
        size=problem.nominal[: problem.nx],
        rate=are_rates(model),
        names=model.states,
    )


def written(name: str, folder: Path) -> Path:
    """Write a scene into a folder; return its file."""
    path = folder / f"{name}.bin"
    path.write_bytes(scene(name).content)
    return path


def sanitizes(compiler: list[str], folder: Path) -> bool:
    """Return whether a compiler has sanitisers."""
    probe = folder / "probe.c"
    probe.write_text("int main(void) { return 0; }\n")
    command = [*compiler, *SANITIZED, str(probe), "-o", str(folder / "probe")]
    return not subprocess.run(command, capture_output=True).returncode


def driver(source: str, made: Path, compiler: list[str], *options: str) -> Path:
    """Compile a driver together with the core."""
    flags = [flag for flag in FLAGS if flag not in ("-shared", "-fvisibility=hidden")]
    sources = [HERE / source, *sorted((CORE / "source").glob("*.c"))]
    command = [*compiler, *flags, *options, f"-I{CORE / 'source'}", *map(str, sources), "-lm", "-o", str(made)]
    subprocess.run(command, check=True, capture_output=True, text=True)
    return made


@dataclass(frozen=True)
class Replayed:
    """What an integration gave: names of the states; time, x, z and integrals at each output; how it ended, and counts."""

    names: tuple[str, ...]
    rows: np.ndarray
    end: End
    counts: tuple[int, ...]
    time: float

    @property
    def states(self) -> np.ndarray:
        """States at the outputs."""
        return self.rows[:, 1 : 1 + len(self.names)]


def replayed(
    command: list[str], path: Path, span: float, outputs: int, tolerance: float, library: str = ""
) -> Replayed:
    """Integrate a file by a driver."""
    given = [*command, str(path), repr(span), str(outputs), repr(tolerance), *([library] if library else [])]
    done = subprocess.run(given, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    names, *rows, last = done.stdout.splitlines()
    end, *counts, time = last.split()
    found = np.array([[float(number) for number in row.split()] for row in rows])
    return Replayed(tuple(names.split("\t")[:-1]), found, End(int(end)), tuple(map(int, counts)), float(time))


def integrated(model: StoredModel, span: float, outputs: int, tolerance: float, method: str = "rodas") -> Replayed:
    """Integrate a model by the library."""
    stepper, times = Stepper(model.equations, method), model.time + span * np.arange(outputs + 1) / outputs
    given = (model.x, model.z, model.p, model.c)
    size = model.size if method == "rodas" else np.append(model.size, np.ones(model.equations.nz))
    found = stepper.begin(times, *given, size=size, rate=model.rate, smooth=True, tolerance=tolerance, most=1_000_000)
    end, done = stepper.go(1_000_000), stepper.progress
    rows = np.column_stack([times[1:], found.x, found.z, found.integral])[: done.written]
    counts = done.steps, done.refused, done.slopes, done.values, done.pivots
    return Replayed(model.names, rows, end, counts, done.time)
