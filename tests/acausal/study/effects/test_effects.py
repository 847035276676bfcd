"""effects(): changes that closed forms tell, effects that are not called for, interactions, failures, tables."""

from __future__ import annotations

import csv

import numpy as np
import pytest

import acausal as ac
from acausal import DeclarationError, Model, SimulationError
from models import SliderCrank
from tests.acausal.study.effects_demo import Counting, Fragile, Ramp

K, SLOPE = 0.015, 2.03


@pytest.fixture(scope="module")
def found() -> ac.Effects:
    return ac.effects(Ramp(), stop_time=1.0, repeats=1, executor=Counting())


def by_name(found: ac.Effects) -> dict:
    return {row.name: row for row in found.rows}


def test_changes_are_those_of_closed_forms(found):
    rows = by_name(found)
    assert set(rows) == {"small=False", "other=False", "share=half", "share=none"}
    for name, change in (("small=False", K), ("other=False", K), ("share=half", 0.5), ("share=none", 1.0)):
        assert rows[name].largest["x"] == pytest.approx(change / SLOPE, rel=1e-6)
        assert rows[name].rms["x"] == pytest.approx(change / SLOPE * np.sqrt(np.mean(np.linspace(0, 1, 401) ** 2)))
    assert rows["small=False"].largest["y"] == pytest.approx(0.05 / 1.05, rel=1e-6)
    assert rows["share=none"].largest["y"] == pytest.approx(0, abs=1e-9)


def test_an_interrupted_study_continues(found, tmp_path):
    journal, ran = tmp_path / "j", list[int]()

    def stop(done, total, what):
        if done == 3:
            raise KeyboardInterrupt

    def again(progress):
        return ac.effects(Ramp(), stop_time=1.0, repeats=1, executor=Counting(), journal=journal, progress=progress)

    with pytest.raises(KeyboardInterrupt):
        again(stop)
    assert len(journal.read_text().splitlines()) == 4  # the first one tells what the runs have in common
    continued = again(lambda done, total, what: ran.append(done))
    assert ran[0] == 2  # both references, without a run
    assert not journal.exists()
    assert [row.largest for row in continued.rows] == [row.largest for row in found.rows]


def test_the_largest_change_comes_first(found):
    changes = [row.change() for row in found.rows]
    assert changes == sorted(changes, reverse=True)
    assert found.rows[0].name == "share=none"


def test_costs_are_relative_to_the_fullest_scene(found):
    full = ac.compile(Ramp(share="full")).report
    half = ac.compile(Ramp(share="full", small=False)).report
    row = by_name(found)["small=False"]
    assert found.reference.operations == full["operations"]
    assert row.operations == half["operations"] < full["operations"]
    assert row.work == row.time == half["operations"] / full["operations"]
    assert row.equations_less == full["equations_reduced"] - half["equations_reduced"]


def test_the_scene_as_it_stands_is_a_row(found):
    assert found.standing.choices == {"share": "half"}
    assert found.standing.largest["x"] == pytest.approx(0.5 / SLOPE, rel=1e-6)


def test_an_effect_without_equations_is_not_called_for(found):
    assert found.idle == ({"silent": False},)
    assert "changes no equation: silent." in found.table()


def test_an_effect_of_an_output_alone_is_called_for():
    class Shown(Model):
        doubled: bool = ac.effect("whether the output is doubled")
        x: ac.Scalar = ac.output("position")
        s: ac.Scalar = ac.variable("integral", fixed=True)

        def equations(self):
            yield ac.der(self.s) == 1
            yield self.x == (2 * self.s if self.doubled else self.s + 0)

    rows = ac.effects(Shown(), stop_time=1.0, repeats=1, executor=Counting()).rows
    assert [row.name for row in rows] == ["doubled=False"]
    assert rows[0].change() == pytest.approx(0.5)


def test_interaction(found):
    """Without either small effect y loses 0.05, without both no more: the sum of both changes is 0.05 too much."""
    pairs = {frozenset({**i.first, **i.second}): i for i in found.interactions}
    both = pairs[frozenset({"small", "other"})]
    assert both.size["y"] == pytest.approx(0.05 / 1.05, rel=1e-6)
    assert both.size["x"] == pytest.approx(0, abs=1e-8)
    lone = pairs[frozenset({"small", "share"})]
    assert max(lone.size.values()) < 1e-8
    assert "small=False, other=False" in found.table()


def test_pairs_are_limited():
    few = ac.effects(Ramp(), stop_time=1.0, repeats=1, executor=Counting(), pairs=1)
    assert len(few.interactions) == 1
    assert few.untried == 2
    assert "2 further pairs" in few.table()


def test_of_two_effects_that_may_go_alone_one_stays():
    """Each changes x by 0.74 %, both together by 1.5 %."""
    found = ac.effects(Ramp(), stop_time=1.0, outputs=["x"], repeats=1, executor=Counting())
    best = found.cheapest["all outputs"]
    assert len(best.choices) == 1
    assert best.choices.items() <= {"small": False, "other": False}.items()
    assert best.change() == pytest.approx(K / SLOPE, rel=1e-6)
    wide = ac.effects(Ramp(), stop_time=1.0, outputs=["x"], accuracy=2e-2, repeats=1, executor=Counting())
    assert wide.cheapest["all outputs"].choices == {"small": False, "other": False}
    assert wide.switched() == {"small": False, "other": False, "share": "full"}


def test_each_output_has_its_own_cheapest_set(found):
    assert found.cheapest["all outputs"].choices == {}
    assert len(found.cheapest["x"].choices) == 1
    assert found.cheapest["y"].choices == {"share": "none"}
    assert found.choices["y"] == {"small": True, "other": True, "share": "none"}


def test_outputs_are_chosen_by_patterns():
    assert ac.effects(Ramp(), stop_time=1.0, outputs=["s", "?"], repeats=1, executor=Counting()).outputs == (
        "s",
        "k",
        "x",
        "y",
        "p",
    )


def test_parameters_hold_in_all_trials():
    found = ac.effects(Ramp(), stop_time=1.0, parameters={"k": 0.1}, repeats=1, executor=Counting())
    assert by_name(found)["small=False"].largest["x"] == pytest.approx(0.1 / 2.2, rel=1e-6)


def test_a_fullest_scene_that_cannot_be_compiled_gives_way_to_the_scene_as_it_stands():
    found = ac.effects(Fragile(), stop_time=1.0, repeats=1, executor=Counting())
    assert "not there yet" in found.refused
    assert found.standing.choices == {}
    rows = by_name(found)
    assert "not there yet" in rows["kind=fullest"].error
    assert rows["bounded=False"].error
    assert rows["kind=plain"].change() == pytest.approx(0, abs=1e-8)
    assert found.rows[0].name == "kind=plain"
    table = found.table()
    assert "next to the scene as it stands" in table
    assert "kind=fullest failed: " in table
    assert found.cheapest["all outputs"].choices == {"kind": "plain"}


def test_neither_scene_can_be_simulated():
    with pytest.raises(SimulationError, match="neither the fullest scene nor the scene as it stands"):
        ac.effects(
            Fragile(bounded=False),
            stop_time=1.0,
            parameters={"kind": "plain"},
            repeats=1,
            executor=Counting(),
            limit=1e-9,
        )


def test_wrong_input():
    class Plain(Model):
        x: ac.Scalar = ac.output("position")

        def equations(self):
            yield self.x == ac.time

    class Silent(Model):
        bend: bool = ac.effect("bending")
        s: ac.Scalar = ac.variable("integral", fixed=True)

        def equations(self):
            yield ac.der(self.s) == 1

    with pytest.raises(DeclarationError, match=r"Plain has no effects"):
        ac.effects(Plain(), stop_time=1.0)
    with pytest.raises(DeclarationError, match=r"Silent has no outputs to compare.*outputs=\['s'\]"):
        ac.effects(Silent(), stop_time=1.0)
    with pytest.raises(DeclarationError, match=r"accuracy is 2; it must lie between 0 and 1"):
        ac.effects(Ramp(), stop_time=1.0, accuracy=2)
    with pytest.raises(DeclarationError, match=r"there is no `smal` in the model; did you mean `small`"):
        ac.effects(Ramp(), stop_time=1.0, parameters={"smal": False})
    with pytest.raises(DeclarationError, match=r"repeats is 0; it must be a whole number of at least 1"):
        ac.effects(Ramp(), stop_time=1.0, repeats=0)
    with pytest.raises(DeclarationError, match=r"stop_time is 0; it must be a number of seconds greater than 0"):
        ac.effects(Ramp(), stop_time=0)


def test_tables(found, tmp_path):
    assert max(map(len, found.table().splitlines())) <= 100
    found.to_csv(tmp_path / "e.csv")
    rows = list(csv.DictReader((tmp_path / "e.csv").open()))
    assert rows[0]["kind"] == "reference"
    effect = next(row for row in rows if row["choices"] == "small=False" and row["kind"] == "effect")
    assert float(effect["x largest"]) == by_name(found)["small=False"].largest["x"]
    assert float(effect["x rms"]) == by_name(found)["small=False"].rms["x"]
    found.to_markdown(tmp_path / "e.md")
    lines = (tmp_path / "e.md").read_text().splitlines()
    table = [line for line in lines if line.startswith("|")]
    assert len({line.count("|") for line in table[:8]}) == 1
    assert any(line.startswith("| small=False |") for line in table)


@pytest.mark.slow
def test_slider_crank():
    """The elastic crank is not worth its price; the rod's deflection needs its second-order stiffness."""
    found = ac.effects(SliderCrank(), stop_time=1.6, outputs=["slider_position", "rod_mid_deflection"], pairs=0)
    rows = by_name(found)
    assert rows["crank=rigid"].largest["slider_position"] < 2e-3
    assert rows["rod_bar.geometric_stiffness=False"].largest["rod_mid_deflection"] > 2e-2
    assert found.cheapest["slider_position"].choices["crank"] == "rigid"
    assert "rod_bar.geometric_stiffness" not in found.cheapest["rod_mid_deflection"].choices
    assert found.cheapest["slider_position"].time < 0.5
