"""The greedy search on rows whose changes and costs are made up."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from acausal.study.effects.cheapest import cheapest, search
from acausal.study.effects.effect_rows import EffectRow


def made(
    choices: Mapping[str, Any], change: float, seconds: float, operations: int = 100, steps: int = 10, **more: Any
):
    return EffectRow(
        dict(choices), {"x": change}, {"x": change}, seconds, seconds, operations=operations, steps=steps, **more
    )


FULL = made({}, 0.0, 1.0)


class Scene:
    """Changes add up, costs multiply."""

    def __init__(self, effects: Mapping[str, tuple[float, float]]) -> None:
        self.effects = effects
        self.asked: list[dict[str, Any]] = []

    def row(self, choices: Mapping[str, Any]) -> EffectRow:
        change, seconds = 0.0, 1.0
        for name in choices:
            change, seconds = change + self.effects[name][0], seconds * self.effects[name][1]
        return made(choices, change, seconds)

    def measure(self, wanted: list[Mapping[str, Any]]) -> list[EffectRow]:
        self.asked += [dict(choices) for choices in wanted]
        return [self.row(choices) for choices in wanted]

    def best(self, accuracy: float, standing: EffectRow = FULL, fits: Any = dict) -> EffectRow:
        singles = [self.row({name: False}) for name in self.effects]
        return cheapest({"x": search(singles, FULL, standing, ["x"], accuracy, fits)}, self.measure)["x"]


def test_what_saves_most_goes_first_and_the_rest_as_long_as_the_accuracy_lasts():
    scene = Scene({"a": (0.004, 0.8), "b": (0.007, 0.5), "c": (0.002, 0.7), "d": (0.02, 0.1)})
    assert scene.best(1e-2).choices == {"b": False, "c": False}
    assert scene.asked == [{"b": False, "c": False}, {"a": False, "b": False, "c": False}]


def test_two_that_may_go_alone_may_not_go_together():
    best = Scene({"a": (0.007, 0.8), "b": (0.007, 0.5)}).best(1e-2)
    assert best.choices == {"b": False}


def test_what_saves_no_time_stays():
    assert Scene({"a": (0.0, 1.5)}).best(1e-2).choices == {}


def test_times_within_their_scatter_are_told_apart_by_operations_then_steps():
    slow = made({"a": False}, 0.0, 1.05, operations=90)
    assert slow.cheaper(FULL)
    assert not made({"a": False}, 0.0, 0.95, operations=110).cheaper(FULL)
    assert made({"a": False}, 0.0, 1.0, steps=9).cheaper(FULL)
    assert not FULL.cheaper(FULL)
    assert made({"a": False}, 0.0, 0.5, operations=110).cheaper(FULL)
    assert not made({"a": False}, 0.0, 2.0, operations=10).cheaper(FULL)


def test_small_steps_do_not_add_up_to_a_slower_scene():
    """Each step is 8 % slower than the one before, with fewer operations."""

    def row(choices: Mapping[str, Any]) -> EffectRow:
        return made(choices, 0.0, 1.08 ** len(choices), operations=100 - len(choices))

    def measure(wanted: list[Mapping[str, Any]]) -> list[EffectRow]:
        return [row(choices) for choices in wanted]

    singles = [row({name: False}) for name in "abc"]
    assert len(cheapest({"x": search(singles, FULL, FULL, ["x"], 1e-2, dict)}, measure)["x"].choices) == 1


def test_choices_of_a_part_that_went_are_not_tried():
    def fits(choices: Mapping[str, Any]) -> dict[str, Any]:
        return {k: v for k, v in choices.items() if not (k == "part.a" and "part" in choices)}

    scene = Scene({"part.a": (0.001, 0.3), "part": (0.002, 0.5)})
    assert scene.best(1e-2, fits=fits).choices == {"part.a": False}
    assert scene.asked == []  # with the part gone the other choice is what was measured alone


def test_the_scene_as_it_stands_may_be_the_cheapest():
    standing = made({"a": False, "b": False}, 0.009, 0.2)
    scene = Scene({"a": (0.009, 0.9), "b": (0.009, 0.8)})
    assert scene.best(1e-2, standing).choices == standing.choices
    assert scene.best(1e-3, standing).choices == {}


def test_a_failed_trial_is_no_candidate():
    failed = EffectRow({"a": False}, error="it diverged")
    assert cheapest({"x": search([failed], FULL, failed, ["x"], 1e-2, dict)}, lambda wanted: [])["x"] is FULL


def test_searches_go_side_by_side():
    scene = Scene({"a": (0.004, 0.8), "b": (0.007, 0.5)})
    singles = [scene.row({name: False}) for name in scene.effects]
    rounds: list[int] = []

    def measure(wanted: list[Mapping[str, Any]]) -> list[EffectRow]:
        rounds.append(len(wanted))
        return scene.measure(wanted)

    found = cheapest(
        {name: search(singles, FULL, FULL, ["x"], accuracy, dict) for name, accuracy in (("a", 1e-2), ("b", 2e-2))},
        measure,
    )
    assert [len(row.choices) for row in found.values()] == [1, 2]
    assert rounds == [2, 0]
