"""Discrete state spaces against scipy, edges, and instants before the start."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import dlsim

import acausal as ac
from acausal import Model, Scalar, connect, discrete, reinit, when
from acausal import time as now
from components import blocks

SYSTEM = [np.array(m) for m in ([[0.5, 0.1], [0, 0.9]], [[1.0], [0.5]], [[1.0, 0], [1, 1]], [[0.0], [1]])]


class Discrete(Model):
    """A system with two outputs, and a count of edges."""

    pulse = blocks.Pulse(period=0.5, width=50, start_time=0.13)
    system = blocks.DiscreteStateSpace(**dict(zip("ABCD", SYSTEM, strict=True)), sample_period=0.2)
    edge = blocks.Edge()
    count: Scalar = discrete("edges")

    def connections(self):
        yield connect(self.pulse.y, self.edge.u)

    def equations(self):
        yield self.system.u[0] == self.pulse.y
        yield when(self.edge.y > 0.5, reinit(self.count, self.count + 1))


def test_discrete_state_space():
    result = ac.simulate(Discrete(), stop_time=3.1, intervals=31)
    at = np.arange(16) * 0.2
    u = (at > 0.13) & ((at - 0.13) % 0.5 < 0.25)
    outputs = dlsim((*SYSTEM, 0.2), u.astype(float))[1]
    np.testing.assert_allclose(result["system.y"][::2], outputs, rtol=1e-12)


def test_edges_are_seen_by_conditions_alone():
    result = ac.simulate(Discrete(), stop_time=3.1)
    assert result["count"][-1] == 6
    assert not np.any(result["edge.y"])


def test_a_state_space_without_feedthrough_is_late():
    A, B, C, _ = SYSTEM

    class Late(Model):
        system = blocks.DiscreteStateSpace(A=A, B=B, C=C, x_start=(1, 2), sample_period=0.1, u=(1,))

    result = ac.simulate(Late(), stop_time=0.25, intervals=5)
    np.testing.assert_allclose(result["system.y"][0], C @ [1, 2])
    np.testing.assert_allclose(result["system.y"][-1], C @ (A @ (A @ [1, 2] + B[:, 0]) + B[:, 0]))


def test_matrices_that_do_not_fit():
    class Wrong(Model):
        system = blocks.DiscreteStateSpace(A=[[1]], B=[[1], [2]], C=[[1]], u=(1,))

    with pytest.raises(ac.DeclarationError, match=r"matrix B .* has shape \(2, 1\); it must have \(1, 1\)"):
        ac.compile(Wrong())


@pytest.mark.parametrize("start", [0.0, 10.05, 10.1])
def test_samples_are_on_the_grid_of_their_start_time(start):
    class Held(Model):
        hold = blocks.ZeroOrderHold(sample_period=0.2, start_time=0.1, u=now)

    result = ac.simulate(Held(), start_time=start, stop_time=start + 1)
    grid = 0.1 + 0.2 * np.arange(60)
    inside = grid[(grid > start - 1e-9) & (grid < start + 1 - 1e-9)]
    np.testing.assert_allclose(np.setdiff1d(result["hold.y"], [0, start + 1]), inside)
