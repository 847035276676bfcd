"""The command study: what accuracy costs in time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

import typer

from acausal.cli.app import app
from acausal.cli.common import Initial, Inputs, Json, Quiet, Scene, Set, StopTime, running, stop_time_of, user_errors
from acausal.cli.option_values import read_inputs, read_settings, read_switches
from acausal.cli.output import check_outputs, write_json
from acausal.cli.progress import kept_runs, runs_bar
from acausal.cli.scenes import file_of, find_scene, instance
from acausal.errors import DeclarationError
from acausal.language.component import Model
from acausal.policy import POLICY
from acausal.result import shown_name


@app.command("study")
def study(
    scene: Scene,
    settings: Set = None,
    inputs: Inputs = None,
    formulations: Annotated[
        list[str] | None,
        typer.Option("--formulation", metavar="NAME", help="Only these formulations; all of the scene's if not given."),
    ] = None,
    tolerances: Annotated[
        str, typer.Option(metavar="R,R,...", help="Relative tolerances of a step.")
    ] = "1e-3,1e-4,1e-5,1e-6,1e-7",
    max_orders: Annotated[
        str, typer.Option(metavar="N,N,...", help="Limits of the order; auto lets the run choose.")
    ] = "auto",
    methods: Annotated[
        str | None, typer.Option(metavar="NAME,...", help="Methods of simulate; the scene's own if not given.")
    ] = None,
    constraints: Annotated[
        str | None, typer.Option(metavar="NAME,...", help="How loops stay closed: auto, states, projection.")
    ] = None,
    switches: Annotated[
        list[str] | None,
        typer.Option("--switch", metavar="NAME=VALUE,VALUE", help="Another parameter to vary."),
    ] = None,
    dt: Annotated[
        str | None, typer.Option(metavar="R,R,...", help="Steps in s of formulations that have their own.")
    ] = None,
    outputs: Annotated[
        list[str] | None,
        typer.Option(
            metavar="PATTERN",
            help="Quantities to compare: paths with * and ?; those of the scene, or its outputs, if not given.",
        ),
    ] = None,
    reference: Annotated[
        str | None,
        typer.Option(metavar="FILE.csv", help="Table of simulate --csv to compare with; computed if not given."),
    ] = None,
    accuracy: Annotated[
        float, typer.Option(metavar="R", help="Required accuracy of the reference, as a fraction of the range.")
    ] = 1e-4,
    stop_time: StopTime = None,
    intervals: Annotated[
        int, typer.Option(help="Every run has N + 1 points.", metavar="N")
    ] = POLICY.defaults.intervals,
    initial: Initial = None,
    repeats: Annotated[int, typer.Option(help="Runs per case; their median counts.", metavar="N")] = 3,
    limit: Annotated[float, typer.Option(help="Seconds after which a case is stopped.", metavar="S")] = 60.0,
    workers: Annotated[
        int | None, typer.Option(help="Parallel processes; one per core if not given.", metavar="N")
    ] = None,
    cluster: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS|local", help="Run on the Dask workers of this scheduler, or on local ones."),
    ] = None,
    csv: Annotated[
        str | None,
        typer.Option(help="Write every figure of every case; an interrupted study continues.", metavar="FILE"),
    ] = None,
    markdown: Annotated[str | None, typer.Option(help="Write the table in Markdown.", metavar="FILE")] = None,
    plot: Annotated[str | None, typer.Option(help="Plot error over time.", metavar="FILE.png")] = None,
    json: Json = None,
    quiet: Quiet = False,
) -> None:
    """Run a scene in many ways and compare error and time with a reference."""
    with running(json) as standard_output:
        from acausal.study import study as run

        check_outputs((file_of(scene), reference), csv=csv, markdown=markdown, plot=plot, json=json)
        cls, values = find_scene(scene), read_settings(settings or ())
        options = {
            "parameters": values,
            "inputs": read_inputs(inputs or ()),
            "tolerances": _list(tolerances, float, "tolerances", "numbers, such as 1e-3,1e-6"),
            "max_orders": _list(max_orders, _order, "max-orders", "whole numbers from 1 to 5, or auto, such as 2,5"),
            "methods": _list(methods, _word, "methods", "names, such as idas,rosenbrock") if methods else (None,),
            "constraints": _list(constraints, _word, "constraints", "names, such as states,projection")
            if constraints
            else None,
            "switches": read_switches(switches or ()),
            "dt": None if dt is None else _list(dt, float, "dt", "steps in s, such as 1e-3,1e-4"),
            "outputs": outputs or (),
        }
        numbers = {"accuracy": accuracy, "intervals": intervals, "initial": initial, "repeats": repeats, "limit": limit}
        journal = f"{csv}.journal" if csv else None
        with kept_runs(journal, "cases"), user_errors(cls), runs_bar(not quiet) as show:
            model = instance(cls)
            found = run(
                model,
                stop_time=stop_time_of(model, values, stop_time),
                formulations=_chosen(cls, values, formulations),
                reference=reference,
                workers=workers,
                executor=cluster,
                journal=journal,
                progress=show,
                **options,
                **numbers,
            )
        if csv:
            found.to_csv(csv)
        if markdown:
            found.to_markdown(markdown)
        if plot:
            found.plot(plot)
        if json:
            write_json({"scene": scene, **found.document()}, json, standard_output)
        if not quiet:
            typer.echo(found.table())


def _list(text: str, read: Callable[[str], Any], option: str, what: str) -> tuple[Any, ...]:
    try:
        return tuple(read(part.strip()) for part in text.split(","))
    except ValueError:
        raise DeclarationError(
            f"--{option} takes comma-separated values, not `{shown_name(text)}`. Give {what}."
        ) from None


def _order(text: str) -> int | None:
    return None if text == "auto" else int(text)


def _word(text: str) -> str:
    if not text:
        raise ValueError
    return text


def _chosen(cls: type[Model], values: dict[str, Any], names: list[str] | None) -> list[Any] | None:
    """Return the formulations of these names."""
    if not names:
        return None
    from acausal.study import formulations_of

    known = {form.name: form for form in formulations_of(instance(cls), values)}
    unknown = [name for name in names if name not in known]
    if unknown:
        raise DeclarationError(f"there is no formulation `{unknown[0]}` in the scene; it has: {', '.join(known)}.")
    return [known[name] for name in names]
