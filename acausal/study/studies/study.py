"""study(): accuracy against time of the formulations and numerics of a model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from acausal.compiler import CompiledModel, checked_model, checked_values, compile
from acausal.errors import DeclarationError
from acausal.flatten.instantiate import Instantiation
from acausal.language.call_arguments import checked_arguments
from acausal.language.component import Component
from acausal.policy import POLICY
from acausal.result import check_writable
from acausal.result.files import whole
from acausal.result.plots import save
from acausal.result.tables import read_csv, wrapped, write_csv
from acausal.simulation.inputs import with_inputs
from acausal.simulation.settings_checks import check_choice
from acausal.study.measuring.case import Case, Job
from acausal.study.measuring.journal import Journal, identity
from acausal.study.measuring.model_pickling import pack
from acausal.study.measuring.pool import executor_of
from acausal.study.measuring.run_function import check_sendable
from acausal.study.measuring.session import Progress, Session
from acausal.study.measuring.study_arguments import (
    check_counts,
    check_run,
    check_shares,
    items,
    outputs_of,
    stop_time_of,
    table_of,
)
from acausal.study.studies.formulation import Formulation, formulations_of, within
from acausal.study.studies.grid import TOLERANCES, Grid
from acausal.study.studies.picture import draw
from acausal.study.studies.reference import Reference, make, matching
from acausal.study.studies.study_rows import MODEL, StudyRow, pareto, rows_of
from acausal.study.studies.study_table import cells, columns

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Study:
    """The result of a study: all cases compared with the reference.

    Parameters
    ----------
    title : str
        Name of the model.
    rows : tuple of StudyRow
        One row for each case.
    reference : Reference
        The reference and its uncertainty.
    switches : tuple of str
        Paths varied besides the formulation.
    """

    title: str
    rows: tuple[StudyRow, ...]
    reference: Reference
    switches: tuple[str, ...] = ()

    @property
    def best(self) -> list[StudyRow]:
        """The Pareto-optimal rows in time and error, the fastest first."""
        return pareto([row for row in self.rows if not row.remark], self.reference.floor)

    @property
    def columns(self) -> dict[str, list[Any]]:
        """All figures by the names of the columns of the CSV file."""
        return columns(self.rows, self.switches)

    def table(self) -> str:
        """Return reference, cases, the cost of each digit and model errors as text for a terminal."""
        table = cells(self.rows, self.reference, self.switches).text(narrow=True)
        reference, findings = wrapped(str(self.reference).splitlines()), wrapped([*self.price(), *self.gaps()])
        return "\n\n".join([self.title, reference, table, findings])

    def price(self) -> list[str]:
        """Return the cost of each digit: a line with the fastest case within each power of ten of the error."""
        lines = []
        for power in range(-1, -13, -1):
            within = [row for row in self.best if row.error <= 10.0**power]
            if not within or self.reference.floor > 10.0**power:
                break
            lines.append(f"an error of {10.0**power:.0e} costs {1e3 * within[0].seconds:.3g} ms: {within[0].case}")
        return lines

    def gaps(self) -> list[str]:
        """Return the model error of formulations that do not converge to the reference, a line each."""
        lines = []
        for name in dict.fromkeys(row.case.formulation for row in self.rows):
            own = [row for row in self.rows if row.case.formulation == name and not row.remark]
            least = min(own, key=lambda row: row.error, default=None)
            if least is not None and least.limit == MODEL:
                lines.append(
                    f"{name}: converges to another solution; its smallest error is {least.error:.1e} of the range"
                )
        return lines

    def document(self) -> dict[str, Any]:
        """Return everything as data for JSON."""
        known, table = self.reference, self.columns
        described = {
            "text": known.text,
            "agreement": known.agreement,
            "asked": known.requested,
            "known_to": known.floors,
        }
        rows = [dict(zip(table, row, strict=True)) for row in zip(*table.values(), strict=True)]
        return {"model": self.title, "reference": described, "rows": rows}

    def to_csv(self, path: str | Path) -> None:
        """Write all columns of all cases.

        Parameters
        ----------
        path : str or Path
            Name of the file.
        """
        write_csv(path, self.columns)

    def to_markdown(self, path: str | Path) -> None:
        """Write reference, cases, the cost of each digit and model errors as Markdown.

        Parameters
        ----------
        path : str or Path
            Name of the file.
        """
        table = cells(self.rows, self.reference, self.switches).markdown()
        price = "\n".join(f"- {line}" for line in [*self.price(), *self.gaps()])
        with whole(path) as file:
            file.write("\n\n".join([str(self.reference), table, price]).strip() + "\n")

    def plot(self, path: str | Path | None = None, output: str | None = None) -> Figure:
        """Draw error over time, both logarithmic.

        Parameters
        ----------
        path : str or Path, optional
            Write the picture there; the suffix determines the format.
        output : str, optional
            Output whose error is drawn; the largest error of all outputs if not given.
        """
        figure = draw(self.rows, self.reference, self.title, output)
        if path is not None:
            save(figure, path)
        return figure


@checked_arguments
def study(
    model: Component,
    *,
    stop_time: float | None = None,
    parameters: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Any] | None = None,
    outputs: Sequence[str] = (),
    formulations: Sequence[Formulation] | None = None,
    tolerances: Sequence[float] = TOLERANCES,
    max_orders: Sequence[int | None] = (None,),
    methods: Sequence[str | None] = (None,),
    constraints: Sequence[str] | None = None,
    switches: Mapping[str, Sequence[Any]] | None = None,
    dt: Sequence[float] | None = None,
    reference: str | Path | None = None,
    accuracy: float = 1e-4,
    intervals: int = POLICY.defaults.intervals,
    initial: str | None = None,
    repeats: int = 3,
    limit: float = 60.0,
    workers: int | None = None,
    executor: Executor | str | None = None,
    journal: str | Path | None = None,
    progress: Progress | None = None,
) -> Study:
    """Run a model in many ways, in parallel, and report the error and the cost of each.

    Parameters
    ----------
    model : Component
        An instance, such as SpinUp(omega=4).
    stop_time : float, optional
        In s; the model's own if not given.
    parameters : mapping of str to value, optional
        Values by path, common to all cases and not varied.
    inputs : mapping of str to data, optional
        As in `simulate`.
    outputs : sequence of str
        Paths of the quantities to compare, with * and ?; if empty, those in the model's attribute `compared`, or its outputs.
    formulations : sequence of Formulation, optional
        Ways to discretise the model; those that it declares, or that follow from its fields, if not given.
    tolerances, max_orders, methods : sequence
        Tolerances, limits of the order and methods, as in `simulate`.
    constraints : sequence of str, optional
        As in `simulate`; if not given, "states" and "projection" for a model with loops and a single formulation.
    switches : mapping of str to sequence, optional
        Other structural parameters and effects by path, with the values to try.
    dt : sequence of float, optional
        Steps in s to try in formulations with steps of their own; those that they declare if not given.
    reference : str or Path, optional
        A table in the format of `simulate --csv`; computed from the model if not given.
    accuracy : float
        Required accuracy of the reference, as a fraction of each output's range: the smallest error that is reported.
    intervals : int
        Every run has intervals + 1 equidistant points.
    initial : str, optional
        As in `simulate`.
    repeats : int
        Number of runs of a case whose median counts; runs of several seconds are not repeated.
    limit : float
        Seconds after which a case is stopped.
    workers : int, optional
        Number of processes; one for each core if not given.
    executor : Executor or str, optional
        Where cases run: an executor as in concurrent.futures, "local" for Dask workers on this machine, or the address
        of a Dask scheduler. Processes of this machine if not given.
    journal : str or Path, optional
        File that records finished cases; an interrupted study continues from it, a complete one removes it.
    progress : callable, optional
        Called with the number of cases done, the number of cases so far, and the current stage.

    Returns
    -------
    Study
        Rows, table, picture and reference.

    Raises
    ------
    DeclarationError
        If the input is wrong, before anything is run.
    SimulationError
        If no reference can be computed.
    """
    model = checked_model(model)
    stop = stop_time_of(model, stop_time, checked_values(parameters))
    given = with_inputs(model, parameters, inputs, ends=(0.0, stop))
    check_run(intervals, repeats, limit)
    check_shares(1e-4, accuracy=accuracy)
    _check(initial, workers, journal)
    table = None if reference is None else read_csv(reference, "the reference")
    requested = items("formulations", formulations or formulations_of(model, given), "formulations_of(model)")
    forms = [within(model, given, form) if isinstance(form, Formulation) else form for form in requested]
    varied = table_of("switches", switches, '{"crank": ["elastic", "rigid"]}')
    grid = Grid(forms, tolerances, max_orders, methods, ("auto",) if constraints is None else constraints, varied, dt)
    compiled = compile(model, given)
    names = outputs_of(compiled, outputs)
    if constraints is None and compiled.constraints.size and len(forms) == 1 and not (forms[0].refine or forms[0].run):
        grid = replace(grid, constraints=("states", "projection"))
    trees = [Instantiation(model, case.settings).root for case in grid.structures(given)]
    for form in forms:
        check_sendable(form.name, form.run, type(model).__module__)
    job = Job(pack(model), Case(), stop, intervals, names, repeats, limit, initial, type(model).__module__)
    known = None if table is None else matching(table, names, stop * np.linspace(0.0, 1.0, intervals + 1))
    common = {"given": given, "stop_time": stop, "intervals": intervals, "outputs": names, "initial": initial}
    kept = Journal(journal, identity(model, trees, [form.run for form in forms], **common))
    with executor_of(executor, workers) as pool:
        session = Session(job, pool, kept, progress)
        measured = session.measure(grid.cases(given), "cases")
        if known is None:
            exact = [form for form in forms if form.exact] or [min(forms, key=lambda form: form.run is not None)]
            base = _base(compiled, grid, given)
            known = make(lambda p: session.measure(p, "reference"), exact, base, min(tolerances), accuracy)
    kept.remove()
    return Study(type(model).__name__, rows_of(measured, known, forms), known, tuple(grid.switches))


def _check(initial: str | None, workers: int | None, journal: str | Path | None) -> None:
    """Check arguments that would otherwise fail only after the model is compiled."""
    check_choice("initial", initial)
    if workers is not None:
        check_counts(workers=workers)
    if journal is not None:
        check_writable(journal)


def _base(compiled: CompiledModel, grid: Grid, given: Mapping[str, Any]) -> Case:
    """Return the common settings of the cases of a reference: switches have the model's own values."""
    own = {path: value for path in grid.switches if (value := _value(compiled, path)) is not None}
    return Case("", {**given, **own}, method=grid.methods[0], constraints=grid.constraints[0])


def _value(compiled: CompiledModel, path: str) -> Any:
    """Return the value of a structural parameter, an effect or a parameter; None if the model does not have it."""
    try:
        value = compiled.value(path)
    except DeclarationError:
        return None
    return value.tolist() if isinstance(value, np.ndarray) else value
