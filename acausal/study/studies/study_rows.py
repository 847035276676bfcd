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

# Causes that limit the accuracy of a case.
TOLERANCE, STEP, ELEMENTS, MODEL, REFERENCE = "tolerance", "step", "elements", "model", "reference"
UNKNOWN = "unknown"  # with a single tolerance or step its share of the error cannot be estimated


@dataclass(frozen=True)
class StudyRow:
    """A case compared with the reference.

    Parameters
    ----------
    measurement : Measurement
        Costs and counts.
    errors : mapping of str to (float, float)
        Largest and root mean square error of each output, as fractions of its range.
    limit : str
        Cause that limits the accuracy: "tolerance", "step" (of an integrator with steps of its own), "elements" (too few),
        "model" (the formulation converges to another solution than the reference), "reference" (its uncertainty), or
        "unknown" (a single tolerance or step does not allow an estimate).
    front : bool
        Whether the row is Pareto-optimal: no other case is both faster and more accurate.
    remark : str
        Why the row does not count; "" if it counts.
    """

    measurement: Measurement
    errors: Mapping[str, tuple[float, float]]
    limit: str = ""
    front: bool = False
    remark: str = ""

    @property
    def case(self) -> Case:
        """The case."""
        return self.measurement.case

    @property
    def seconds(self) -> float:
        """Solve time in s."""
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
        Measurements in the order of the rows.
    reference : Reference
        The reference.
    formulations : sequence of Formulation
        Formulations of the study.
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
    """Return the Pareto-optimal rows in time and error, the fastest first.

    Parameters
    ----------
    rows : sequence of StudyRow
        Rows with errors.
    floor : float
        Uncertainty: smaller errors count as equal.
    output : str, optional
        Output whose error counts; the largest error of all outputs if not given.
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
        return replace(row, remark=f"it diverged: the error is {row.error:.1g} times the range")
    return row


def _limit(row: StudyRow, good: Sequence[StudyRow], reference: Reference, forms: Mapping[str, Formulation]) -> str:
    """Return the cause of at least half of the error."""
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
    """Return whether a case converges to the reference: its formulation is exact, and no switch changes the model."""
    made = reference.case
    if made is None:
        return form.exact
    own = {path: value for path, value in case.settings.items() if path not in (*form.settings, *form.refine)}
    return (form.exact or form.name == made.formulation) and all(
        same(made.settings.get(p, v), v) for p, v in own.items()
    )


def _tolerance_error(row: StudyRow, good: Sequence[StudyRow], reference: Reference) -> float | None:
    """Estimate the error due to the tolerance or the step from another run of the same equations; None if there is none."""
    own = row.case.refined(0.0)
    series = sorted((r for r in good if r.case.refined(0.0) == own), key=lambda r: r.case.control)
    if len(series) < 2:
        return None
    if row.case != series[0].case:
        return _between(row, series[0], reference)
    ratio = row.case.control / series[1].case.control
    if row.case.dt is None:
        return _between(row, series[1], reference) * ratio**STUDY.tolerance_power
    # Steps may have been shortened to end at outputs, so the ratio of the step counts is used. First order is assumed, the
    # slowest convergence.
    many, few = (r.measurement.steps for r in series[:2])
    ratio = few / many if few else ratio
    return _between(row, series[1], reference) * (ratio / (1 - ratio) if ratio < 1 else 1.0)


def _elements_error(row: StudyRow, good: Sequence[StudyRow], form: Formulation, reference: Reference) -> float:
    """Estimate the error due to the number of elements from another run of the same formulation."""

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
