"""Files of all scenes, replayed for other machines by emulators, against the library of this one."""

from __future__ import annotations

import os
import shutil
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from acausal.core.build.compiling import PLATFORMS, ziglang
from models import SCENES
from tests.acausal.core.stored import SPANS, driver, integrated, replayed, scene, written

pytestmark = pytest.mark.slow
WINE = "/usr/lib/wine"  # where Debian puts it
# Of the largest state in the error test's sizes: over the range of a state that hardly moves its rounding is large.
LARGEST = 1e-11
# Command of the compiler, its options, and what runs the result.
MACHINES = {
    "aarch64, glibc": (["aarch64-linux-gnu-gcc"], ["-static"], "qemu-aarch64"),
    "aarch64, musl": (ziglang(), ["-target", PLATFORMS["musl-aarch64"][0], "-static"], "qemu-aarch64"),
    "Windows": (ziglang(), ["-target", PLATFORMS["windows-x86_64"][0]], "wine64"),
}


@pytest.fixture(scope="session")
def command(tmp_path_factory):
    """Compile the driver for a machine once, and say how it runs."""
    folder = tmp_path_factory.mktemp("machines")

    @cache
    def make(machine: str) -> list[str]:
        compiler, options, emulator = MACHINES[machine]
        runs = shutil.which(emulator, path=f"{os.environ['PATH']}{os.pathsep}{WINE}")
        if not compiler or not shutil.which(compiler[0]) or not runs:
            pytest.skip(f"there is no compiler for {machine}, or no {emulator}")
        return [runs, str(driver("replay.c", folder / f"{list(MACHINES).index(machine)}.exe", compiler, *options))]

    return make


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("machine", MACHINES)
def test_a_scene_elsewhere(machine: str, name: str, command, tmp_path: Path, monkeypatch):
    monkeypatch.setenv("WINEDEBUG", "-all")
    own = integrated(scene(name), SPANS[name] / 10, 200, 1e-6)
    found = replayed(command(machine), written(name, tmp_path), SPANS[name] / 10, 200, 1e-6)
    assert (found.end, found.counts) == (own.end, own.counts)
    sizes = np.max(np.abs(own.states), axis=0) + scene(name).size
    assert np.max(np.abs(found.states - own.states) / sizes) < LARGEST
