"""The tutorial runs, and prints what it shows."""

import math
import re
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "tutorial.md"
NUMBER = re.compile(r"-?\d+\.\d+")


def blocks() -> list[tuple[str, str]]:
    """Language and text of the fenced blocks, in order."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", PAGE.read_text(), re.M | re.S)


def same(shown: str, printed: str) -> bool:
    """Equal but for the last digits of numbers; seconds may be any."""
    texts = [re.sub(r"^  seconds .*$", "", text, flags=re.M) for text in (shown, printed)]
    values = [[float(x) for x in NUMBER.findall(text)] for text in texts]
    equal = all(math.isclose(a, b, rel_tol=5e-3, abs_tol=2e-3) for a, b in zip(*values, strict=True))
    return equal and NUMBER.sub("", texts[0]) == NUMBER.sub("", texts[1])


def test_the_tutorial_prints_what_it_shows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    file, names, code, printed, compared = tmp_path / "crane.py", {"__name__": "crane"}, "", "", 0
    for language, text in blocks():
        if language == "python":
            # One file that grows, so that messages name its lines.
            exec(compile("\n" * code.count("\n") + text, str(file), "exec"), names)
            code += text
            printed = capsys.readouterr().out.replace(f"{tmp_path}/", "")
        else:
            assert same(text, printed), printed
            compared += 1
    assert compared >= 7
    assert (tmp_path / "crane.png").stat().st_size > 10_000
