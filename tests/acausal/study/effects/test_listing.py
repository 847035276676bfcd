"""Which effects a scene has, what its fullest scene is, and which settings fit together."""

from __future__ import annotations

import numpy as np

from acausal import Model, chain, fixed
from acausal.study.effects.listing import effects_of, fitting, fullest
from components import BodyRod, Revolute, SubstructuredBeam, World
from models import SliderCrank
from tests.acausal.study.effects_demo import Ramp, Tree


class Arm(Model):
    world = World()
    hinge = Revolute(phi=fixed(0), w=fixed(0))
    bar = BodyRod(r=(1, 0, 0), m=1)
    beam = SubstructuredBeam(length=1, E=1e9, rho=1e3, A=1e-4, J=1e-9, volumes=2)

    def connections(self):
        yield chain(self.world, self.hinge, self.bar, self.beam)


def test_effects_with_their_choices():
    found = {effect.path: effect for effect in effects_of(Ramp(small=False))}
    assert list(found) == ["small", "other", "share", "silent"]
    assert (found["small"].value, found["small"].choices) == (False, (True, False))
    assert (found["share"].value, found["share"].tries) == ("half", ("full", "half", "none"))
    assert found["share"].description == "a large slope"


def test_an_effect_that_the_owner_passes_on_is_listed_once():
    paths = [effect.path for effect in effects_of(Arm())]
    assert len(paths) == len(set(paths))
    assert "bar.gyroscopic" in paths
    assert "beam.axial" in paths
    assert not [path for path in paths if path.startswith(("bar.body", "beam.volume"))]


def test_an_effect_of_the_part_alone_is_listed():
    paths = [effect.path for effect in effects_of(Tree(), {"kind": "branch"})]
    assert paths == ["kind", "limited", "it.shared", "it.leaf.own"]


def test_fullest_scene_finds_effects_of_parts_that_only_exist_then():
    found, choices = fullest(Tree(), {})
    assert choices == {"kind": "branch", "limited": "some", "it.shared": True, "it.leaf.own": True}
    assert {effect.path: effect.value for effect in found}["kind"] == "leaf"


def test_an_effect_with_few_tries_is_not_made_fuller():
    found = {effect.path: effect.tries for effect in effects_of(Tree())}
    assert found["limited"] == ("some", None)
    assert {e.path: e.tries for e in effects_of(Arm())}["world.gravity"] == ("uniform", None)
    assert {e.path: e.tries for e in effects_of(Arm(), {"world.gravity": None})}["world.gravity"] == (None,)


def test_slider_crank_lists_the_beam_of_a_crank_that_stands_rigid():
    standing = [effect.path for effect in effects_of(SliderCrank(crank="rigid"))]
    assert "crank_bar.axial" not in standing
    found, choices = fullest(SliderCrank(crank="rigid"), {})
    assert choices["crank"] == "elastic"
    assert choices["crank_bar.axial"] == "dynamic"
    assert {effect.path: effect.value for effect in found}["crank"] == "rigid"


def test_settings_of_parts_that_do_not_exist_are_left_out():
    settings = {"crank_bar.axial": "none", "crank": "rigid", "rod_bar.volume[0].E": 3e7, "rod_bar.E": 4e7}
    kept = fitting(SliderCrank(), settings)
    assert kept == {name: value for name, value in settings.items() if name != "crank_bar.axial"}
    assert fitting(SliderCrank(), {**settings, "rod": "rigid"}) == {"crank": "rigid", "rod": "rigid"}


def test_settings_of_the_model_itself_all_stay():
    assert np.array_equal(list(fitting(Ramp(), {"none": 1})), ["none"])
