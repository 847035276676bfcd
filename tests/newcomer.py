"""`python -m tests.newcomer`: the way of a newcomer, in a fresh environment, with the time of each step.

It installs the project, runs the first commands of the README, the tutorial and three how-to pages, and builds the site.
It ends with an error at the first step that fails or prints a warning.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from time import perf_counter

from tests.acausal.test_examples import ROOT, blocks, folder

PAGES = ("start/tutorial", "how-to/write-a-component", "how-to/model-a-beam", "how-to/run-studies")


def steps(place: Path) -> Iterator[tuple[str, str, Path]]:
    """Yield what is done, its command, and where."""
    readme = [
        line for block in blocks(ROOT / "README.md") if block.language == "command" for line in block.text.splitlines()
    ]
    first, second = (next(line for line in readme if name in line).strip() for name in ("spin-up", "robot-arm"))
    install, _, simulate = first.partition(" && ")
    yield "README: install", install.replace("install .", f"install --quiet {ROOT}"), place
    yield "README: first run", simulate, place
    yield "README: robot arm", second, place
    for page in PAGES:
        inside = place / page
        inside.mkdir(parents=True)
        yield page, f"python {folder(ROOT / 'docs' / f'{page}.md', inside).name}", inside
    yield "packages of the site", f"python -m pip install --quiet '{ROOT}[docs]'", place
    yield "site", f"python -m sphinx -q -W --keep-going -j auto {ROOT / 'docs'} {place / 'site'}", place


def main() -> None:
    """Run all steps."""
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        subprocess.run([sys.executable, "-m", "venv", place / "env"], check=True)
        environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")} | {
            "MPLBACKEND": "Agg"
        }
        environment["PATH"] = os.pathsep.join((str(place / "env/bin"), environment["PATH"]))
        for what, command, where in steps(place):
            start = perf_counter()
            done = subprocess.run(command, shell=True, cwd=where, env=environment, capture_output=True, text=True)
            print(f"{what:30}{perf_counter() - start:6.1f} s", flush=True)
            if done.returncode or re.search("[Ww]arning:", done.stderr + done.stdout):
                raise SystemExit(f"{command}\n{done.stdout}\n{done.stderr}")


if __name__ == "__main__":
    main()
