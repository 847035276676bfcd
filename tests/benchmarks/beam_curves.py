"""Curves of docs/background/beams.md: one linear finite-element beam against a substructured one on the spin-up.

python -m tests.benchmarks.beam_curves docs/pictures/spin-up-stiffening.png
"""

from __future__ import annotations

import sys

from matplotlib.figure import Figure

import acausal as ac
from models import SpinUp


def main(path: str) -> None:
    """Simulate at 2 and 4 rad/s with both formulations and write the picture."""
    figure = Figure(figsize=(8, 3.6), layout="constrained")
    for axes, omega in zip(figure.subplots(1, 2), (2.0, 4.0), strict=True):
        for formulation, label in (("substructured", "20 volumes"), ("fem", "one linear beam")):
            model = SpinUp(formulation=formulation, volumes=20 if formulation == "substructured" else 5, omega=omega)
            stop = 10.3 if formulation == "fem" and omega > 3 else 20.0
            result = ac.simulate(model, stop_time=stop, tolerance=1e-8)
            deflection = result["tip_deflection"]
            print(
                f"omega {omega:g}, {label}: smallest tip deflection {deflection.min():.4f} m, last {deflection[-1]:.3f} m"
            )
            axes.plot(result.time, deflection, label=label)
        axes.set(title=f"{omega:g} rad/s", xlabel="time [s]", ylabel="tip deflection [m]", ylim=(-1.5, 1.0))
        axes.grid(alpha=0.5)
        axes.legend()
    figure.savefig(path, dpi=150)


if __name__ == "__main__":
    main(sys.argv[1])
