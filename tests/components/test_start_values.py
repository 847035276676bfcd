"""Start values of filters and transfer functions."""

from __future__ import annotations

import numpy as np

import acausal as ac
from acausal import Model
from components.blocks import CriticalDamping, LowpassButterworth, TransferFunction


class Free(Model):
    """Free motions from start values: the inputs are 0."""

    vibration = TransferFunction(b=(1,), a=(1, 0.4, 4), x_start=(0, 2), u=0)
    lags = CriticalDamping(n=2, f=0.5, normalized=False, x_start=(1, 3), u=0)
    filter = LowpassButterworth(n=3, x1_start=(1,), x2_start=(0.5,), xr_start=0.2, u=0)
    gain = TransferFunction(b=(2,), a=(1,), u=3)


def test_free_motions():
    result = ac.simulate(Free(), stop_time=3, tolerance=1e-9)
    t, w, p = result.time, np.sqrt(4 - 0.2**2), np.pi
    np.testing.assert_allclose(
        result["vibration.y"], 2 * np.exp(-0.2 * t) * (np.cos(w * t) + 0.2 / w * np.sin(w * t)), atol=1e-8
    )
    np.testing.assert_allclose(result["lags.y"], np.exp(-p * t) * (3 + p * t), atol=1e-8)
    assert [result[f"filter.{name}"][0] for name in ("x1[0]", "x2[0]", "xr")] == [1, 0.5, 0.2]
    np.testing.assert_array_equal(result["gain.y"], 6)
