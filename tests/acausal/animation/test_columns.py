"""Columns are kept once, and frames are chosen so that nothing that jumps or ends is lost."""

import base64
import zlib

import numpy as np
import pytest

from acausal.animation.columns import Columns
from acausal.animation.frames import select_frames


def test_equal_columns_and_constants_are_kept_once() -> None:
    columns, t = Columns(5), np.linspace(0, 1, 5)
    vector = columns.add(np.stack([t, 0 * t + 2, t**2], axis=1))
    matrix = columns.add(np.stack([t**2, 0 * t - 0.0, 0 * t, 0 * t + 2], axis=1).reshape(5, 2, 2))
    closed = columns.resolve({"vector": vector, "matrix": {"in": matrix}, "number": 7, "time": columns.add(t)})
    assert (closed["varying"], closed["constant"], closed["frames"]) == (2, 2, 5)
    assert closed["vector"] == [0, 2, 1]
    assert closed["matrix"] == {"in": [[1, 3], [3, 2]]}
    assert (closed["number"], closed["time"]) == (7, 0)
    data = np.frombuffer(zlib.decompress(base64.b64decode(closed["data"])), dtype="<f4")
    assert data.tolist() == [*t, *t**2, 2, 0]


@pytest.mark.parametrize("far", [0.0, 4e6, -3e9])
def test_columns_far_from_zero_are_as_exact_as_those_near_it(far: float) -> None:
    columns, t = Columns(101), np.linspace(0, 1, 101)
    exact = far + np.stack([np.sin(t), np.cos(3 * t), 0 * t + 0.1], axis=1)
    closed = columns.resolve({"places": columns.add(exact, 1.0)})
    data = np.frombuffer(zlib.decompress(base64.b64decode(closed["data"])), dtype="<f4").astype(float)
    n, varying = 101, closed["varying"]
    assert (varying, closed["constant"]) == (2, 1)
    found = [*data[: n * varying].reshape(varying, n), *data[n * varying :, None]]
    for k, column in zip(closed["places"], exact.T, strict=True):
        again = found[k] + closed["offsets"].get(str(k), 0.0)
        assert np.max(np.abs(again - column)) <= 1e-7 + np.spacing(abs(far))
    assert bool(closed["offsets"]) == bool(far)


def test_columns_that_differ_by_their_offset_alone_are_two() -> None:
    columns, t = Columns(11), np.linspace(0, 1, 11)
    one, other, near = columns.add(np.stack([1e6 + t, 2e6 + t, t - 0.5], axis=1), 1.0)
    assert len({one, other, near}) == 3


def test_columns_whose_size_does_not_count_have_no_offset() -> None:
    columns = Columns(3)
    columns.add(np.array([1e9, 1e9 + 1, 1e9 + 2]))
    columns.add(np.array([1e9, np.nan, np.inf]), 1.0)
    assert columns.resolve({})["offsets"] == {}


def test_one_frame_has_constants_only() -> None:
    columns = Columns(1)
    columns.add(np.array([[1.0, 2.0]]))
    assert columns.resolve({})["varying"] == 0


@pytest.mark.parametrize("times", [0, 1, 2, 9, 10])
def test_short_results_are_shown_whole(times: int) -> None:
    assert select_frames(np.arange(times), 10).tolist() == list(range(times))


@pytest.mark.parametrize("frames", [2, 3, 100, 1999])
def test_long_results_keep_both_ends_and_both_sides_of_jumps(frames: int) -> None:
    time = np.sort(np.concatenate([np.linspace(0, 1, 20_001), [0.123457, 0.777777], [0.123457, 0.777777]]))
    chosen = select_frames(time, frames)
    assert chosen[0] == 0
    assert chosen[-1] == len(time) - 1
    assert np.all(np.diff(chosen) > 0)
    assert frames <= len(chosen) <= frames + 4
    assert np.sum(np.diff(time[chosen]) == 0) == 2
    assert np.max(np.diff(time[chosen])) <= 1 / (frames - 1) + 2 * 5e-5
