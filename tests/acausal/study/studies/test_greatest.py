"""Numbers that are refined up to a greatest value: there are only so many modes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Formulation, Model, Scalar, output, structural, variable
from acausal.study import formulations_of
from acausal.study.studies.formulation import within

EXACT = 1 - np.exp(-1.0)


class Series(Component):
    """Terms of a series, of which there are `terms`: each weighs a quarter of the one before."""

    terms: int = structural("terms that there are", default=6, cls=int, minimum=1)
    n: Any = structural(
        "terms that are taken",
        default=3,
        cls=int,
        minimum=1,
        maximum=lambda s: s.terms,
        refine=lambda s: s.adaptive,
    )
    adaptive: bool = structural("whether accuracy chooses them", default=True, choices=(True, False))
    y: Scalar = variable("sum", unit="1", start=0.0, fixed=True)

    def equations(self):
        yield ac.der(self.y) == ac.quantity(sum(0.25**k for k in range(self.n)), "1/s") * ac.exp(-ac.time)


class Plain(Component):
    """A number that may be doubled without end."""

    m: int = structural("elements", default=2, minimum=1, refine=lambda s: True)
    y: Scalar = variable("sum", unit="1", start=0.0, fixed=True)

    def equations(self):
        yield ac.der(self.y) == ac.quantity(1.0 + 0.1 / self.m**4, "1/s") * ac.exp(-ac.time)


class Sum(Model):
    series: Any = Series()
    y: Scalar = output("sum", unit="1")
    stop_time = 1.0

    def equations(self):
        yield self.y == self.series.y


class Both(Sum):
    plain = Plain()

    def equations(self):
        yield self.y == self.series.y + self.plain.y


def value(n: int) -> float:
    """What the series is at the end."""
    return EXACT * sum(0.25**k for k in range(n))


@pytest.mark.parametrize(
    ("n", "terms", "sizes"),
    [
        (1, 100, (1, 2, 4)),
        (3, 6, (1, 3, 6)),
        (3, 8, (3, 6, 8)),
        (6, 6, (1, 3, 6)),
        (10, 15, (5, 10, 15)),
        (10, 11, (5, 10, 11)),
        (2, 2, (1, 2)),
        (1, 1, (1,)),
    ],
)
def test_sizes_up_to_the_greatest(n, terms, sizes):
    class Own(Sum):
        series = Series(n=n, terms=terms)

    (form,) = formulations_of(Own(), {})
    found = [form.at(step)[0]["series.n"] for step in range(form.steps)]
    assert tuple(found) == sizes
    beyond = [form.at(form.steps - 1 + k)[0]["series.n"] for k in range(8)]
    assert beyond == [min(sizes[-1] * 2**k, terms) for k in range(8)]


def test_sizes_of_several_paths_advance_together():
    (form,) = formulations_of(Both(), {})
    assert [form.at(k)[1] for k in range(5)] == ["1 + 2", "3 + 4", "6 + 8", "6 + 16", "6 + 32"]
    assert form.steps == 3


def test_declared_formulations_are_bounded_by_the_model():
    form = within(Sum(), {}, Formulation("own", {}, {"series.n": (2, 4, 8, 16)}))
    assert (form.steps, form.most) == (3, {"series.n": 6})
    assert [form.at(k)[0]["series.n"] for k in range(6)] == [2, 4, 6, 6, 6, 6]
    assert within(Sum(), {"series.terms": 20}, Formulation("own", {}, {"series.n": (2, 4)})).at(5)[0] == {
        "series.n": 20
    }
    assert Formulation("own", {}, {"n": (2, 2)}).steps == 2  # as it is said, where nothing bounds it
    with pytest.raises(ac.DeclarationError, match="is 7; it must be a number of at most 6"):
        ac.study(Sum(), formulations=[Formulation("own", {}, {"series.n": (7, 14)})], workers=1)


@pytest.mark.parametrize("formulations", [None, [Formulation("own", {}, {"series.n": (2, 4, 8)}, exact=True)]])
def test_a_study_ends_at_the_greatest(formulations):
    study = ac.study(Sum(), formulations=formulations, tolerances=[1e-6], repeats=1, workers=1, accuracy=1e-6)
    assert study.reference.values["y"][-1] == pytest.approx(value(6), rel=1e-6)
    assert study.reference.floor <= 1e-6
    # Of a number of elements with itself nothing is told.
    assert all(max(found.values()) > 0 for found in study.reference.agreement.values())
    errors = {row.case.settings["series.n"]: row.error for row in study.rows}
    assert max(errors) == 6
    assert errors[6] < 1e-5
    assert errors[min(errors)] == pytest.approx(abs(value(min(errors)) - value(6)) / value(6), rel=1e-2)


def test_accuracy_takes_all_where_that_is_needed():
    result = ac.simulate(Sum(), accuracy=1e-6)
    assert result.stats["chosen"]["sizes"] == {"series.n": 6}
    assert result["y"][-1] == pytest.approx(value(6), rel=2e-6)
    assert {run["sizes"]["series.n"] for run in result.stats["trials"]} <= {1, 2, 4, 6}
    few = ac.simulate(Sum(), accuracy=1e-1)
    assert few.stats["chosen"]["sizes"]["series.n"] < 6


def test_all_of_them_where_none_is_given():
    class All(Series):
        n = structural("terms", default=None, cls=int, maximum=lambda s: s.terms, refine=lambda s: True)

        def equations(self):
            yield ac.der(self.y) == 0

    class Own(Sum):
        series = All()

    (form,) = formulations_of(Own(), {})
    assert form.refine == {"series.n": (1, 3, 6)}
