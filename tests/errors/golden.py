"""Exact messages of the broken models, a file for each module of them.

`python -m tests.errors.golden` writes them anew; read the difference before it is committed.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import acausal as ac
from tests.errors.broken import models

HERE = Path(__file__).parent
Case = Callable[[bool], None]


def _cases(name: str) -> list[Case]:
    module = import_module(f"tests.errors.broken.{name}")
    functions = [f for f in vars(module).values() if inspect.isfunction(f) and f.__module__ == module.__name__]
    return [f for f in functions if list(inspect.signature(f).parameters) == ["repaired"]]


CASES = {path.stem: _cases(path.stem) for path in sorted((HERE / "broken").glob("[a-z]*.py")) if path.stem != "models"}


def told(case: Case) -> str:
    """Kind and message, with lines of its file counted from the head of the case, other files without lines."""
    try:
        case(False)
    except ac.AcausalError as error:
        caught = error
    else:
        raise AssertionError(f"{case.__name__}: nothing was refused")
    first = case.__code__.co_firstlineno
    text = f"{type(caught).__name__}: {caught}"

    def shift(found: re.Match[str]) -> str:
        line = int(found[1]) - first
        return f"line {line:+d}" if line > 0 else "a shared line"

    text = re.sub(re.escape(case.__code__.co_filename) + r":(\d+)", shift, text)
    text = re.sub(re.escape(str(models.__file__)) + r":\d+", "a shared line", text)
    text = text.replace(f"directory {Path.cwd()}", "directory /here")
    return re.sub(r"/\S*/(\w+/\w+\.py):\d+", r"\1:*", text)


def golden(name: str) -> dict[str, str]:
    """Messages by case, of one module."""
    path = HERE / "messages" / f"{name}.txt"
    pairs = re.findall(r"^\[(\w+)\]\n(.*?)\n(?=\n\[|\Z)", path.read_text() if path.exists() else "", re.M | re.S)
    return {case: text.rstrip() for case, text in pairs}


def main() -> None:
    """Write all messages."""
    for name, cases in CASES.items():
        parts = [f"[{case.__name__}]\n{told(case)}\n" for case in cases]
        (HERE / "messages" / f"{name}.txt").write_text("\n".join(parts))


if __name__ == "__main__":
    main()
