"""Files and arguments of results and studies that are wrong: journals, references, choices, pictures, tables."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import acausal as ac
from acausal import Model, Scalar, der, effect, output, parameter, structural, variable
from acausal.study import effects, formulations_of, study
from acausal.study.effects.choices_file import with_effects
from acausal.study.measuring.journal import Journal
from acausal.study.studies.reference import read


class Decay(Model):
    """Decays."""

    drag: bool = effect("friction", default=True)
    rate: Scalar = parameter("of friction", default=1)
    order: int = structural("order", default=2)
    v: Any = variable("both", shape=(2,))
    x: Scalar = variable("position", start=1, fixed=True)
    w: Scalar = variable("der(x)")
    y: Scalar = output("what is seen")

    def equations(self):
        yield der(self.x) == (-self.rate * self.x if self.drag else 0)
        yield self.w == der(self.x)
        yield self.y == self.x
        yield self.v == (self.x, 2 * self.x)


class Serial(Executor):
    """Runs in this process, at once."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        return future


@contextmanager
def inside(files: Mapping[str, str | bytes] | None = None) -> Iterator[None]:
    """Work in a new directory with files in it."""
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)
        try:
            for name, content in (files or {}).items():
                Path(name).write_bytes(content if isinstance(content, bytes) else content.encode())
            yield
        finally:
            os.chdir(before)


@cache
def run() -> ac.Result:
    return ac.simulate(Decay(), stop_time=1, intervals=4)


REFERENCE = "time,y\n0,1\n0.25,0.78\n0.5,0.61\n0.75,0.47\n1,0.37\n"
QUICK: dict[str, Any] = {
    "stop_time": 1.0,
    "intervals": 4,
    "tolerances": [1e-3],
    "methods": ["idas"],
    "repeats": 1,
    "reference": "r.csv",
    "executor": Serial(),
}


def studied(wrong: dict[str, Any], repaired: bool, **right: Any) -> None:
    """A study with an argument that is wrong, or right; without one that is right nothing needs to be run."""
    if repaired and not right:
        return
    with inside({"r.csv": REFERENCE}):
        study(Decay(), **{**QUICK, **(right if repaired else wrong)})


def journal(content: str | bytes, repaired: bool) -> None:
    right = '{"version": "1"}\n'
    with inside({"a.journal": right if repaired else content}):
        Journal("a.journal", {"version": "1"})


def journal_is_a_picture(repaired):
    journal(b"\x89PNG\r\n\x1a\n\xff\xfe", repaired)


def journal_is_a_table(repaired):
    journal("time,x\n0,1\n", repaired)


def journal_is_a_list(repaired):
    journal("[1, 2]\n", repaired)


def journal_is_nested_deeply(repaired):
    journal("[" * 100_000, repaired)


def journal_of_another_study(repaired):
    journal('{"version": "0"}\n', repaired)


def journal_is_a_directory(repaired):
    with inside():
        Path("out").mkdir()
        Journal("out/a.journal" if repaired else "out", {"version": "1"})


def journal_is_a_device(repaired):
    with inside():
        Journal("a.journal" if repaired else "/dev/full", {"version": "1"})


def journal_without_a_name(repaired):
    with inside():
        Journal("a.journal" if repaired else 3, {"version": "1"})  # type: ignore[arg-type]


def journal_links_in_a_circle(repaired):
    with inside():
        if not repaired:
            os.symlink("a.journal", "a.journal")
        Journal("a.journal", {"version": "1"})


def reference(content: str | bytes, repaired: bool) -> None:
    with inside({"r.csv": REFERENCE if repaired else content}):
        read("r.csv", ("y",), np.linspace(0, 1, 5))


def reference_with_text(repaired):
    reference(REFERENCE.replace("0.61", "about 0.6"), repaired)


def reference_with_units_in_times(repaired):
    reference(REFERENCE.replace("0.5,", "0.5 s,"), repaired)


def reference_with_a_gap(repaired):
    reference(REFERENCE.replace("0.61", ""), repaired)


def reference_with_infinity(repaired):
    reference(REFERENCE.replace("0.61", "1e400"), repaired)


def reference_with_ragged_rows(repaired):
    reference(REFERENCE.replace("0.61", "0.61,7"), repaired)


def reference_with_a_cut_row(repaired):
    reference(REFERENCE.replace(",0.37\n", ""), repaired)


def reference_with_decimal_commas(repaired):
    reference(REFERENCE.replace(",", ";").replace(".", ","), repaired)


def reference_without_the_output(repaired):
    reference(REFERENCE.replace("y", "z"), repaired)


def reference_without_a_head(repaired):
    reference(REFERENCE.partition("\n")[2], repaired)


def reference_with_a_column_twice(repaired):
    reference("time,y,y\n0,1,1\n", repaired)


def reference_with_other_times(repaired):
    reference("time,y\n0,1\n1,0.37\n", repaired)


def reference_without_rows(repaired):
    reference("time,y\n", repaired)


def reference_is_empty(repaired):
    reference("", repaired)


def reference_is_a_picture(repaired):
    reference(b"\x89PNG\r\n\x1a\n\xff", repaired)


def reference_is_a_directory(repaired):
    with inside({"r.csv": REFERENCE}):
        read("r.csv" if repaired else ".", ("y",), np.linspace(0, 1, 5))


def reference_is_an_array(repaired):
    with inside({"r.csv": REFERENCE}):
        read("r.csv" if repaired else np.zeros(3), ("y",), np.linspace(0, 1, 5))  # type: ignore[arg-type]


def reference_is_missing(repaired):
    studied({"reference": "no.csv"}, repaired)


def choices(content: str | bytes, repaired: bool) -> None:
    right = json.dumps({"scene": "decay", "effects": {"drag": False}})
    with inside({"e.json": right if repaired else content}):
        with_effects(Decay(), "decay", "e.json", {})


def choices_are_empty(repaired):
    choices("", repaired)


def choices_are_cut(repaired):
    choices('{"scene": "decay", "eff', repaired)


def choices_in_single_quotes(repaired):
    choices("{'scene': 'decay'}", repaired)


def choices_are_a_picture(repaired):
    choices(b"\x89PNG\xff", repaired)


def choices_are_nested_deeply(repaired):
    choices('{"effects":' * 100_000, repaired)


def choices_with_nan(repaired):
    choices('{"scene": "decay", "effects": {"drag": NaN}}', repaired)


def choices_with_a_huge_number(repaired):
    choices('{"scene": "decay", "effects": {"drag": %s}}' % ("9" * 5000), repaired)


def choices_with_a_name_twice(repaired):
    choices('{"scene": "decay", "effects": {"drag": true, "drag": false}}', repaired)


def choices_as_a_list(repaired):
    choices('{"scene": "decay", "effects": ["drag"]}', repaired)


def choices_of_another_kind(repaired):
    choices("[1, 2]", repaired)


def choices_for_another_scene(repaired):
    choices('{"scene": "pendulum", "effects": {}}', repaired)


def choices_of_no_effect(repaired):
    choices('{"scene": "decay", "effects": {"order": 3}}', repaired)


def choices_of_unknown_names(repaired):
    choices('{"scene": "decay", "effects": {"darg": true}}', repaired)


def choices_with_a_wrong_value(repaired):
    choices('{"scene": "decay", "effects": {"drag": "yes"}}', repaired)


def choices_are_a_directory(repaired):
    with inside({"e.json": '{"scene": "decay", "effects": {}}'}):
        with_effects(Decay(), "decay", "e.json" if repaired else ".", {})


def result_by_a_list(repaired):
    [run()[key] for key in ("x", "y")] if repaired else run()[["x", "y"]]  # type: ignore[index]


def result_by_a_number(repaired):
    run()["x"][0] if repaired else run()[0]  # type: ignore[index]


def result_by_a_field(repaired):
    run()["x"] if repaired else run()[Decay.x]


def result_by_an_equation(repaired):
    tree: Any = run().tree
    run()[tree.x - 1] if repaired else run()[tree.x == 1]


def result_by_nothing(repaired):
    run()["x" if repaired else ""]


def result_in_capitals(repaired):
    run()["x" if repaired else "X"]


def result_with_the_model_in_front(repaired):
    run()["x" if repaired else "self.x"]


def result_of_a_derivative(repaired):
    run()["w" if repaired else "der(x)"]


def result_in_round_brackets(repaired):
    run()["v[0]" if repaired else "v(1)"]


def result_of_a_range(repaired):
    run()["v"][:, 0:1] if repaired else run()["v[0:1]"]


def result_beyond_the_end(repaired):
    run()["v[1]" if repaired else "v[2]"]


def result_at_a_huge_index(repaired):
    run()["v[1]" if repaired else "v[" + "9" * 5000 + "]"]


def result_of_a_structural(repaired):
    run().tree.order if repaired else run()["order"]  # type: ignore[union-attr]


def table_with_a_list(repaired):
    with inside():
        run().to_csv("a.csv", "x", "y") if repaired else run().to_csv("a.csv", ["x", "y"])  # type: ignore[arg-type]


def table_with_exchanged_arguments(repaired):
    with inside():
        run().to_csv("a.csv", "x") if repaired else run().to_csv("x", "a.csv")


def table_into_a_directory(repaired):
    with inside():
        Path("out").mkdir()
        run().to_csv("out/a.csv" if repaired else "out")


def table_into_a_circle(repaired):
    with inside():
        if not repaired:
            os.symlink("a.csv", "a.csv")
        run().to_csv("a.csv")


def table_of_an_unknown_user(repaired):
    with inside():
        run().to_csv("a.csv" if repaired else "~nobody_of_this_name/a.csv")


def table_with_a_long_name(repaired):
    with inside():
        run().to_csv("a" * (20 if repaired else 300))


def table_with_a_zero_in_its_name(repaired):
    with inside():
        run().to_csv("a.csv" if repaired else "a\0.csv")


def table_without_a_name(repaired):
    with inside():
        run().to_csv("a.csv" if repaired else None)  # type: ignore[arg-type]


def table_to_a_full_disk(repaired):
    with inside():
        run().to_csv("a.csv" if repaired else "/dev/full")


def table_from_a_directory_that_is_gone(repaired):
    with inside():
        Path("work").mkdir()
        os.chdir("work")
        if not repaired:
            Path("../work").rmdir()
        run().to_csv("a.csv")


def picture_without_an_ending(repaired):
    with inside():
        run().plot("x", path="a.png" if repaired else "a")


def picture_of_an_unknown_kind(repaired):
    with inside():
        run().plot("x", path="a.png" if repaired else "a.xlsx")


def picture_named_first(repaired):
    with inside():
        run().plot("x", path="a.png") if repaired else run().plot("a.png")


def picture_of_nothing(repaired):
    run().plot("x" if repaired else "z")


def study_of_a_class(repaired):
    if not repaired:
        study(Decay, **QUICK)  # type: ignore[arg-type]


def study_of_a_compiled_model(repaired):
    if not repaired:
        study(ac.compile(Decay()), **QUICK)  # type: ignore[arg-type]


def study_with_one_tolerance(repaired):
    studied({"tolerances": 1e-3}, repaired, tolerances=[1e-3])


def study_with_a_method_as_text(repaired):
    studied({"methods": "idas"}, repaired)


def study_with_outputs_as_text(repaired):
    studied({"outputs": "y"}, repaired, outputs=["y"])


def study_with_outputs_as_numbers(repaired):
    studied({"outputs": [1]}, repaired)


def study_with_a_formulation_by_name(repaired):
    studied({"formulations": ["fem"]}, repaired, formulations=formulations_of(Decay(), {}))


def study_with_switches_as_a_list(repaired):
    studied({"switches": ["drag"]}, repaired)


def study_with_a_single_switch(repaired):
    studied({"switches": {"drag": True}}, repaired, switches={"drag": [True, False]})


def study_with_parameters_as_pairs(repaired):
    studied({"parameters": [("order", 3)]}, repaired)


def study_with_a_wrong_start(repaired):
    studied({"initial": "zero"}, repaired)


def study_in_a_number_of_processes(repaired):
    studied({"executor": 4}, repaired, executor=Serial())


def study_with_too_many_points(repaired):
    studied({"intervals": 10**10}, repaired)


def study_drawn_for_an_unknown_output(repaired):
    with inside({"r.csv": REFERENCE}):
        found = study(Decay(), **QUICK)
    found.plot(output="y" if repaired else "z")


def effects_of_a_class(repaired):
    if not repaired:
        effects(Decay, stop_time=1)  # type: ignore[arg-type]


def too_many_intervals(repaired):
    ac.simulate(Decay(), stop_time=1, intervals=4 if repaired else 10**10)


def an_endless_run(repaired):
    ac.simulate(Decay(), stop_time=1 if repaired else float("inf"), intervals=4)


def a_tolerance_below_rounding(repaired):
    ac.simulate(Decay(), stop_time=1, intervals=4, tolerance=1e-6 if repaired else 1e-40)


def a_start_of_another_name(repaired):
    ac.simulate(Decay(), stop_time=1, intervals=4, initial="guesses" if repaired else "guess")


def a_number_of_400_digits(repaired):
    ac.compile(Decay(rate=10 ** (4 if repaired else 400)))
