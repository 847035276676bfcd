"""Packages that are not always installed, with which tests write what readers read."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest


def nastran(name: str) -> Any:
    """Return `pyyeti.nastran.NAME`, or skip; other tests go on with numpy's print options as they were."""
    with np.printoptions():
        return pytest.importorskip(
            f"pyyeti.nastran.{name}",
            reason="pyyeti, the extra nastran, is not installed: it brings numba, 70 MB",
            exc_type=ImportError,
        )
