"""Tests of the core need its library: what does without it is tested elsewhere."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from acausal.core import why_not
from acausal.core.build.compiling import own_compiler
from acausal.core.library import WITHOUT
from tests.acausal.core.faces import compiled, resources


@pytest.fixture(autouse=True)
def _library():
    if why_not() and (os.environ.get(WITHOUT) or not own_compiler()):
        pytest.skip(why_not())
    assert not why_not()


@pytest.fixture(scope="session")
def toy(tmp_path_factory) -> Path:
    """A library of the faces of FMI with an engine to try them with."""
    if not own_compiler() or sys.platform == "win32":
        pytest.skip("there is no C compiler that takes these options")
    return compiled(tmp_path_factory.mktemp("toy"), own_compiler())


@pytest.fixture
def folder(tmp_path: Path) -> str:
    """A folder with its model."""
    return str(resources(tmp_path))
