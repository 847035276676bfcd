import os
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest

from acausal.errors import DeclarationError, ExportError
from acausal.result import check_picture, check_writable
from acausal.result.files import whole
from acausal.result.plots import Curve, Series, draw
from tests.acausal.result.demo import TIME, demo

PNG = b"\x89PNG"


@pytest.fixture
def result():
    return demo()


def test_csv_reads_back_exactly(result, tmp_path):
    path = tmp_path / "out.csv"
    result.to_csv(path)
    table = pd.read_csv(path)
    assert list(table) == ["time", "x", "angle", "place[0]", "place[1]"]
    assert len(table) == TIME.size
    np.testing.assert_array_equal(table["time"], TIME)
    np.testing.assert_array_equal(table["place[1]"], result["place"][:, 1])
    assert b"\r" not in path.read_bytes()


def test_csv_with_columns_of_a_matrix(result, tmp_path):
    path = tmp_path / "out.csv"
    result.to_csv(path, "piece[0].T", "time")
    table = pd.read_csv(path)
    assert list(table)[:3] == ["time", "piece[0].T[0,0]", "piece[0].T[0,1]"]
    np.testing.assert_array_equal(table["piece[0].T[2,1]"], result["piece[0].T"][:, 2, 1])


def test_dataframe(result):
    assert list(result.to_dataframe()) == ["time", "x", "angle", "place[0]", "place[1]"]
    assert list(result.to_dataframe("angle")) == ["time", "angle"]


def test_a_file_is_written_whole_or_not_at_all(tmp_path):
    path = tmp_path / "out.csv"
    path.write_text("old")
    with pytest.raises(TypeError), whole(path) as file:
        file.writelines(["half", 1])  # fails in the middle
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_link_stays_a_link(result, tmp_path):
    link, target = tmp_path / "link.csv", tmp_path / "target.csv"
    target.write_text("old")
    link.symlink_to(target)
    result.to_csv(link)
    assert link.is_symlink()
    assert target.read_text().startswith("time,x")


def test_a_device_is_not_replaced(result):
    check_writable(os.devnull)
    result.to_csv(os.devnull)
    assert not os.path.isfile(os.devnull)


def test_unwritable_paths_tell_the_reason(tmp_path):
    (tmp_path / "file").write_text("")
    for path, reason in {
        tmp_path: "it is a directory; append a file name.",
        tmp_path / "none" / "a.csv": f"there is no directory {tmp_path / 'none'}; create it first.",
        tmp_path / "file" / "a.csv": f"there is no directory {tmp_path / 'file'}; create it first.",
    }.items():
        with pytest.raises(ExportError) as error:
            check_writable(path)
        assert str(error.value) == f"cannot write {path}: {reason}"


def test_check_leaves_nothing_behind(tmp_path):
    check_writable(tmp_path / "a.csv")
    assert list(tmp_path.iterdir()) == []


def test_plot_has_one_axes_for_each_unit(result, tmp_path):
    path = tmp_path / "a.png"
    figure = result.plot(path=path)
    assert path.read_bytes().startswith(PNG)
    assert [axes.get_ylabel() for axes in figure.axes] == ["x, place [m]", "angle [rad]"]
    assert figure.axes[-1].get_xlabel() == "time [s]"
    assert [text.get_text() for text in figure.axes[0].get_legend().get_texts()] == ["x", "place[0]", "place[1]"]


def test_units_of_entries_expressions_and_literals(result):
    q = result.tree.piece[0].q
    units = [s.unit for s in result.series("piece[0].q", q, q[0] * q[0], "piece[0].T[0,0]", "piece[0].k", "time")]
    assert units == ["m", "m", "rad", "m", "m", "rad", "m2", "1", "N/m", "s"]


def test_other_pictures(result, tmp_path):
    result.plot("x", path=tmp_path / "a.svg")
    assert b"<svg" in (tmp_path / "a.svg").read_bytes()
    with pytest.raises(ExportError) as error:
        check_picture("a.txt")
    assert str(error.value) == "cannot write a.txt: a picture's name ends in .png, .svg or .pdf."


def test_nothing_to_plot():
    with pytest.raises(DeclarationError, match="there is nothing to plot: the model has no outputs"):
        draw([])


@pytest.mark.parametrize(
    ("code", "absent"),
    [
        ("import acausal", ("matplotlib", "pandas")),
        ("from tests.acausal.result.demo import demo; demo().plot()", ("matplotlib.pyplot", "pandas")),
    ],
)
def test_imports_are_late(code, absent):
    code = f"import sys; {code}; print([m for m in {absent} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_small_series_have_axes_of_their_own():
    time = np.linspace(0, 1, 5)
    large, small, still = Series("a", "m", time), Series("b", "m", 1e-3 * time), Series("c", "m", 0 * time)
    figure = draw([Curve(Series("time", "s", time), y) for y in (large, small, still)])
    assert [[line.get_label() for line in axes.lines] for axes in figure.axes] == [["a", "c"], ["b"]]
