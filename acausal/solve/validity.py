"""Whether a model is right where it is used: what must hold at the start, and what it neglects in a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.call import Call
from acausal.compiler.requirements import Stated, refuse, statements
from acausal.errors import InitializationError
from acausal.language.functions import initial, time
from acausal.language.validity import Expectation, Separation
from acausal.solve.evaluator import Evaluator
from acausal.solve.instant import Point

# Most output points that are looked at, and where each look costs a solution of the equations.
ROWS, DEAR = 500, 40
# Numbers of points for which a function is kept.
KEPT = 8


@dataclass(frozen=True)
class Watch:
    """Statements of a compiled model, and the function that evaluates them at one point."""

    stated: list[Any]
    function: ca.Function
    wanted: set[int]

    def along(self, maps: dict[int, Call], *values: np.ndarray) -> np.ndarray:
        """Evaluate at many points: x, z, parameters, times, modes."""
        x, z, p, t, modes = values
        n = len(t)
        if n not in maps:
            if len(maps) == KEPT:
                maps.clear()
            maps[n] = Call(self.function.map(n))
        call = maps[n]
        return call(x.ravel(), z.ravel(), np.tile(p, n), t, modes.ravel())[0].reshape(n, -1)


def watch(compiled: CompiledModel, stated: list[Any], entries: list[ca.SX]) -> Watch:
    """Make the function of expressions in symbols of the model, one row of the result for each point."""
    r = compiled.reduced
    column = ca.substitute(r.resolve(ca.vertcat(ca.SX(0, 1), *entries)), initial.sx, 0)
    arguments = [r.x, r.z, r.flat.parameters, time.sx, r.modes]
    return Watch(stated, ca.Function("watch", arguments, [ca.densify(column)]), compiled.dependence.inside(column))


def _validity(compiled: CompiledModel) -> list[Stated]:
    return statements(compiled.tree, "validity", (Expectation, Separation))


def separations(compiled: CompiledModel) -> tuple[Watch, dict[int, Call]]:
    """What must not meet in a run: rate, effect and offset of each, in turn."""
    if "separations" not in compiled.cache:
        stated = [item for item in _validity(compiled) if isinstance(item[0], Separation)]
        entries = [e.sx for s, _ in stated for e in (s.rate, s.effect, s.offset)]
        compiled.cache["separations"] = watch(compiled, stated, entries), {}
    return compiled.cache["separations"]


def check_start(compiled: CompiledModel, at: Point, p: np.ndarray) -> None:
    """Raise InitializationError if variables break a requirement at the start."""
    key = "start requirements"
    if key not in compiled.cache:
        stated = compiled.requirements.at_start
        compiled.cache[key] = watch(compiled, stated, [r.sx for r, _ in stated]), {}
    found, maps = compiled.cache[key]
    if found.stated:
        row = found.along(maps, at.x, at.z, p, np.array([at.time]), at.modes)[0]
        refuse(found.stated, row, InitializationError)


def doubts(compiled: CompiledModel, run: Evaluator) -> list[str]:
    """Say what components neglected although it was not small; at most ROWS of the points are looked at.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    run : Evaluator
        Its output points.
    """
    if "validity" not in compiled.cache:
        stated = [item for item in _validity(compiled) if isinstance(item[0], Expectation)]
        entries = [e.sx for s, _ in stated for e in (s.part, s.whole)]
        compiled.cache["validity"] = watch(compiled, stated, entries), {}
    seen, maps = compiled.cache["validity"]
    if not seen.stated:
        return []
    rows = np.unique(np.linspace(0, len(run.t) - 1, min(len(run.t), DEAR if seen.wanted else ROWS)).astype(int))
    x, t, modes = run.x[rows], run.t[rows], run.modes[rows]
    z = run.solver(x, run.z[rows], t, modes, seen.wanted)
    run.solver.unsolved.clear()
    values = np.abs(seen.along(maps, x, z, run.solver.p, t, modes))
    found = []
    for (expectation, origin), part, whole in zip(seen.stated, values.T[::2], values.T[1::2], strict=True):
        part = np.where(np.isnan(part), 0.0, part)
        so_far = np.fmax.accumulate(np.nan_to_num(whole))
        over = part > expectation.share * so_far
        if np.max(part) > expectation.share * so_far[-1]:
            most = float(np.max(part)) / so_far[-1] if so_far[-1] > 0 else 1.0
            worst = f"up to {100 * most:.2g} %" if most < 1 else "as much as all"
            found.append(f"{origin}: {expectation.text} ({worst} of it, from t = {t[over][0]:.4g} s on)")
    return found
