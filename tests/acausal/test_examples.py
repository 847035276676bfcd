"""The code blocks of the pages run, and none warns of its own error unless its page says that it is about that.

Python blocks of a page make one program, in which each builds on those before it; it keeps the line numbers of the page.
Indented blocks of commands run line by line. An invisible comment before a block says what else is true of it:
`<!-- not run: why -->`, `<!-- warns: of what -->`, and of commands `<!-- slow: why -->`.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from textwrap import dedent
from zipfile import ZipFile

import pytest

from tests.acausal.test_tutorial import PROGRAMS

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted(p for p in (ROOT / "docs").rglob("*.md") if p.parent.name != "components")]
MARKS = ("not run", "slow", "warns")
MARK = re.compile(r"<!-- (.*): \S.* -->\n+\Z")
FENCED = re.compile(r"^```([\w{}-]*).*?\n(.*?)^```$", re.M | re.S)
INDENTED = re.compile(r"(?<=\n\n)(?:    .*\n|\n(?=    ))+")
SETTING = re.compile(r"\w+=\S+")  # of an environment variable, before a command
COMMAND = {"acausal": [sys.executable, "-m", "acausal"], "python": [sys.executable]}
# On the first line of a page, which is its heading.
STRICT = 'import warnings; warnings.simplefilter("error")'


@dataclass(frozen=True)
class Block:
    """A block of code: where it begins (the line of its fence, or the first one of a command), and what is said of it."""

    page: Path
    line: int
    language: str
    text: str
    mark: str = ""

    def __str__(self) -> str:
        return f"{self.page.name}:{self.line}"

    @property
    def commands(self) -> list[list[str]]:
        """The words of each of its commands."""
        lines = dedent(self.text).strip().replace("\\\n", " ").splitlines()
        return [shlex.split(line) for line in lines]


def blocks(page: Path) -> Iterator[Block]:
    """Return the blocks of a page, fenced ones first."""
    text = page.read_text()
    for match in FENCED.finditer(text):
        if not match[1].startswith("{"):  # a directive
            yield _block(page, text, match.start(), match[1], match[2])
    rest = FENCED.sub(lambda match: "\n" * match[0].count("\n"), text)
    for match in INDENTED.finditer(rest):
        if re.match(r" +(?:\w+=\S+ )*(?:acausal|python|gmsh) ", match[0]):
            yield _block(page, rest, match.start(), "command", match[0])


def _block(page: Path, text: str, start: int, language: str, code: str) -> Block:
    mark = MARK.search(text[:start])
    return Block(page, text.count("\n", 0, start) + 1, language, code, mark[1] if mark else "")


BLOCKS = [block for page in PAGES for block in blocks(page)]
# Of those that print what they show another test runs the blocks.
PYTHON_PAGES = [page for page in PAGES if "/".join(page.parts[-2:]) not in PROGRAMS and "```python" in page.read_text()]
COMMANDS = [
    pytest.param(block, id=str(block), marks=[pytest.mark.slow] if block.mark == "slow" else [])
    for block in BLOCKS
    if block.language == "command" and block.mark != "not run"
]


def program(page: Path) -> str:
    """Return the Python blocks of a page at their lines; the lines of their fences set what warnings do."""
    lines = [STRICT, *[""] * page.read_text().count("\n")]
    for block in blocks(page):
        if block.language == "python" and block.mark != "not run":
            code = block.text.splitlines()
            lines[block.line : block.line + len(code)] = code
            if block.mark == "warns":
                lines[block.line - 1] = 'warnings.simplefilter("ignore")'
                lines[block.line + len(code)] = 'warnings.simplefilter("error")'
    return "\n".join(lines) + "\n"


def folder(page: Path, path: Path) -> Path:
    """Write into a folder what the commands of a page presume, and return the file of its program."""
    (path / "docs/pictures").mkdir(parents=True)
    if page.name == "import-fe-models.md":
        plate_in_millimetres(path)
    name = re.search(r"[Ss]ave it as `(\w+\.py)`", page.read_text())
    file = path / (name[1] if name else f"page_{page.stem}.py")  # components.py would hide the package
    file.write_text(program(page))
    return file


def plate_in_millimetres(path: Path) -> None:
    """Write the files of CalculiX that are in m, N and kg in mm, N and Mg: lengths times 1e3, matrices times 1e-3."""
    with ZipFile(ROOT / "tests/reference/fe/calculix.zip") as archive:
        text = {kind: archive.read(f"c3d20.{kind}").decode() for kind in ("inp", "sti", "mas", "dof")}
    text["inp"] = re.sub(r"^(\d+),([\d.]+),([\d.]+),([\d.]+)$", r"\1,\2e3,\3e3,\4e3", text["inp"], flags=re.M)
    for kind in ("sti", "mas"):
        text[kind] = re.sub(r"(\S+)$", lambda value: f"{1e-3 * float(value[1]):.13e}", text[kind], flags=re.M)
    for kind, content in text.items():
        (path / f"plate.{kind}").write_text(content)


def run(words: list[str], path: Path) -> subprocess.CompletedProcess[str]:
    """Run a command as a user in that folder would."""
    first = next(k for k, word in enumerate(words) if not SETTING.fullmatch(word))
    environment = os.environ | dict(word.split("=", 1) for word in words[:first]) | {"MPLBACKEND": "Agg"}
    environment["PYTHONPATH"] = os.pathsep.join([str(ROOT), environment.get("PYTHONPATH", "")]).rstrip(os.pathsep)
    command = [*COMMAND[words[first]], *words[first + 1 :]]
    return subprocess.run(command, cwd=path, env=environment, capture_output=True, text=True, timeout=600)


def test_every_block_is_of_a_known_kind() -> None:
    assert {block.language for block in BLOCKS} == {"python", "text", "command", "modelica"}
    assert {block.mark for block in BLOCKS} <= {"", *MARKS}
    assert len(BLOCKS) > 50


@pytest.mark.parametrize("page", PYTHON_PAGES, ids=lambda page: page.name)
def test_python_blocks_run(page: Path, tmp_path: Path) -> None:
    done = run(["python", folder(page, tmp_path).name], tmp_path)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("block", COMMANDS)
def test_commands_run(block: Block, tmp_path: Path) -> None:
    folder(block.page, tmp_path)
    for words in block.commands:
        done = run(words, tmp_path)
        assert done.returncode == 0, done.stderr
        assert ("Warning" in done.stderr) == (block.mark == "warns"), done.stderr
