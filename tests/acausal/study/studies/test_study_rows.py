"""Rows: what limits each case, which are the best, and how they are written."""

import numpy as np
import pytest

from acausal.study import Case, Formulation, Measurement, Reference, Study, StudyRow
from acausal.study.studies.study_rows import pareto, rows_of
from acausal.study.studies.study_table import cells, columns

T = np.linspace(0, 1, 11)
FORMS = (Formulation("good", {}, {"n": (2, 4)}, exact=True), Formulation("bad", {}, {"n": (2, 4)}))
REFERENCE = Reference(T, {"x": T}, {"coarser elements": {"x": 1e-6}}, 1e-5, "made")


def measured(form, n, tolerance, error, seconds):
    return Measurement(
        Case(form, {"n": n}, str(n), tolerance), T, {"x": T * (1 + error)}, 0.1, seconds, 10, 5, 30, n, 100, 2, "idas"
    )


MEASURED = [
    measured("good", 2, 1e-3, 3e-2, 1e-3),
    measured("good", 2, 1e-5, 1e-2, 5e-3),
    measured("good", 4, 1e-3, 1.2e-2, 2e-3),
    measured("good", 4, 1e-5, 1e-4, 8e-3),
    measured("good", 4, 1e-6, 2e-7, 1e-1),
    measured("bad", 2, 1e-5, 5.1e-2, 4e-3),
    measured("bad", 4, 1e-5, 5e-2, 6e-3),
    measured("bad", 4, 1e-6, 1e6, 6e-3),
    Measurement(Case("bad", {"n": 4}, "4", 1e-7), error="it was stopped after 60 s"),
]
ROWS = rows_of(MEASURED, REFERENCE, FORMS)


def test_errors_and_limits():
    assert [row.error for row in ROWS[:7]] == pytest.approx([3e-2, 1e-2, 1.2e-2, 1e-4, 2e-7, 5.1e-2, 5e-2])
    assert [row.limit for row in ROWS] == [
        "tolerance", "elements", "tolerance", "tolerance", "reference", "model", "model", "", ""
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("form", "error", "limit"),
    [("whole", 5e-3, "tolerance"), ("other", 5e-3, "unknown"), ("other", 0.5, "model"), ("other", 1e-6, "reference")],
)
def test_a_single_tolerance_does_not_tell_its_part(form, error, limit):
    forms = (Formulation("whole", {}, exact=True), Formulation("other", {}))
    (row,) = rows_of([measured(form, 2, 1e-3, error, 1e-3)], REFERENCE, forms)
    assert row.limit == limit


def test_what_diverged_is_marked():
    assert ROWS[7].remark == "it diverged: the error is 1e+06 times the range"
    assert ROWS[8].remark == "it was stopped after 60 s"


def test_front():
    assert [k for k, row in enumerate(ROWS) if row.front] == [0, 1, 2, 3, 4]
    assert [row.seconds for row in pareto(ROWS[:7])] == [1e-3, 2e-3, 5e-3, 8e-3, 1e-1]


def test_price_stops_where_the_reference_ends():
    price = Study("Model", ROWS, REFERENCE).price()
    assert price[0] == "an error of 1e-01 costs 1 ms: good, 2, tolerance 1e-03"
    assert price[3] == "an error of 1e-04 costs 8 ms: good, 4, tolerance 1e-05"
    assert len(price) == 6


def test_columns():
    table = columns(ROWS)
    assert list(table)[:6] == ["formulation", "size", "tolerance", "max_order", "method", "constraints"]
    assert table["error x"][3] == pytest.approx(1e-4)
    assert table["best"] == [1, 1, 1, 1, 1, 0, 0, 0, 0]
    assert np.isnan(table["error"][8])
    assert {len(column) for column in table.values()} == {9}


def test_cells():
    table = cells(ROWS, REFERENCE, ())
    head, body = table.head, table.rows
    assert head[:4] == ["", "formulation", "size", "tolerance"]
    assert [row[head.index("error")] for row in body] == [
        "3.0e-02", "1.0e-02", "1.2e-02", "1.0e-04", "< 1.0e-06", "5.1e-02", "5.0e-02", "-", "-"
    ]  # fmt: skip
    lines = table.text().splitlines()
    assert len(lines) == 10
    assert lines[1].startswith("*  good")
    assert lines[9].endswith("it was stopped after 60 s")
    first, rule, best, *_ = table.markdown().splitlines()
    assert first.startswith("| formulation | size | tolerance |")
    assert set(rule) == set("|- ")
    assert best.startswith("| **good** | **2** | **1e-03** |")


def test_picture(tmp_path):
    study = Study("Model", ROWS, REFERENCE)
    figure = study.plot(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    axes = figure.axes[0]
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    assert {"good", "bad"} <= {str(t.get_text()) for t in axes.get_legend().get_texts()}  # type: ignore[union-attr]


def test_row_of_a_failure_has_no_error():
    row: StudyRow = ROWS[8]
    assert np.isnan(row.error)
    assert np.isnan(row.rms)
