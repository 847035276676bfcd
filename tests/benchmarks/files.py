"""Project files that a run of a compiled model enters: a smooth open chain, and a ball that bounces.

    python -m tests.benchmarks.files

Prints the number of files for a first and for a repeated run.
"""

from __future__ import annotations

import sys
import warnings
from pathlib import Path
from types import FrameType
from typing import Any

import acausal as ac
import models
from tests.benchmarks.events import measure as events

PROJECT = Path(ac.__file__).parent


def entered(compiled: Any, **how: Any) -> set[str]:
    """Return the files of the project whose functions a run calls."""
    found = set[str]()

    def note(frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_code.co_filename.startswith(str(PROJECT)):
            found.add(frame.f_code.co_filename)

    sys.setprofile(note)
    try:
        ac.simulate(compiled, **how)
    finally:
        sys.setprofile(None)
    return found


def main() -> None:
    """Print the counts."""
    ball = next(one for one in events.SCENES if one.name == "ball")
    warnings.simplefilter("ignore")
    for name, make, how in (
        ("simple-pendulum", models.SCENES["simple-pendulum"], {}),
        ("ball", ball.make, ball.span(False)),
    ):
        compiled = ac.compile(make())
        print(
            f"{name}: {len(entered(compiled, **how))} files in the first run, {len(entered(compiled, **how))} in the next"
        )


if __name__ == "__main__":
    main()
