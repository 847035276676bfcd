"""The reference of a study: refined until it converges, or read from a file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from acausal.errors import DeclarationError, SimulationError
from acausal.policy import POLICY
from acausal.result.tables import Columns, column_names, read_csv
from acausal.study.measuring.case import Case, Measurement
from acausal.study.measuring.deviation import deviations, worst
from acausal.study.studies.formulation import Formulation

STUDY = POLICY.study

Measure = Callable[[Iterable[Case]], Sequence[Measurement]]


@dataclass(frozen=True)
class Reference:
    """The reference of a study and its uncertainty.

    Parameters
    ----------
    times : array, shape (times,)
        In s.
    values : mapping of str to array, shape (times,)
        Outputs by name.
    agreement : mapping of str to mapping of str to float
        Largest deviation of each output, as a fraction of its range, by what the reference was compared with.
    requested : float
        The requested deviation.
    text : str
        Its origin, for tables.
    case : Case or None
        The case that computed it; None if it was read.
    """

    times: np.ndarray
    values: Mapping[str, np.ndarray]
    agreement: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    requested: float = 0.0
    text: str = ""
    case: Case | None = None

    @property
    def floors(self) -> dict[str, float]:
        """Uncertainty of each output: smaller errors cannot be distinguished."""
        return {name: max((a[name] for a in self.agreement.values()), default=0.0) for name in self.values}

    @property
    def floor(self) -> float:
        """Largest uncertainty of all outputs."""
        return max(self.floors.values(), default=0.0)

    def __str__(self) -> str:
        if not self.agreement:
            return f"reference: {self.text}"
        compared = ", ".join(f"{what} {max(found.values()):.1e}" for what, found in self.agreement.items())
        lines = [f"reference: {self.text}; known to {self.floor:.1e} of the range ({compared})"]
        if self.floor > self.requested:
            lines.append(f"{self.requested:.0e} was requested but not reached: smaller errors cannot be distinguished")
        if len(self.values) > 1:
            lines.append("by output: " + ", ".join(f"{name} {floor:.1e}" for name, floor in self.floors.items()))
        return "\n".join(lines)


def make(
    measure: Measure, formulations: Sequence[Formulation], case: Case, least: float, requested: float
) -> Reference:
    """Compute the reference from the model itself, preferably by formulations that are refined by a tolerance.

    Parameters
    ----------
    measure : callable
        Measures cases in parallel.
    formulations : sequence of Formulation
        Formulations that converge to the same solution; two of them check each other.
    case : Case
        Common settings of all cases.
    least : float
        The tightest tolerance of the study.
    requested : float
        Deviation to be reached, as a fraction of the range.
    """
    start = replace(case, tolerance=max(STUDY.least, least / STUDY.tighter))
    own = [form for form in formulations if not form.dt]
    if not own:
        return _stepped(
            measure, _at(start, formulations[0], formulations[0].steps - 1), min(formulations[0].dt), requested
        )
    formulations = own
    if not any(form.refine for form in formulations):
        return _tightened(measure, _at(start, formulations[0], 0), requested)
    return _refined(measure, [form for form in formulations if form.refine], start, requested)


def read(path: str | Path, outputs: Sequence[str], times: np.ndarray) -> Reference:
    """Read a table in the format of `simulate --csv`.

    Parameters
    ----------
    path : str or Path
        Name of the file: `time`, then outputs.
    outputs : sequence of str
        The compared outputs.
    times : array, shape (times,)
        Times of the study, in s.
    """
    return matching(read_csv(path, "the reference"), outputs, times)


def matching(table: Columns, outputs: Sequence[str], times: np.ndarray) -> Reference:
    """Make a reference from a table.

    Parameters
    ----------
    table : Columns
        The table.
    outputs : sequence of str
        The compared outputs.
    times : array, shape (times,)
        Times of the study, in s.
    """
    missing = [name for name in ("time", *outputs) if name not in table.head]
    if missing and all(map(_is_number, table.head)):
        wanted = ", ".join(("time", *outputs))
        raise DeclarationError(
            f"the first line of {table} must name its columns ({wanted}); it is {column_names(table.head)}."
        )
    if missing:
        raise DeclarationError(
            f"{table} has no column {', '.join(f'`{n}`' for n in missing)}; its columns: {column_names(table.head)}. "
            "Write it by `acausal simulate ... --csv`, or choose outputs."
        )
    own = table.numbers("time")
    if own.shape != times.shape or not np.allclose(own, times, rtol=0, atol=1e-9 * abs(times[-1] - times[0])):
        raise DeclarationError(
            f"{table} has {len(own)} times{f' up to {own[-1]:g} s' if len(own) else ''}, the study {len(times)} "
            f"up to {times[-1]:g} s, equidistant. They must be the same: choose stop time and intervals to fit."
        )
    values = {name: table.numbers(name) for name in outputs}
    return Reference(times, values, text=table.path)


def _refined(measure: Measure, forms: Sequence[Formulation], start: Case, requested: float) -> Reference:
    """Double the sizes and tighten the tolerance until the result converges and two formulations agree."""
    state, best = _State(tuple(forms), start.tolerance), None
    for _ in range(STUDY.rounds):
        now, state, why = _compared(measure, state, start, requested)
        if now is not None and (best is None or now.floor < best.floor):
            best = now
        if why or (best is not None and best.floor <= requested):
            return _finished(best, why)
    return _finished(best, f"{STUDY.rounds} refinements were tried")


@dataclass(frozen=True)
class _State:
    """State of the refinement: remaining formulations, tolerance, and doublings of the finest sizes."""

    forms: tuple[Formulation, ...]
    tolerance: float
    level: int = 0


def _compared(measure: Measure, state: _State, start: Case, requested: float) -> tuple[Reference | None, _State, str]:
    """Compare with coarser elements, another formulation and a looser tolerance.

    Returns the reference, None if all runs failed; the next refinement; and why the refinement has to end, or "".
    """
    case, n = replace(start, tolerance=state.tolerance), len(state.forms)
    coarse = [_at(case, form, max(0, form.steps - 2 + state.level)) for form in state.forms]
    fine = [_at(case, form, form.steps - 1 + state.level) for form in state.forms]
    runs = measure([*coarse, *fine])
    pairs = [(a, b, form) for a, b, form in zip(runs[:n], runs[n:], state.forms, strict=True) if not a.error + b.error]
    if not pairs:
        return None, state, _failed(runs)
    # Keep the two that change least: they converge fastest.
    pairs = sorted(pairs, key=lambda pair: worst(pair[0].values, pair[1].values))[:2]
    coarser, best, _ = pairs[0]
    # At the maximum number of elements there is no coarser run to compare with.
    agreement = {"coarser elements": _distances(coarser, best)} if coarser.case != best.case else {}
    agreement |= {other.case.formulation: _distances(other, best) for _, other, _ in pairs[1:]}
    elements = max((max(found.values()) for found in agreement.values()), default=0.0)
    looser = measure([replace(best.case, tolerance=STUDY.tighter * state.tolerance)])[0]
    if looser.error:
        return None, state, _failed([looser])
    agreement["looser tolerance"] = _distances(looser, best)
    tolerance = max(agreement["looser tolerance"].values())
    forms = tuple(form for *_, form in pairs)
    why = _failed(runs) if len(forms) < min(n, 2) else ""
    tighten = tolerance > max(requested, elements / 3) and state.tolerance / STUDY.tighter >= STUDY.least
    if not tighten and all(a.case == b.case for a, b, _ in pairs):
        why = why or "the maximum number of elements is reached"
    after = (
        _State(forms, state.tolerance / STUDY.tighter, state.level)
        if tighten
        else _State(forms, state.tolerance, state.level + 1)
    )
    return _reference(best, agreement, requested), after, why


def _finished(found: Reference | None, why: str) -> Reference:
    """Note why the refinement ended early, or raise SimulationError without a result."""
    if found is None:
        raise SimulationError(f"there is no reference: {why}. Give one by reference=, or other formulations.")
    return replace(found, text=f"{found.text} ({why})") if why else found


def _tightened(measure: Measure, case: Case, requested: float) -> Reference:
    """Tighten the tolerance of a model without elements, and check by another method."""
    found, best, looser = (
        None,
        measure([case])[0],
        measure([replace(case, tolerance=STUDY.tighter * case.tolerance)])[0],
    )
    why = ""
    for _ in range(STUDY.rounds):
        if best.error or looser.error:
            why = _failed([best, looser])
            break
        found = _reference(best, {"looser tolerance": _distances(looser, best)}, requested)
        tolerance = best.case.tolerance / STUDY.tighter
        if found.floor <= requested or tolerance < STUDY.least:
            break
        looser, best = best, measure([replace(best.case, tolerance=tolerance)])[0]
    return _checked(measure, _finished(found, why), looser if best.error else best)


def _stepped(measure: Measure, case: Case, dt: float, requested: float) -> Reference:
    """Halve the steps of a formulation with steps of its own."""
    found, why = None, ""
    longer, best = measure([replace(case, dt=dt), replace(case, dt=dt / 2)])
    for _ in range(STUDY.rounds):
        if longer.error or best.error:
            why = _failed([longer, best])
            break
        found = _reference(best, {"longer steps": _distances(longer, best)}, requested)
        if found.floor <= requested:
            break
        longer, best = best, measure([best.case.refined(best.case.control / 2)])[0]
    return _finished(found, why)


def _checked(measure: Measure, found: Reference, best: Measurement) -> Reference:
    """Compare a reference by `simulate` with the other treatment of loops, or with the other integrator."""
    if best.case.run is not None:
        return found
    if best.constraints in ("states", "projection"):
        name = "projection" if best.constraints == "states" else "states"
        other = measure([replace(best.case, constraints=name)])[0]
    else:
        name = "idas" if best.method == "rosenbrock" else "rosenbrock"
        other = measure([replace(best.case, method=name)])[0]
    if other.error:
        return replace(found, text=f"{found.text} (no check by {name}: {other.error})")
    return replace(found, agreement={**found.agreement, name: _distances(other, found)})


def _distances(one: Measurement, other: Measurement | Reference) -> dict[str, float]:
    return {name: most for name, (most, _) in deviations(one.values, other.values).items()}


def _reference(best: Measurement, agreement: Mapping[str, Mapping[str, float]], requested: float) -> Reference:
    return Reference(best.times, best.values, agreement, requested, str(best.case), best.case)


def _at(case: Case, form: Formulation, step: int) -> Case:
    settings, size = form.at(step)
    return replace(case, formulation=form.name, settings={**case.settings, **settings}, size=size, run=form.run)


def _failed(now: Sequence[Measurement]) -> str:
    failed = next(m for m in now if m.error)
    return f"{failed.case}: {failed.error}"


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
