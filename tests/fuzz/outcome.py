"""What becomes of a source text: a right result, or an error that says where."""

from __future__ import annotations

import linecache
import re
import resource
import signal
import traceback
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count

import numpy as np

import acausal as ac
from acausal.errors import PACKAGE
from tests.shared import worst_equation

NAMES = count()
# A place: a line of the file, a name in backquotes, a time of the run; or a part.
PLACE = re.compile(r"machine_\d+\.py:\d+|`[^`]+`|\bt = [-\d.e]+ s")
PART = re.compile(r"^ +(\w+)(?:: \w+)? = ", re.M)
SIGNATURE = re.compile(r"\(\) (takes|got|missing) .*argument")
LONGEST, MOST = 30, 2  # s, GB
TOLERANCE = 1e-5
ABSOLUTE = 10 * TOLERANCE  # J, of machines of a joule


class Wrong(AssertionError):
    """Neither a right result nor an error of the user's."""


@contextmanager
def limited(seconds: int = LONGEST) -> Iterator[None]:
    """Raise Wrong after some seconds."""

    def stop(*_: object) -> None:
        raise Wrong(f"longer than {seconds} s")

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def outcome(source: str, stop_time: float = 0.3) -> str:
    """Run a text; return "right" or the message of its error.

    Raises
    ------
    Wrong
        If anything else comes out.
    """
    name = f"machine_{next(NAMES)}.py"
    linecache.cache[name] = (len(source), None, source.splitlines(True), name)
    try:
        with limited(), warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            warnings.simplefilter("ignore", ac.AcausalWarning)
            return _judged(source, name, stop_time)
    except ac.AcausalError as error:
        text, frames = str(error), traceback.extract_tb(error.__traceback__)
        # While a class is made, Python shows its line.
        making = any(frame.filename == name and frame.name in ("Machine", "<module>") for frame in frames)
        if not (making or PLACE.search(text) or any(part in text for part in PART.findall(source))):
            raise Wrong(f"no place in: {type(error).__name__}: {text}\n{source}") from error
        return text
    except Wrong as wrong:
        raise Wrong(f"{wrong}\n{source}") from wrong
    except Exception as error:
        # What Python or another package refuses in the user's line, a name that does not exist or an argument, needs no words
        # of ours.
        frames = [frame.filename for frame in traceback.extract_tb(error.__traceback__)]
        after = frames[len(frames) - frames[::-1].index(name) :] if name in frames else frames
        if not any(PACKAGE in file for file in after) or SIGNATURE.search(str(error)):
            return f"Python: {error}"
        raise Wrong(f"{type(error).__name__}: {error}\n{source}") from error
    finally:
        del linecache.cache[name]


def _judged(source: str, name: str, stop_time: float) -> str:
    space: dict = {"__name__": name.removesuffix(".py")}
    exec(compile(source, name, "exec"), space)
    model = ac.compile(space["Machine"]())
    result = ac.simulate(model, stop_time=stop_time, tolerance=TOLERANCE, intervals=10, energy=True)
    wrong = worst_equation(result, model)
    if not wrong < 1e-9:
        raise Wrong(f"an equation is off by {wrong:.2g}")
    for output in result.outputs:
        if not np.all(np.isfinite(result[output])):
            raise Wrong(f"{output} is not finite")
    if (used := resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20) > MOST:
        raise Wrong(f"{used:.1f} GB of memory")
    lost = abs(float(result.stats.energy_method or 0))
    if not lost <= 100 * TOLERANCE * _energy(model, result) + ABSOLUTE:
        finer = ac.simulate(model, stop_time=stop_time, tolerance=TOLERANCE / 100, intervals=10, energy=True)
        if not abs(float(finer.stats.energy_method or 0)) <= 0.3 * lost:
            raise Wrong(f"energies are off by {lost:.2g} of {_energy(model, result):.2g}, and do not converge")
    return "right"


def _energy(model: ac.CompiledModel, result: ac.Result) -> float:
    """Greatest energy in J that is stored, supplied or dissipated."""
    stored = result._evaluate(model.reduced.flat.energies["stored_energy"])
    s = result.stats
    return float(np.max(np.abs([*stored.ravel(), s.energy_supplied or 0, s.energy_dissipated or 0])))
