"""Tests of the core need its library: what does without it is tested elsewhere."""

from __future__ import annotations

import os

import pytest

from acausal.core import why_not
from acausal.core.build.compiling import own_compiler
from acausal.core.library import WITHOUT


@pytest.fixture(autouse=True)
def _library():
    if why_not() and (os.environ.get(WITHOUT) or not own_compiler()):
        pytest.skip(why_not())
    assert not why_not()
