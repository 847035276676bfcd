"""Files of all scenes, replayed and imported for other machines by emulators, against this one."""

from __future__ import annotations

import os
import shutil
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from acausal.core.build.compiling import PLATFORMS, own_compiler, ziglang
from models import SCENES
from tests.acausal.core.stored import SPANS, driver, integrated, replayed, scene, written
from tests.acausal.export.importing import RUNS, SIMULATION, imported

pytestmark = pytest.mark.slow
WINE = "/usr/lib/wine"  # where Debian puts it
# Of the range of each state; where states hardly move, the last bit of a parameter changes more than that here.
WANTED = 1e-11
# Command of the compiler, its options, and what runs the result.
MACHINES = {
    "aarch64, glibc": (["aarch64-linux-gnu-gcc"], ["-static"], "qemu-aarch64"),
    "aarch64, musl": (ziglang(), ["-target", PLATFORMS["musl-aarch64"][0], "-static"], "qemu-aarch64"),
    "Windows": (ziglang(), ["-target", PLATFORMS["windows-x86_64"][0]], "wine64"),
}


@pytest.fixture(scope="session")
def command(tmp_path_factory):
    """Compile a driver for a machine once, and say how it runs."""
    folder = tmp_path_factory.mktemp("machines")

    @cache
    def make(machine: str, source: str = "replay.c") -> list[str]:
        compiler, options, emulator = MACHINES[machine]
        runs = shutil.which(emulator, path=f"{os.environ['PATH']}{os.pathsep}{WINE}")
        if not compiler or not shutil.which(compiler[0]) or not runs:
            pytest.skip(f"there is no compiler for {machine}, or no {emulator}")
        # Without a folder of its own wine writes to that of the user.
        quiet = ["env", f"WINEPREFIX={folder / 'wine'}", "WINEDEBUG=-all"] if emulator == "wine64" else []
        made = folder / f"{Path(source).stem}{list(MACHINES).index(machine)}.exe"
        return [*quiet, runs, str(driver(source, made, compiler, *options))]

    return make


def apart(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Largest difference of each state over its range."""
    different = np.max(np.abs(one - other), axis=0)
    return np.divide(different, np.ptp(one, axis=0), out=np.zeros(len(different)), where=different > 0)


@cache
def by_last_bits(name: str, request: tuple[float, int, float]) -> np.ndarray:
    """Largest change of each state over its range when the last bit of one parameter changes."""
    model, worst = scene(name), np.zeros(len(scene(name).x))
    own = integrated(model, *request).states
    for k in np.flatnonzero(model.p):
        p = model.p.copy()
        p[k] = np.nextafter(p[k], np.inf)
        worst = np.maximum(worst, apart(own, integrated(replace(model, p=p), *request).states))
    return worst


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("machine", MACHINES)
def test_a_scene_elsewhere(machine: str, name: str, command, tmp_path: Path):
    request = SPANS[name] / 10, 200, 1e-6
    own, found = integrated(scene(name), *request), replayed(command(machine), written(name, tmp_path), *request)
    different = apart(own.states, found.states)
    assert found.end == own.end
    if found.counts != own.counts or np.any(different >= WANTED):
        assert np.all(different < np.maximum(WANTED, 2 * by_last_bits(name, request)))


@pytest.fixture(scope="session")
def own(tmp_path_factory) -> list[str]:
    """The importer for this machine."""
    return [str(driver("importer.c", tmp_path_factory.mktemp("own") / "importer", own_compiler()))]


@pytest.mark.parametrize("name", RUNS)
@pytest.mark.parametrize("machine", MACHINES)
def test_an_exported_model_elsewhere(machine: str, name: str, command, own: list[str], tmp_path: Path) -> None:
    elsewhere = command(machine, "importer.c")
    for version in (2, 3):
        here, there = (imported(c, name, SIMULATION, version, tmp_path, part=0.1)[:, 1:] for c in (own, elsewhere))
        different = apart(here, there)
        if np.any(different >= WANTED):
            assert np.all(different < np.maximum(WANTED, 2 * by_last_bits(name, (SPANS[name] / 10, 200, 1e-6))))
