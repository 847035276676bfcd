"""Arguments of set_valued(), and the method that yields it."""

from __future__ import annotations

import re

import pytest

import acausal as ac
from acausal import DeclarationError, Model, Scalar, der, discrete, set_valued, variable


class Held(Model):
    v: Scalar = variable("speed", unit="m/s", start=1, fixed=True)
    mode: Scalar = discrete("sense")
    offset: Scalar = discrete("offset", unit="m/s")
    shared: Scalar = discrete("shared")
    share: Scalar = discrete("share")
    slip: Scalar = discrete("slip", unit="m/s")

    def law(self, **other):
        names = ("mode", "offset", "shared", "share", "slip")
        return set_valued(self.v, limit=1.0, **{name: getattr(self, name) for name in names} | other)

    def equations(self):
        yield der(self.v) == -self.mode - self.share


def test_discrete_variables_are_needed():
    class State(Held):
        def equations(self):
            yield from super().equations()
            yield self.law(share=self.v)

    class Number(Held):
        def equations(self):
            yield from super().equations()
            yield self.law(mode=0)

    with pytest.raises(
        DeclarationError, match=r"set_valued needs discrete variables, but `v` is not discrete(.|\n)*discrete\("
    ):
        ac.compile(State())
    with pytest.raises(
        DeclarationError, match=re.escape("set_valued needs a scalar discrete variable as `mode`, not 0.")
    ):
        ac.compile(Number())


def test_it_belongs_to_equations():
    class Elsewhere(Held):
        def initial_equations(self):
            yield self.law()

    with pytest.raises(DeclarationError, match=r"yields set_valued\(...\), which belongs to equations\(\)"):
        ac.compile(Elsewhere())
