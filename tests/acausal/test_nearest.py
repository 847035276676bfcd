"""Suggestions for unknown names: misspellings, parts of names, common words."""

import pytest

from acausal.nearest import most_similar, nearest
from components import Body, FlexibleBeam, Revolute, SubstructuredBeam


@pytest.mark.parametrize(
    ("cls", "name", "meant"),
    [
        (SubstructuredBeam, "elements", "elements_per_volume"),
        (SubstructuredBeam, "element", "elements_per_volume"),
        (SubstructuredBeam, "n_elements", "elements_per_volume"),
        (SubstructuredBeam, "number_of_volumes", "volumes"),
        (FlexibleBeam, "element", "elements"),
        (FlexibleBeam, "stiffness", "geometric_stiffness"),
        (FlexibleBeam, "inertia", "rotary_inertia"),
        (Revolute, "use_axis", "use_axis_flange"),
        (Revolute, "flange", "use_axis_flange"),
        (Body, "CM", "r_CM"),
        (Body, "gyroscopc", "gyroscopic"),
    ],
)
def test_a_field(cls, name, meant):
    assert most_similar(name, cls.fields) == meant


def test_a_misspelt_name_comes_before_one_with_a_common_word():
    assert most_similar("inner_diamter", ["outer_inner", "inner_diameter", "diamter_of_all"]) == "inner_diameter"


def test_what_has_nothing_in_common():
    assert most_similar("voltage", ["phi", "w", "a", "tau"]) == ""


def test_a_path_is_looked_for_in_its_part():
    known = ["beam.elements_per_volume", "rod.elements", "beam.volumes"]
    assert nearest("beam.elements", known) == ["beam.elements_per_volume"]
