"""Every class of Modelica's mechanics has a twin, or a reason why not."""

import pytest

from tests.reference.msl import twins
from tests.reference.msl.classes import classes_of


@pytest.mark.parametrize("name", twins.classes())
def test_every_class_has_a_twin_or_a_reason(name):
    ours = twins.twin(name)
    assert twins.exists(ours) if ours else twins.reason(name)


def test_what_is_listed_is_a_class_or_a_package():
    known = twins.classes()
    assert set(twins.NAMES) <= set(known)
    assert not [place for place in twins.REASONS if not any(f"{name}.".startswith(f"{place}.") for name in known)]


def test_the_page_is_up_to_date():
    """Otherwise run `python -m tests.reference.msl.twins`."""
    assert twins.PAGE.read_text() == "\n".join(twins.page()) + "\n"


def test_classes_are_read_from_packages_and_not_from_models_or_texts():
    text = """within A; package P "a model Text; end P;" // model Comment
      partial model M replaceable function f = g; model Inner end Inner; end M;
      package Q function h end h; connector C = D; end Q; end P;"""
    assert list(classes_of(text)) == [
        ("package", "P"),
        ("model", "P.M"),
        ("package", "P.Q"),
        ("function", "P.Q.h"),
        ("connector", "P.Q.C"),
    ]
