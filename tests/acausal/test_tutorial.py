"""The pages that are programs run, and print what they show."""

import math
import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
# Pages, and how many outputs they show.
PROGRAMS = {
    "start/tutorial.md": 8,
    "from/signs.md": 2,
    "how-to/find-a-mistake.md": 1,
    "how-to/set-start-values.md": 1,
}
NUMBER = re.compile(r"-?\d+\.\d+")


def blocks(page: str) -> list[tuple[str, str]]:
    """Language and text of the fenced blocks, in order."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", (DOCS / page).read_text(), re.M | re.S)


def same(shown: str, printed: str) -> bool:
    """Equal but for the last digits of numbers; seconds may be any, and the integrator is the one that is installed."""
    texts = [re.sub(r"^  (seconds|integrator) .*$", "", text, flags=re.M) for text in (shown, printed)]
    values = [[float(x) for x in NUMBER.findall(text)] for text in texts]
    equal = all(math.isclose(a, b, rel_tol=5e-3, abs_tol=2e-3) for a, b in zip(*values, strict=True))
    return equal and NUMBER.sub("", texts[0]) == NUMBER.sub("", texts[1])


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("page", "outputs"), PROGRAMS.items())
def test_a_page_prints_what_it_shows(
    page: str, outputs: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    name = re.search(r"save it as `(\w+)\.py`|file, `(\w+)\.py`", (DOCS / page).read_text())
    module = name[1] or name[2] if name else "page"
    file, names, code, printed, compared = tmp_path / f"{module}.py", {"__name__": module}, "", "", 0
    for language, text in blocks(page):
        if language == "python":
            # One file that grows, so that messages name its lines.
            exec(compile("\n" * code.count("\n") + text, str(file), "exec"), names)
            code += text
            printed = capsys.readouterr().out.replace(f"{tmp_path}/", "")
        else:
            assert same(text, printed), printed
            compared += 1
    assert compared == outputs
