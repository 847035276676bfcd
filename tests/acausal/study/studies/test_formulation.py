"""Formulations: declared by the model or told by its fields, and what the user fixes in them."""

import pytest

from acausal import Component, Model, part, parts, structural
from acausal.errors import DeclarationError
from acausal.flatten.instantiate import Instantiation
from acausal.study import Formulation, formulations_of, with_and_without
from models import SCENES
from tests.acausal.study.decay import Decay


class Rod(Component):
    n: int = structural("elements", default=3, minimum=1, refine=lambda s: False)


class Chain(Component):
    volumes: int = structural("volumes", default=2, minimum=1, refine=lambda s: False)

    @parts
    def rods(self):
        """Have numbers of elements themselves."""
        return [Rod() for _ in range(self.volumes)]


class Two(Model):
    formulation: str = structural("kind", default="one", choices=("one", "chain", "none"))
    arm = Rod(n=5)

    @part
    def rod(self):
        """Depends on the formulation."""
        return {"one": Rod(), "chain": Chain(), "none": None}[self.formulation]


def test_derived_from_the_fields():
    assert [(f.name, f.refine) for f in formulations_of(Two(), {})] == [
        ("one", {"arm.n": (5, 10, 20), "rod.n": (3, 6, 12)}),
        ("chain", {"arm.n": (5, 10, 20), "rod.volumes": (2, 4, 8)}),
        ("none", {"arm.n": (5, 10, 20)}),
    ]
    (only,) = formulations_of(Two(), {"formulation": "one", "arm.n": 7})
    assert only.refine == {"rod.n": (3, 6, 12)}
    assert [f.name for f in formulations_of(Rod(), {})] == ["as given"]


def test_declared_ones_that_fit():
    assert [f.name for f in formulations_of(Decay(), {})] == ["square", "fourth", "off", "unstable"]
    (only,) = formulations_of(Decay(), {"kind": "fourth", "n": 3})
    assert (only.name, only.refine) == ("fourth", {})


def test_sizes_advance_together_and_double_beyond():
    form = Formulation("a", {"k": 1}, {"n": (2, 3), "m": (4, 9)})
    assert form.at(1) == ({"k": 1, "n": 3, "m": 9}, "3 + 9")
    assert form.at(3) == ({"k": 1, "n": 12, "m": 36}, "12 + 36")
    assert Formulation("a").at(0) == ({}, "")
    with pytest.raises(DeclarationError, match="sizes advance together"):
        Formulation("a", {}, {"n": (2, 3), "m": (4,)})


def test_with_and_without():
    found = with_and_without(Formulation("a", {"k": 1}), Formulation("b", exact=True), stiff="beam.stiff")
    assert [f.name for f in found] == ["a", "a, stiff", "b", "b, stiff"]
    assert [f.settings["beam.stiff"] for f in found] == [False, True, False, True]
    assert [f.exact for f in found] == [False, False, True, True]


@pytest.mark.parametrize("scene", ["spin-up", "pendulum", "free-vibration", "slider-crank"])
def test_scenes_can_be_built_in_every_formulation(scene):
    model = SCENES[scene]()
    found = formulations_of(model, {})
    assert sum(form.exact for form in found) >= 2
    for form in found:
        for step in range(form.steps + 1):
            Instantiation(model, form.at(step)[0])
