"""Packages of others do what they do when they are imported, and nothing of it stays."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from components.fe.formats.third_party import optional_module

CHANGE = "import numpy\nnumpy.set_printoptions(legacy='1.13', precision=2)\n"


def test_numbers_are_printed_as_before(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a module, and of the package around it, which is imported to find the module."""
    (tmp_path / "talkative").mkdir()
    for name in ("__init__", "reader"):
        (tmp_path / "talkative" / f"{name}.py").write_text(CHANGE)
    monkeypatch.syspath_prepend(tmp_path)
    with np.printoptions(sign="+", precision=3):
        before = np.get_printoptions()
        assert optional_module("talkative.reader", "fe", "the test").numpy is np
        assert np.get_printoptions() == before
        assert repr(np.ones(2)) == "array([+1., +1.])"
