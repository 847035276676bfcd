"""Owner of an equation if the class of the user is in no file."""

from __future__ import annotations

import pytest

import acausal as ac

SESSION = """
import acausal as ac
from components import rotational

class M(ac.Model):
    wheel = rotational.Inertia(J=1)
    held = rotational.Fixed()

    def connections(self):
        yield ac.connect(self.wheel.flange_a, self.held.flange)

    def equations(self):
        yield self.wheel.phi == 1
"""


def test_the_users_equation_is_named_first_in_a_session():
    space = {"__name__": "a session"}
    exec(compile(SESSION, "<stdin>", "exec"), space)
    with pytest.raises(
        ac.UnbalancedModelError, match=r"(?s)contradicts others.*\n  M, <stdin>:13\nThe others:\n  held"
    ):
        ac.compile(space["M"]())
