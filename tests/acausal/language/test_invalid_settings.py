"""Assignments to fields of instances and built models raise errors with the remedy."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import (
    DeclarationError,
)
from components import Body, World
from tests.acausal.language.test_settings import Swing


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (lambda s: setattr(s, "load", 2), r"`Swing\(load=2\)`.*parameters=\{'load': 2\}"),
        (lambda s: setattr(s, "tip", Body(m=2)), r"`Swing\(tip=Body\(m=2\)\)`"),
        (lambda s: setattr(s, "damper", None), r"`Swing\(damper=None\)`"),
        (lambda s: setattr(s, "height", 2), r"`Swing\(height=fixed\(2\)\)`"),
        (lambda s: setattr(s.tip, "m", 2), r"parameters=\{'tip.m': 2\}.*`tip = Body\(m=2\)`"),
        (lambda s: setattr(s.tip, "mass", 2), "Body has no field `mass`; did you mean `m`"),
        (lambda s: setattr(s.hinge, "phi", 0.3), r"`hinge = Revolute\(phi=fixed\(0.3\)\)`"),
        (lambda s: s.tip.r_CM.__setitem__(0, 2), "give the whole array"),
        (lambda s: setattr(s, "laod", 2), "did you mean `load`"),
        (lambda s: setattr(s, "second", Body(m=2)), r"class body, `second = Body\(m=2\)`"),
        (lambda s: setattr(s, "others", [Body(m=2)]), "class body"),
    ],
)
def test_setting_on_an_instance_is_refused_with_the_remedy(change, text):
    with pytest.raises(DeclarationError, match=text):
        change(Swing())


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (lambda t: setattr(t, "load", 5), r"ac.simulate\(compiled, ..., parameters=\{'load': 5\}\)"),
        (lambda t: setattr(t.bar, "r", (2, 0, 0)), r"`bar.r` cannot be set on a built model.*parameters=\{'bar.r'"),
        (
            lambda t: setattr(t.hinge, "use_axis_flange", False),
            r"ac.compile\(model, parameters=\{'hinge.use_axis_flange'",
        ),
        (lambda t: setattr(t, "tip", None), "Set parts in the class body"),
        (lambda t: setattr(t.hinge, "phi", 1), "Set its start value where the part"),
    ],
)
def test_setting_on_a_built_tree_is_refused_with_the_remedy(change, text):
    with pytest.raises(DeclarationError, match=text):
        change(ac.compile(Swing()).tree)


@pytest.mark.parametrize(
    ("name", "new", "text"),
    [
        ("load", 3, r"class MySwing\(Swing\): load = 3.*Swing\(load=3\)"),
        ("tip", Body(m=2), r"class MySwing\(Swing\): tip = Body\(m=2\)"),
        ("second", Body(m=2), "write it in the class body"),
        ("several", [Body(m=2)], "write it in the class body"),
    ],
)
def test_setting_on_a_class_is_refused_with_the_remedy(monkeypatch, name, new, text):
    derived = type("Derived", (Swing,), {})
    monkeypatch.setattr(Swing, name, new, raising=False)
    for model in (Swing(), derived()):
        with pytest.raises(DeclarationError, match=text):
            ac.compile(model)


class OwnConstructor(Swing):
    """A constructor of its own may keep plain values."""

    def __init__(self, times, **values):
        super().__init__(load=times * 2.0, **values)
        self.times = times

    def equations(self):
        yield self.height == self.times * self.tip.r_0[1]


def test_a_constructor_of_the_users_own():
    model = OwnConstructor(3)
    result = ac.simulate(model, stop_time=1)
    assert (result["load"][-1], result["height"][-1]) == pytest.approx((6, 3 * result["tip.r_0"][-1, 1]))
    assert model._origin.startswith(__file__)


@pytest.mark.parametrize(
    ("name", "new", "text"),
    [
        ("tip", Body(m=3), r"super\(\).__init__\(tip=Body\(m=3\)\)"),
        ("extra", Body(m=3), "@part"),
        ("load", 3, r"load=3"),
    ],
)
def test_parts_and_values_set_in_a_constructor_are_refused_with_the_remedy(name, new, text):
    class Set(Swing):
        def __init__(self):
            super().__init__()
            setattr(self, name, new)

    with pytest.raises(DeclarationError, match=text):
        Set()


def test_what_is_found_or_computed_takes_no_value():
    with pytest.raises(DeclarationError, match="found automatically"):
        Body(m=1, world=World())
