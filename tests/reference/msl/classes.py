"""`python -m tests.reference.msl.classes REPOSITORY`: write classes.txt, the names of the classes of Modelica's mechanics.

REPOSITORY is a git directory of the Modelica Standard Library. Examples, icons, guides, internal classes and types are left out.
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

TAG = "v4.1.0"
MECHANICS = "Modelica/Mechanics/"
PACKAGES = ("MultiBody", "Rotational", "Translational")
LEFT_OUT = {"Examples", "Icons", "UsersGuide", "Internal"}
NAMES = Path(__file__).parent / "classes.txt"
COMMENTS = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.S)
CLASS = re.compile(
    r"\bend\s+(?P<end>\w+)\s*;"
    r"|\b(?P<kind>model|block|connector|function|record|type|class|package|operator)\s+(?:extends\s+)?(?P<name>\w+)"
    r"(?P<short>\s*=)?"
)


def classes_of(text: str) -> Iterator[tuple[str, str]]:
    """Yield kind and name of the classes in a file, those in classes that are no packages left out."""
    inside: list[tuple[str, str]] = []
    for found in CLASS.finditer(COMMENTS.sub('""', text)):
        if found["end"]:
            if inside and found["end"] == inside[-1][1]:
                inside.pop()
            continue
        if all(kind == "package" for kind, _ in inside):
            yield found["kind"], ".".join([*(name for _, name in inside), found["name"]])
        if not found["short"]:
            inside.append((found["kind"], found["name"]))


def names_in(repository: str) -> Iterator[str]:
    """Yield the names of all classes, from the name of the package on."""

    def git(*words: str) -> str:
        return subprocess.run(["git", "-C", repository, *words], capture_output=True, text=True, check=True).stdout

    for path in git("ls-tree", "-r", "--name-only", TAG, MECHANICS).splitlines():
        folder, _, file = path.removeprefix(MECHANICS).rpartition("/")
        packages = folder.split("/")
        if not file.endswith(".mo") or packages[0] not in PACKAGES or LEFT_OUT & set(packages):
            continue
        above = packages[:-1] if file == "package.mo" else packages
        for kind, name in classes_of(git("show", f"{TAG}:{path}")):
            if kind in ("model", "block", "connector", "function", "record") and not LEFT_OUT & set(name.split(".")):
                yield ".".join([*above, name])


if __name__ == "__main__":
    found = sorted(names_in(sys.argv[1]), key=lambda name: name.rpartition("."))
    NAMES.write_text("".join(f"{name}\n" for name in found))
