"""Suggestions for misspelt parameters and arguments."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    chain,
    fixed,
    parameter,
)
from components import Body, FixedTranslation, Revolute, Spherical, World, rotational


class Held(Model):
    world = World()
    ball = Spherical()
    tip = Body(m=1, r_CM=(1, 0, 0))

    def connections(self):
        yield chain(self.world, self.ball, self.tip)


class Hung(Held):
    ball = Revolute(phi=fixed(0), w=fixed(0))
    tip = Body(m=1)


class Two(Held):
    """Two masses that are not in line with the ball have an inertia, but a mass and an inertia are missing."""

    arm = FixedTranslation(r=(0, 1, 0))
    wrist = Spherical()
    end = Body(m=0)

    def connections(self):
        yield chain(self.world, self.ball, self.arm, self.wrist, self.end)
        yield chain(self.arm, self.tip)


class Shaft(Model):
    size: Scalar = parameter("inertia of the wheel", unit="kg.m2", default=0)
    wheel = rotational.Inertia(J=size, phi=fixed(0), w=fixed(0))


@pytest.mark.parametrize(
    ("cls", "given", "mend"),
    [
        (Held, {}, r"Give this:\n  tip .*: Body\(I=\.\.\.\), inertia tensor about the centre of mass\n"),
        (Hung, {}, r"Give one of these:\n.*  tip .*: Body\(r_CM=.*\n  tip .*: Body\(I="),
        (Two, {}, r"Give these:\n.*  end .*: Body\(m=.*\n  end .*: Body\(I="),
        (Shaft, {}, r"Give this:\n  Shaft\(size=\.\.\.\), inertia of the wheel"),
        (Held, {"tip.m": 2.0}, r"Give this:\n  tip .*: Body\(I="),
    ],
)
def test_the_parameter_that_is_missing_is_named(cls, given, mend):
    with pytest.raises(
        ac.UnbalancedModelError, match=f"(?s)^the model lacks .*\\n.* parameter is 0, .*{mend}"
    ) as caught:
        ac.compile(cls(), given)
    assert caught.value.__cause__ is None


def test_parameters_that_are_0_for_other_reasons_are_not():
    class Loose(Model):
        spring = rotational.Spring(c=1)

    with pytest.raises(ac.UnbalancedModelError) as caught:
        ac.compile(Loose())
    assert "parameter is 0" not in str(caught.value)


@pytest.mark.parametrize(
    ("statement", "text"),
    [
        (lambda s: chain(s.hinge.support, s.damper), "argument 1 is None. An optional port is None"),
        (lambda s: chain(s.damper, s.hinge.axis), "argument 2 is None"),
        (lambda s: chain(s.damper, s.left_out, s.damper), "argument 2 is None.*if self.part is not None"),
        (lambda s: chain(s.damper, 3), "argument 2, 3, is neither"),
        (lambda s: chain(s.tip, s.damper), r"tip \(Body\) has no second end"),
    ],
)
def test_chain_tells_the_argument_and_the_line_of_the_call(statement, text):
    class Damped(Hung):
        damper = rotational.Damper(d=1)
        hinge = Revolute()
        left_out = None

        def connections(self):
            yield from super().connections()
            yield from self.further()

        def further(self):
            yield statement(self)

    line = statement.__code__.co_firstlineno
    with pytest.raises(ac.ConnectError, match=rf"Damped, {__file__}:{line}: .*{text}"):
        ac.compile(Damped())
