import numpy as np
import pytest

from acausal.errors import DeclarationError
from acausal.result import match, names
from tests.acausal.result.demo import TIME, Demo, demo


@pytest.fixture
def result():
    return demo()


@pytest.mark.parametrize(
    ("key", "shape"),
    [
        ("x", ()),
        ("place", (2,)),
        ("piece[1].q", (3,)),
        ("piece[1].q[2]", ()),
        ("piece[0].T", (3, 3)),
        ("piece[0].T[1]", (3,)),
        ("piece[0].T[0, 1]", ()),
        ("piece[0].single", (1,)),
        ("piece[0].twice", (2,)),
        ("time", ()),
    ],
)
def test_shapes(result, key, shape):
    assert result[key].shape == (TIME.size, *shape)


def test_matrix_entries_are_where_they_belong(result):
    tensor = result["piece[0].T"]
    symbols = result.tree.piece[0].T
    for i in range(3):
        for j in range(3):
            np.testing.assert_array_equal(tensor[:, i, j], result[symbols[i, j]])
            np.testing.assert_array_equal(tensor[:, i, j], result[f"piece[0].T[{i},{j}]"])
    assert np.ptp(tensor - tensor.transpose(0, 2, 1)) > 0


def test_attribute_of_the_model_is_a_key(result):
    model = Demo()
    np.testing.assert_array_equal(result[model.piece[1].q], result["piece[1].q"])
    np.testing.assert_array_equal(result[model.piece[1].T[1, 2]], result["piece[1].T"][:, 1, 2])
    np.testing.assert_array_equal(result[model.x], result["x"])


def test_expression_is_a_key(result):
    q = result.tree.piece[0].q
    np.testing.assert_array_equal(result[q], result["piece[0].q"])
    np.testing.assert_allclose(result[q[0] * q[1]], result["piece[0].q[0]"] * result["piece[0].q[1]"])


def test_observed_is_computed(result):
    np.testing.assert_allclose(result["piece[0].twice"], 2 * result["piece[0].q"][:, :2])


def test_arrays_are_kept_and_read_only(result):
    first = result["piece[0].q"]
    calls = result._evaluate.calls
    assert result["piece[0].q"] is first
    assert result._evaluate.calls == calls
    with pytest.raises(ValueError, match="read-only"):
        first[0] = 0


def test_table_takes_one_evaluation(result):
    result.to_dataframe("x", "piece[0].T", "piece[1].q")
    assert result._evaluate.calls == 1


def test_names_lists_everything_that_can_be_read(result):
    known = names(result.tree)
    assert {"x", "angle", "place", "piece[0].k", "piece[1].T", "piece[1].twice"} <= set(known)
    assert not {"n", "left_out", "piece"} & set(known)
    for name in known:
        assert len(result[name]) == TIME.size


def test_match(result):
    assert match(result.tree, ["piece[1].?", "x"]) == ["piece[1].k", "piece[1].q", "piece[1].T", "x"]
    assert match(result.tree, ["*.q", "piece[0].q"]) == ["piece[0].q", "piece[1].q"]
    assert match(result.tree, ["piece[0].q[1]"]) == ["piece[0].q[1]"]
    with pytest.raises(DeclarationError) as error:
        match(result.tree, ["zz*"])
    assert str(error.value) == "no variable of the model matches `zz*`; * stands for any text."


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("angel", "there is no `angel` in the model; did you mean `angle`?"),
        ("T", "there is no `T` in the model; did you mean `piece[0].T`, `piece[1].T`?"),
        ("piece[2].q", "`piece[2]` does not exist: `piece` has 2 parts, from 0."),
        ("left_out.x", "there is no `left_out.x` in the model."),
        ("piece[0].q[3]", "`piece[0].q[3]` does not exist: `piece[0].q` has shape (3,)."),
        ("x[0]", "`x[0]` does not exist: `x` has shape ()."),
        ("piece", "`piece` is a list of 2 parts; name a variable of one, such as `piece[0].k`."),
        ("piece[0]", "`piece[0]` is a part (Piece); name one of its variables, such as `piece[0].k`."),
        ("x[0].q", "there is no `x[0].q` in the model."),
        ("n", "`n` is structural and does not vary with time; its value is 2."),
        ("check", "there is no `check` in the model; it has x, angle, place."),
        ("", "the name of a variable is empty; give its path, such as 'beam.frame_b.r_0'."),
        ("piece[a].q", "there is no `piece[a].q` in the model; did you mean `piece[1].q`, `piece[0].q`?"),
        (3, "a result is read by a path such as 'beam.frame_b.r_0', not by 3."),
    ],
)
def test_messages(result, key, message):
    with pytest.raises(DeclarationError) as error:
        result[key]
    assert str(error.value) == message
