"""An importer in C goes through all calls a hundred times: nothing is lost, and no memory is used that is not its own."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from acausal.core.build.compiling import own_compiler
from tests.acausal.core.stored import SANITIZED, driver, sanitizes
from tests.acausal.export.importing import EXCHANGE, POINTS, RUNS, SIMULATION, imported

pytestmark = pytest.mark.slow
CYCLES = 100


@pytest.fixture(scope="session")
def folder(tmp_path_factory) -> Path:
    return tmp_path_factory.mktemp("units")


@pytest.fixture(scope="session")
def plain(folder: Path) -> list[str]:
    if not own_compiler():
        pytest.skip("there is no C compiler")
    return [str(driver("importer.c", folder / "plain", own_compiler()))]


@pytest.fixture(scope="session")
def sanitized(plain: list[str], folder: Path) -> list[str]:
    if not sanitizes(own_compiler(), folder):
        pytest.skip("the C compiler has no sanitisers")
    return [str(driver("importer.c", folder / "sanitized", own_compiler(), *SANITIZED))]


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("kind", [EXCHANGE, SIMULATION])
@pytest.mark.parametrize("name", RUNS)
def test_a_hundred_instances_under_the_sanitisers(
    name: str, kind: int, version: int, plain: list[str], sanitized: list[str], folder: Path
) -> None:
    own = imported(plain, name, kind, version, folder)
    found = imported(sanitized, name, kind, version, folder, CYCLES)
    assert len(own) >= POINTS
    assert np.array_equal(own, found)


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("kind", [EXCHANGE, SIMULATION])
@pytest.mark.parametrize("name", ["simple-pendulum", "four-bar", "hybrid", "bennett"])
def test_a_hundred_instances_leave_no_memory_behind(
    name: str, kind: int, version: int, plain: list[str], folder: Path
) -> None:
    if not shutil.which("valgrind"):
        pytest.skip("there is no valgrind")
    watched = ["valgrind", "--quiet", "--leak-check=full", "--show-leak-kinds=all", "--error-exitcode=9", *plain]
    own, found = imported(plain, name, kind, version, folder), imported(watched, name, kind, version, folder, CYCLES)
    assert np.array_equal(own, found)
