"""Tables of docs/background/accuracy-tables.md and their pictures: accuracy and computing time, effects and their cost.

    OPENBLAS_NUM_THREADS=1 python -m tests.benchmarks.accuracy [SECTION]...

Each section of the document between `<!-- NAME -->` and `<!-- end -->` is made anew, all of them if none is named.
"""

from __future__ import annotations

import re
import sys
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd

import acausal as ac
from acausal import Formulation, Model, chain, fixed, part
from acausal.study import Study
from components import Body, FlexibleBeam, Revolute, World
from models import FEPlate, FlexiblePendulum, FreeVibration, SliderCrank, SpinUp

DOCUMENT = Path("docs/background/accuracy-tables.md")
PICTURES = Path("docs/pictures")
STIFFENED = {"formulation": "fem", "beam.geometric_stiffness": True}
BEAM: dict[str, Any] = {"length": 0.5, "E": 1e7, "rho": 1000.0, "A": 1e-3, "J": 1e-7}
DAMPED = {"alpha": 1.0, "beta": 1e-4}
# Values other than those of the scene `Swing`.
SWITCHED: Sequence[tuple[str, Any]] = (
    ("beam.axial", "quasi_static"),
    ("beam.axial", "none"),
    ("beam.bending", "none"),
    ("beam.bending", "xy"),
    ("beam.torsion", False),
    ("beam.shear", True),
    ("beam.centrifugal", False),
    ("beam.coriolis", False),
    ("beam.damping", False),
    ("beam.weight", False),
    ("beam.rotary_inertia", True),
    ("beam.geometric_stiffness", True),
    ("hinge.friction", False),
    ("tip.gyroscopic", False),
    ("world.gravity", None),
    ("stand.n", (0, 0, 1)),
)


class Swing(Model):
    """Damped beam on a hinge with friction, with a body at its tip, that moves in space."""

    world = World()
    stand = Revolute(n=(0, 1, 0), phi=fixed(0), w=fixed(1))
    hinge = Revolute(d=0.1, phi=fixed(0), w=fixed(0))
    tip = Body(m=0.1, I=((1e-4, 0, 0), (0, 2e-4, 0), (0, 0, 3e-4)))

    @part
    def beam(self):
        return FlexibleBeam(elements=4, **BEAM, **DAMPED)

    def connections(self):
        yield chain(self.world, self.stand, self.hinge, self.beam, self.tip)


def spin_up() -> str:
    return _scene(SpinUp(omega=4), "spin-up")


def pendulum() -> str:
    return _scene(FlexiblePendulum(), "pendulum")


def free_vibration() -> str:
    return _scene(FreeVibration(), "free-vibration")


def slider_crank() -> str:
    return _scene(SliderCrank(), "slider-crank", ("slider_position", "rod_mid_deflection"))


def fe_plate() -> str:
    """Every case, as methods are compared here."""
    found = ac.study(FEPlate())
    found.plot(PICTURES / "accuracy-fe-plate.png")
    lines = "\n".join(f"- {line}" for line in [*found.price(), *found.gaps()])
    return f"{_sentence(str(found.reference))}\n\n{_table(found, found.rows)}\n\n{lines}"


def order() -> str:
    """Limits of the order on the spin-up."""
    forms = [Formulation("volumes, stiffened", {"beam.geometric_stiffness": True}, {"volumes": (5,)}, exact=True)]
    how: dict[str, Any] = {"tolerances": (1e-4, 1e-5, 1e-6), "max_orders": (1, 2, 3, 5), "limit": 20.0}
    found = ac.study(SpinUp(omega=4), formulations=forms, reference=_exact(), **how)
    return _table(found, found.rows)


def one_step() -> str:
    """The one-step method on the spin-up."""
    forms = [Formulation("one frame, stiffened", STIFFENED, {"volumes": (5,)})]
    how: dict[str, Any] = {"methods": ("idas", "rosenbrock"), "parameters": {"beam.axial": "quasi_static"}}
    found = ac.study(SpinUp(omega=4), formulations=forms, reference=_exact(), **how)
    return _table(found, found.rows)


def axial() -> str:
    """Stretch of the axis on the spin-up."""
    forms = [Formulation("one frame, stiffened", STIFFENED, {"volumes": (5,)})]
    switches = {"beam.axial": ("dynamic", "quasi_static", "none")}
    how: dict[str, Any] = {"tolerances": (1e-4, 1e-6, 1e-7), "outputs": ("tip_deflection", "tip_extension")}
    found = ac.study(SpinUp(omega=4), formulations=forms, switches=switches, reference=_exact(), **how)
    head = ("stretch", "tolerance", "unknowns", "steps", "factorisations", "ms", "tip_deflection", "tip_extension")
    rows = []
    for row in found.rows:
        m, errors = row.measurement, [f"{row.error_of(name):.1e}" for name in ("tip_deflection", "tip_extension")]
        counts = (m.equations, m.steps, m.factorisations, f"{1e3 * row.seconds:.3g}")
        rows.append((row.case.settings["beam.axial"], f"{row.case.tolerance:.0e}", *counts, *errors))
    return _markdown(head, rows)


def growth() -> str:
    """Cost of the spin-up over the number of volumes."""
    sizes = (5, 10, 20, 40, 80)
    forms = [Formulation("volumes", {}, {"volumes": sizes}, exact=True)]
    found = ac.study(SpinUp(omega=4), formulations=forms, tolerances=(1e-6,), reference=_exact(), repeats=5)
    head = (
        "volumes",
        "unknowns",
        "compile s",
        "solve ms",
        "steps",
        "factorisations",
        "µs per step",
        "µs per step and volume",
    )
    rows = []
    for size, row in zip(sizes, found.rows, strict=True):
        m, step = row.measurement, 1e6 * row.seconds / row.measurement.steps
        counts = (m.equations, f"{m.compile_seconds:.2f}", f"{1e3 * row.seconds:.3g}", m.steps, m.factorisations)
        rows.append((size, *counts, f"{step:.3g}", f"{step / size:.2g}"))
    return _markdown(head, rows)


def effects() -> str:
    """Effects of the slider-crank."""
    found = ac.effects(SliderCrank(), stop_time=SliderCrank.stop_time, accuracy=1e-2)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "effects.md"
        found.to_markdown(path)
        return re.sub(r"^#+ (.*)$", r"**\1**", path.read_text(), flags=re.MULTILINE).strip()


def counts() -> str:
    """What is gone when an effect is off."""
    head = ("switch", "equations", "integrated", "states", "operations", "nonzeros")
    names = ("equations_flat", "equations_reduced", "operations", "jacobian_nonzeros")
    rows = []
    for path, value in (("", ""), *SWITCHED):
        compiled = ac.compile(Swing(), parameters={path: value} if path else None)
        flat, reduced, operations, nonzeros = (compiled.report[name] for name in names)
        switch = f"`{path}={value}`" if path else "as it stands"
        rows.append((switch, flat, reduced, compiled.nx, operations, nonzeros))
    return _markdown(head, rows)


SECTIONS: Mapping[str, Callable[[], str]] = {
    "spin-up": spin_up,
    "order": order,
    "one-step": one_step,
    "axial": axial,
    "growth": growth,
    "pendulum": pendulum,
    "free-vibration": free_vibration,
    "slider-crank": slider_crank,
    "fe-plate": fe_plate,
    "effects": effects,
    "counts": counts,
}


def _scene(model: Model, name: str, outputs: Sequence[str] = ()) -> str:
    """Study of a scene: its best points and its picture; the reference is kept for other sections."""
    found = ac.study(model, outputs=outputs)
    found.plot(PICTURES / f"accuracy-{name}.png")
    known = found.reference
    pd.DataFrame({"time": known.times, **known.values}).to_csv(_kept(name), index=False)
    price = "\n".join(f"- {line}" for line in found.price())
    return f"{_sentence(str(known))}\n\n{_table(found, found.best)}\n\n{price}"


def _sentence(text: str) -> str:
    return ". ".join(f"{line[:1].upper()}{line[1:]}" for line in text.splitlines()) + "."


def _table(found: Study, rows: Iterable[Any]) -> str:
    from acausal.study.studies.study_table import cells

    chosen = [replace(row, front=False) for row in rows]
    return cells(chosen, found.reference, found.switches).markdown()


def _kept(name: str) -> Path:
    return Path(tempfile.gettempdir()) / f"accuracy-{name}.csv"


def _exact() -> Path:
    """The reference of the spin-up, made where it is missing."""
    if not _kept("spin-up").exists():
        spin_up()
    return _kept("spin-up")


def _markdown(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


def main(names: Sequence[str]) -> None:
    """Make sections of the document anew."""
    unknown = [name for name in names if name not in SECTIONS]
    if unknown:
        sys.exit(f"there is no section {', '.join(unknown)}; sections: {', '.join(SECTIONS)}")
    for name in names or SECTIONS:
        print(name, flush=True)
        made = SECTIONS[name]()
        text = DOCUMENT.read_text()
        pattern = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end -->)", re.DOTALL)
        if not pattern.search(text):
            sys.exit(f"{DOCUMENT} has no section {name}")
        DOCUMENT.write_text(pattern.sub(lambda found, made=made: f"{found[1]}\n{made}\n\n{found[2]}", text))


if __name__ == "__main__":
    main(sys.argv[1:])
