"""The table of all parts."""

import subprocess
import sys
from operator import attrgetter

import pytest

import components
from acausal import Connector, Record
from components import table
from tests.components.test_properties import EXPORTED, SCENES, SIGNALS


def entry(name):
    return next(entry for entry in table() if entry.name == name)


def test_every_part_stands_once_and_no_base():
    parts = table()
    assert len(parts) == len({e.cls for e in parts})
    signals = {c for c in SIGNALS.values() if not (issubclass(c, Connector | Record) or c.__doc__.startswith("Base"))}
    assert {e.cls for e in parts} == {EXPORTED[name] for name in SCENES} | signals


def test_entries_tell_where_what_and_how_connected():
    for e in table():
        assert attrgetter(e.name)(components) is e.cls
        assert e.line.endswith(".")
        assert set(e.ports) <= set(e.cls.fields)
    prismatic = entry("Prismatic")
    assert prismatic.line == "Prismatic joint: frame_b slides relative to frame_a along the axis n."
    assert prismatic.domain == "multibody"
    assert prismatic.shown_ports() == "frame_a, frame_b: Frame; axis, support: TranslationalFlange, optional"
    assert entry("rotational.Torque").ports["tau"] == "input in N.m"


@pytest.mark.parametrize(
    ("name", "domain"),
    [
        ("rotational.Damper", "rotational"),
        ("translational.Mass", "translational"),
        ("rotational.IdealGearR2T", "rotational, translational"),
        ("BevelGear1D", "multibody, rotational"),
        ("thermal.Convection", "thermal"),
        ("fe.FEBody", "multibody"),
    ],
)
def test_domains_follow_from_the_ports(name, domain):
    assert entry(name).domain == domain


def test_the_command_prints_the_parts_with_a_word():
    command = [sys.executable, "-m", "components", "rotational"]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert text == f"{table('rotational')!r}\n"
    assert "rotational.Clutch: Friction clutch" in text
    assert "translational.Mass" not in text
    assert "heat_port: HeatPort, optional" in text


def test_notebooks_show_a_table():
    text = table("world")._repr_html_()
    assert text.count("<tr>") == 1 + len(table("world")) > 1
    assert "<td>World</td>" in text
