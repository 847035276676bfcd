"""Campbell diagram of the blade: frequencies in the turning frame over the speed of the hub.

python -m tests.benchmarks.campbell docs/pictures/blade-campbell.png
"""

from __future__ import annotations

import sys

import matplotlib.pyplot as plt
import numpy as np

import acausal as ac
from models import Blade

SPEEDS = np.linspace(1, 60, 25)
MODES = 5


def main(path: str) -> None:
    """Draw the first frequencies, and the multiples of the speed that gravity and wind excite."""
    model = ac.compile(Blade())
    found = [ac.linearize(model, parameters={"speed": speed}).frequencies_hz[:MODES] for speed in SPEEDS]
    turns = SPEEDS / (2 * np.pi)
    figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
    axes.plot(turns * 60, np.array(found), color="C0")
    for multiple in range(1, 7):
        axes.plot(turns * 60, multiple * turns, color="0.7", linewidth=0.8)
        axes.annotate(f"{multiple}P", (turns[-1] * 60, multiple * turns[-1]), color="0.5", fontsize=8)
    axes.set(
        xlabel="speed in 1/min", ylabel="frequency in Hz", xlim=(0, turns[-1] * 63), ylim=(0, np.max(found) * 1.05)
    )
    figure.savefig(path, dpi=110)
    for speed, row in zip(SPEEDS[[0, 12, -1]], np.array(found)[[0, 12, -1]], strict=True):
        print(f"{speed:5.1f} rad/s:", *(f"{f:.3f}" for f in row))


if __name__ == "__main__":
    main(*sys.argv[1:])
