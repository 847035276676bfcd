"""What the site is generated from: components, scenes, names of the package."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

import acausal as ac
import components
from acausal.language.fields import Parameter

DOCS = Path(__file__).parents[2] / "docs"
sys.path.append(str(DOCS))
from generate import components as pages  # noqa: E402 - the folder of the site is no package
from generate.docstrings import entries, sections  # noqa: E402
from generate.mathml import mathml  # noqa: E402
from generate.used import SCENES  # noqa: E402


# The build of the site makes the pages of all.
@pytest.mark.parametrize(
    "name", ["Revolute", "FlexibleBeam", "contact.PointOnPlane", "rotational.Clutch", "blocks.Sampled"]
)
def test_page_of_a_component(name):
    (entry,) = (one for one in components.table() if one.name == name)
    text = pages.page(entry)
    assert text.startswith(f"# {entry.name.rpartition('.')[2]}\n\n{entry.line}")
    assert "<svg" in text
    for name in (*entry.ports, *(n for n, field in entry.cls.fields.items() if isinstance(field, Parameter))):
        assert f"| `{name}` |" in text
    for formula in re.findall(r"\$\$\n(.*?)\n\$\$", text, re.S):
        found = mathml(formula, "block")
        assert "\\" not in found
        assert found.count("<mtr>") >= formula.count("&=")


def test_every_scene_has_a_page_in_the_gallery():
    found = {path.stem: path.read_text() for path in (DOCS / "gallery").glob("*.md") if path.stem != "index"}
    assert found.keys() == SCENES.keys()
    assert all(f"```{{scene}} {name}\n" in text for name, text in found.items())
    assert re.findall(r"^[\w-]+$", (DOCS / "gallery/index.md").read_text(), re.M) == list(SCENES)


def test_every_public_name_is_in_the_reference():
    text = "".join(path.read_text() for path in (DOCS / "reference").glob("*.md"))
    names = re.findall(r"\.\. auto\w+:: acausal\.(\w+)$", text, re.M)
    assert sorted(names) == sorted(set(ac.__all__) - {"geometry"})
    shapes = re.findall(r"\.\. auto\w+:: acausal\.geometry\.(\w+)$", text, re.M)
    assert {
        name
        for name, kind in vars(ac.geometry).items()
        if isinstance(kind, type) and kind.__module__ == ac.geometry.__name__
    } == {*shapes}


def test_sections_of_docstrings():
    text = "One line.\n\nMore.\n\nParameters\n----------\na : float, in m\n    Length of\n    the bar.\n\nNotes\n-----\nf = m a."
    found = dict(sections(text))
    assert found == {
        "": "One line.\n\nMore.",
        "Parameters": "a : float, in m\n    Length of\n    the bar.",
        "Notes": "f = m a.",
    }
    assert entries(found["Parameters"]) == ("", [("a", "float, in m", "Length of the bar.")])
