"""Each broken model tells what is wrong, and its repaired form does not: exact messages are in messages.txt."""

import inspect
import re
from pathlib import Path

import pytest

import acausal as ac
from tests.errors.broken import connections, equations, events, models, python, values

GOLDEN = Path(__file__).with_name("messages.txt")
CASES = [
    f
    for module in (connections, equations, values, events, python)
    for f in vars(module).values()
    if inspect.isfunction(f) and list(inspect.signature(f).parameters) == ["repaired"]
]


def told(case):
    """Kind and message, with lines of its file counted from the head of the case, other files without lines."""
    with pytest.raises(ac.AcausalError) as caught:
        case(False)
    first = case.__code__.co_firstlineno
    text = f"{type(caught.value).__name__}: {caught.value}"

    def shift(found):
        line = int(found[1]) - first
        return f"line {line:+d}" if line > 0 else "a shared line"

    text = re.sub(re.escape(case.__code__.co_filename) + r":(\d+)", shift, text)
    text = re.sub(re.escape(models.__file__) + r":\d+", "a shared line", text)
    return re.sub(r"/\S*/(\w+/\w+\.py):\d+", r"\1:*", text)


def golden():
    pairs = re.findall(r"^\[(\w+)\]\n(.*?)\n(?=\n\[|\Z)", GOLDEN.read_text(), re.M | re.S)
    return {name: text.rstrip() for name, text in pairs}


def test_every_message_has_its_case():
    assert sorted(golden()) == sorted(case.__name__ for case in CASES)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.__name__)
def test_message(case):
    assert told(case) == golden()[case.__name__]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.__name__)
def test_repaired(case):
    case(True)
