"""A loop whose constraint was dropped wrongly does not pass without a word."""

from __future__ import annotations

import re

import numpy as np
import pytest

import acausal as ac
from acausal.solve.initialization import complete_by_rank
from acausal.solve.initialization.redundancy import Redundancy
from models import Bricard, FourBar


def test_a_loop_that_opens_is_named(monkeypatch):
    monkeypatch.setattr(complete_by_rank, "find_redundancy", lambda problem, at: Redundancy((0,)))
    with pytest.warns(ac.AcausalWarning, match=r"j4\.frame_a close .*four_bar\.py.* is open by"):
        result = ac.simulate(FourBar(), stop_time=0.5, tolerance=1e-4, intervals=50)
    apart = np.abs(result["b2.frame_b.r_0"][-1] - result["j4.frame_a.r_0"][-1]).max()
    assert apart > 1e-3


def test_a_loop_that_closes_again_is_named(monkeypatch):
    """With what it was open by at most, not at the end of the run."""
    monkeypatch.setattr(complete_by_rank, "find_redundancy", lambda problem, at: Redundancy((0,)))
    with pytest.warns(ac.AcausalWarning, match="is open by") as told:
        result = ac.simulate(FourBar(), stop_time=0.7, tolerance=1e-4, intervals=50)
    apart = np.abs(result["b2.frame_b.r_0"] - result["j4.frame_a.r_0"]).max(axis=1)
    most = max(float(m[1]) for w in told if (m := re.search(r"is open by (\S+) m", str(w.message))))
    assert most > 5 * apart[-1]
    assert 0.8 * apart.max() < most < 1.01 * apart.max()


@pytest.mark.filterwarnings("error::acausal.AcausalWarning")
def test_redundant_constraints_hold():
    result = ac.simulate(Bricard(), stop_time=5.0, tolerance=1e-5)
    assert not result.stats["doubts"]
