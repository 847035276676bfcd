"""What a notebook shows of a component that is not built: code, parts and parameters, and names to complete."""

from html import unescape

import pytest

import acausal as ac
import components
import models
from acausal.cli.scenes import scenes
from acausal.language import fields as f
from acausal.language.component_html import SHOWN, component_html
from components import FlexibleBeam, Revolute

CLASSES = {entry.name: entry.cls for entry in components.table()} | scenes()


@pytest.mark.parametrize("name", CLASSES)
def test_every_class_has_a_short_text(name: str) -> None:
    cls = CLASSES[name]
    text = component_html(cls, {})
    assert text.startswith(f"<p><b>{cls.__name__}</b>")
    assert text.count("<tr>") <= 2 * (SHOWN + 2)
    assert "<class" not in unescape(text)
    assert text.count("<") == text.count(">")


@pytest.mark.parametrize("name", scenes())
def test_names_of_a_scene_are_completed(name: str) -> None:
    model = scenes()[name]()
    assert set(model.fields) <= set(dir(model))
    for part, field in model.fields.items():
        made = field.make if isinstance(field, f.Part) else None
        if isinstance(made, f.Template):
            assert set(dir(getattr(model, part))) == set(type(made).fields)


def test_given_values_come_first() -> None:
    beam = FlexibleBeam(length=2.0, E=1e9, rho=1e3, A=1e-4, J=1e-9, elements=7)
    assert "<td>elements</td><td>7</td>" in beam._repr_html_()
    assert repr(Revolute(n=(0, 1, 0), phi=ac.fixed(1))) == "Revolute(n=(0, 1, 0), phi=fixed(1))"
    assert len(repr(Revolute(n=(0.123456789, 1.123456789, 0), phi=ac.fixed(1.23456789), w=ac.fixed(2.3456789)))) < 80


def test_parts_of_a_built_model_show_text() -> None:
    tree = ac.compile(models.SimplePendulum()).tree
    assert tree._repr_html_() is None
    assert repr(tree) == "model (SimplePendulum)"
