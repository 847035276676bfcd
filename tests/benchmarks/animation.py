"""What moving pictures cost: python -m tests.benchmarks.animation prints the table of docs/how-to/animate.md.

Seconds are processor time of the first picture of a result, memory is what writing takes beyond what the result has.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

RUNS = {
    "`slider-crank`, 401 outputs": ("SliderCrank()", {}),
    "`spin-up`, 40 volumes, 401 outputs": ("SpinUp(volumes=40)", {}),
    "`slider-crank`, 20,001 outputs": ("SliderCrank()", {"intervals": 20_000}),
}


def measured(name: str, values: list[str]) -> tuple[int, float, float, float]:
    """Return frames, size of the file in MB, seconds and memory in MB; alone in its process."""
    import acausal as ac
    from acausal.animation.frames import select_frames
    from models import SliderCrank, SpinUp

    warnings.simplefilter("ignore")
    made = {"SliderCrank()": SliderCrank, "SpinUp(volumes=40)": lambda: SpinUp(volumes=40)}
    model, how = RUNS[name]
    result = ac.simulate(made[model](), **how)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "run.html"
        Path("/proc/self/clear_refs").write_text("5")  # the peak of memory counts from here on
        before, begun = _memory("VmRSS"), time.process_time()
        result.animate(file, values=values)
        seconds = time.process_time() - begun
        return len(select_frames(result.time)), file.stat().st_size / 1e6, seconds, _memory("VmHWM") - before


def _memory(name: str) -> float:
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(name)) / 1024


def main() -> None:
    """Print the table, each case in a process of its own."""
    if len(sys.argv) > 1:
        print(*measured(sys.argv[1], sys.argv[2:]))
        return
    print("| run | frames | file | s | MB | with all `values`: file | s | MB |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for name in RUNS:
        cells = []
        for values in ([], ["all"]):
            command = [sys.executable, "-m", "tests.benchmarks.animation", name, *values]
            frames, size, seconds, memory = subprocess.run(
                command, capture_output=True, text=True, check=True
            ).stdout.split()
            cells += [f"{float(size):.2f} MB", f"{float(seconds):.2f}", f"{float(memory):.0f}"]
        print(f"| {name} | {int(frames):,} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
