"""Fixed steps of a rule that is written once."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.policy import POLICY


def decay(x: Any, u: Any) -> tuple[Any, Any]:
    return 0.5 * x + u, 2 * x


@pytest.mark.parametrize("steps", [0, 1, 255, 256, 257, 600])
def test_steps_of_any_number(steps):
    """Blocks do not show."""
    given = np.random.default_rng(0).standard_normal((steps, 2))
    found = ac.march(decay, (1.0, -3.0), given)
    x = [np.array((1.0, -3.0))]
    for u in given:
        x.append(0.5 * x[-1] + u)
    np.testing.assert_array_equal(found.states, x)
    np.testing.assert_array_equal(found.outputs, 2 * np.reshape(x[:-1], (-1, 2)))
    assert not found.diverged


def test_no_inputs_and_no_outputs():
    found = ac.march(lambda x, u: (2 * x, ()), [1.0], np.zeros((10, 0)))
    assert found.states[-1, 0] == 1024
    assert found.outputs.shape == (10, 0)


def test_ends_where_a_state_leaves_its_bounds():
    found = ac.march(lambda x, u: (2 * x, x), [1.0], np.zeros((2000, 0)), bounds=1e3)
    assert found.diverged
    assert found.states.ravel().tolist() == [2.0**k for k in range(10)]
    assert len(found.outputs) == 9


def test_no_number_ends_it():
    found = ac.march(lambda x, u: (ac.as_expr([ac.sqrt(x[0] - 1)]), x), [3.0], np.zeros((50, 0)))
    assert found.diverged
    assert len(found.states) == 3
    assert np.isfinite(found.states).all()


def test_progress_and_interrupt():
    told: list[tuple[float, int]] = []

    def stop(part: float, steps: int) -> None:
        told.append((part, steps))
        if len(told) == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt) as caught:
        ac.march(decay, (1.0, 1.0), np.zeros((1000, 2)), progress=stop)
    block = POLICY.calls.steps_of_a_block
    assert told == [(block / 1000, block), (2 * block / 1000, 2 * block)]
    reached: Any = caught.value
    assert len(reached.result.states) == 2 * block + 1


@pytest.mark.parametrize(
    ("step", "words"),
    [
        (lambda x, u: (x[:1], x), r"shape \(2,\), and a vector"),
        (lambda x, u: (x, x[0]), "a vector of other values"),
        (lambda x, u: (x * ac.time, x), "state and its inputs alone"),
    ],
)
def test_refused(step, words):
    with pytest.raises(ac.DeclarationError, match=words):
        ac.march(step, (1.0, 1.0), np.zeros((3, 1)))


def test_refused_shapes():
    with pytest.raises(ac.DeclarationError, match="a row of inputs for each step"):
        ac.march(decay, (1.0, 1.0), np.zeros(3))


def test_a_compiled_step_goes_on_as_a_march_does():
    """Taken a few at a time, in any numbers, what was found before stays as it is."""
    given = np.random.default_rng(1).standard_normal((40, 2))
    expected = ac.march(decay, (1.0, -3.0), given)
    step = ac.CompiledStep(decay, 2, 2)
    state, found, done = np.array((1.0, -3.0)), [], 0
    for count in (1, 3, 0, 16, 3, 17):
        states, outputs = step(state, given[done : done + count])
        assert states.shape == outputs.shape == (count, 2)
        found.append((states, outputs))
        state, done = (states[-1] if count else state), done + count
    np.testing.assert_array_equal(np.vstack([states for states, _ in found]), expected.states[1:])
    np.testing.assert_array_equal(np.vstack([outputs for _, outputs in found]), expected.outputs)
    assert step.operations == expected.operations
    assert step.outputs == 2


def test_a_compiled_step_refuses_other_shapes():
    step = ac.CompiledStep(decay, 2, 2)
    for start, inputs in (((1.0,), np.zeros((3, 2))), ((1.0, 1.0), np.zeros((3, 1))), ((1.0, 1.0), np.zeros(2))):
        with pytest.raises(ac.DeclarationError, match="a step of 2 states has 2 inputs in a row"):
            step(start, inputs)
    with pytest.raises(ac.DeclarationError, match="state and its inputs alone"):
        ac.CompiledStep(lambda x, u: (x * ac.time, x), 1, 1)
