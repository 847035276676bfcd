"""Exported models for the importer in C, `tests/acausal/core/importer.c`."""

from __future__ import annotations

import subprocess
import zipfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from xml.etree.ElementTree import fromstring

import numpy as np

from acausal.export import export_fmu
from models import SCENES
from tests.acausal.core.stored import SPANS
from tests.acausal.export.hybrid import Ball, Hybrid
from tests.hard.bennett import Bennett
from tests.shared import compiled

EXCHANGE, SIMULATION = range(2)
RUNS = (*SCENES, "ball", "hybrid", "bennett")
# Communication points; of a part of each scene, and steps of Heun's method that the fastest beam allows.
POINTS = 20
QUICKEST = 1e-7


@dataclass(frozen=True)
class Unit:
    """An exported model: folder of its resources, what tells it from others, its numbers of states and indicators."""

    resources: Path
    token: str
    states: int
    indicators: int


@cache
def unit(name: str, version: int, folder: Path) -> Unit:
    """Export a scene, and take it apart."""
    made = {"ball": Ball, "hybrid": lambda: Hybrid(wanted=0.4), "bennett": Bennett}
    path = folder / f"{name}{version}.fmu"
    export_fmu(made[name]() if name in made else compiled(SCENES[name]), path, fmi_version=version)
    with zipfile.ZipFile(path) as archive:
        archive.extractall(path.with_suffix(""))
    root = fromstring((path.with_suffix("") / "modelDescription.xml").read_bytes())
    counted = root.findall("ModelStructure/Derivatives/Unknown") or root.findall(
        "ModelStructure/ContinuousStateDerivative"
    )
    indicators = int(root.get("numberOfEventIndicators") or len(root.findall("ModelStructure/EventIndicator")))
    token = root.get("guid") or root.get("instantiationToken") or ""
    return Unit(path.with_suffix("") / "resources", token, len(counted), indicators)


def span(name: str, kind: int, part: float) -> float:
    """How far a scene is run; a part in Co-Simulation."""
    if name not in SCENES:
        return 1.9
    return POINTS * QUICKEST if kind == EXCHANGE else part * SPANS[name]


def imported(
    command: list[str], name: str, kind: int, version: int, folder: Path, cycles: int = 1, part: float = 0.01
) -> np.ndarray:
    """Run a scene by a driver; return the time and the states after each step."""
    of, stop = unit(name, version, folder), span(name, kind, part)
    steps = POINTS if name in SCENES else 50 * POINTS
    counts = (repr(stop), steps, cycles, of.states, of.indicators, *range(1, 1 + of.states))
    given = [*command, str(version), str(kind), str(of.resources), of.token, *map(str, counts)]
    done = subprocess.run(given, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-500:] + done.stderr[-2000:]
    return np.array([[float(number) for number in row.split()] for row in done.stdout.splitlines()])
