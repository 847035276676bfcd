"""Rows of a study: the error of a case, its cost, and the cause of its error."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from acausal.language.data import same
from acausal.policy import POLICY
from acausal.study.measuring.case import Case, Measurement
from acausal.study.measuring.deviation import deviations, worst
from acausal.study.studies.formulation import Formulation
from acausal.study.studies.reference import Reference

STUDY = POLICY.study

# What limits the accuracy of a case.
TOLERANCE, STEP, ELEMENTS, MODEL, REFERENCE = "tolerance", "step", "elements", "model", "reference"
UNKNOWN = "unknown"  # a single tolerance or step tells nothing about its part


@dataclass(frozen=True)
class StudyRow:
    """A case against the reference.

    Parameters
    ----------
    measurement : Measurement
        Costs and counts.
    errors : mapping of str to (float, float)
        Largest and root mean square error of each output, as fractions of its range.
    limit : str
        What limits the accuracy: "tolerance", "step" (of a run with steps of its own), "elements" (of which there are too
        few), "model" (the formulation has another limit than the reference), "reference" (which is not known better), or
        "unknown" (one of them, but with a single tolerance or step nothing tells which).
    front : bool
        Whether no other case is both faster and more accurate.
    remark : str
        Why it does not count; "" if it does.
    """

    measurement: Measurement
    errors: Mapping[str, tuple[float, float]]
    limit: str = ""
    front: bool = False
    remark: str = ""

    @property
    def case(self) -> Case:
        """What was run."""
        return self.measurement.case

    @property
    def seconds(self) -> float:
        """Solve time."""
        return self.measurement.solve_seconds

    @property
    def error(self) -> float:
        """Largest error of all outputs."""
        return max((most for most, _ in self.errors.values()), default=np.nan)

    def error_of(self, output: str | None) -> float:
        """Return the largest error of an output, or of all.

        Parameters
        ----------
        output : str or None
            Name of the output.
        """
        return self.error if output is None else self.errors[output][0]

    @property
    def rms(self) -> float:
        """Largest root mean square error of all outputs."""
        return max((mean for _, mean in self.errors.values()), default=np.nan)


def rows_of(
    measurements: Sequence[Measurement], reference: Reference, formulations: Sequence[Formulation]
) -> tuple[StudyRow, ...]:
    """Compare measurements with the reference.

    Parameters
    ----------
    measurements : sequence of Measurement
        In the order of the rows.
    reference : Reference
        What is right.
    formulations : sequence of Formulation
        Those of the study.
    """
    rows = [_compared(m, reference) for m in measurements]
    good = [row for row in rows if not row.remark]
    forms = {form.name: form for form in formulations}
    front = {row.case for row in pareto(good, reference.floor)}
    return tuple(
        row if row.remark else replace(row, limit=_limit(row, good, reference, forms), front=row.case in front)
        for row in rows
    )


def pareto(rows: Sequence[StudyRow], floor: float = 0.0, output: str | None = None) -> list[StudyRow]:
    """Return the rows that no other one beats in time and error, the fastest first.

    Parameters
    ----------
    rows : sequence of StudyRow
        With errors.
    floor : float
        Errors below it cannot be distinguished.
    output : str, optional
        Whose error; the largest of all outputs if not given.
    """
    known = {row.case: max(row.error_of(output), floor) for row in rows}
    best: list[StudyRow] = []
    for row in sorted(rows, key=lambda r: (r.seconds, known[r.case])):
        if not best or known[row.case] < known[best[-1].case]:
            best.append(row)
    return best


def _compared(m: Measurement, reference: Reference) -> StudyRow:
    if m.error:
        return StudyRow(m, {}, remark=m.error)
    row = StudyRow(m, deviations(m.values, reference.values))
    if row.error > STUDY.runaway:
        return replace(row, remark=f"it diverged: {row.error:.1g} times the range away from the reference")
    return row


def _limit(row: StudyRow, good: Sequence[StudyRow], reference: Reference, forms: Mapping[str, Formulation]) -> str:
    """Return the cause of the error: at least half of it must come from there."""
    half, form = row.error / 2, forms[row.case.formulation]
    exact = _has_its_limit(row.case, form, reference)
    if reference.floor > half:
        return REFERENCE
    steps = row.case.dt is not None
    accuracy, by_accuracy = STEP if steps else TOLERANCE, _tolerance_error(row, good, reference)
    if by_accuracy is not None and by_accuracy > half:
        return accuracy
    known = by_accuracy is not None or (not steps and STUDY.most * row.case.tolerance <= half)
    if form.refine and ((exact and known) or _elements_error(row, good, form, reference) > half):
        return ELEMENTS
    if not known:
        return accuracy if exact and not form.refine else UNKNOWN
    return REFERENCE if exact else MODEL


def _has_its_limit(case: Case, form: Formulation, reference: Reference) -> bool:
    """Whether a case comes to the reference in the limit: an exact formulation, and no switch that changes the model."""
    made = reference.case
    if made is None:
        return form.exact
    own = {path: value for path, value in case.settings.items() if path not in (*form.settings, *form.refine)}
    return (form.exact or form.name == made.formulation) and all(
        same(made.settings.get(p, v), v) for p, v in own.items()
    )


def _tolerance_error(row: StudyRow, good: Sequence[StudyRow], reference: Reference) -> float | None:
    """Estimate what the tolerance or the step does, from the same equations at another one; None where there is no other."""
    own = row.case.refined(0.0)
    series = sorted((r for r in good if r.case.refined(0.0) == own), key=lambda r: r.case.control)
    if len(series) < 2:
        return None
    if row.case != series[0].case:
        return _between(row, series[0], reference)
    ratio = row.case.control / series[1].case.control
    if row.case.dt is None:
        return _between(row, series[1], reference) * ratio**STUDY.tolerance_power
    # Of steps that were shortened, so that outputs lie at their ends, the numbers tell the ratio. Their error is taken to go
    # with the step, the slowest way in which it does.
    many, few = (r.measurement.steps for r in series[:2])
    ratio = few / many if few else ratio
    return _between(row, series[1], reference) * (ratio / (1 - ratio) if ratio < 1 else 1.0)


def _elements_error(row: StudyRow, good: Sequence[StudyRow], form: Formulation, reference: Reference) -> float:
    """Estimate what the number of elements does, from the same formulation with another one."""

    def family(case: Case) -> Case:
        settings = {path: value for path, value in case.settings.items() if path not in form.refine}
        return replace(case, size="", settings=settings)

    own = family(row.case)
    series = sorted((r for r in good if family(r.case) == own), key=lambda r: -r.measurement.equations)
    if len(series) < 2:
        return 0.0
    if row.case != series[0].case:
        return _between(row, series[0], reference)
    return _between(row, series[1], reference) * STUDY.elements_share


def _between(one: StudyRow, other: StudyRow, reference: Reference) -> float:
    return worst(one.measurement.values, other.measurement.values, reference.values)
