"""The command effects: what each effect of a scene changes and costs."""

from __future__ import annotations

from typing import Annotated

import typer

from acausal.cli.app import app
from acausal.cli.common import Inputs, Json, Quiet, Scene, Set, StopTime, running, stop_time_of, user_errors
from acausal.cli.option_values import read_inputs, read_settings
from acausal.cli.output import check_outputs, write_json
from acausal.cli.progress import kept_runs, runs_bar
from acausal.cli.scenes import file_of, find_scene, instance
from acausal.policy import POLICY


@app.command("effects")
def effects(
    scene: Scene,
    settings: Set = None,
    inputs: Inputs = None,
    accuracy: Annotated[
        float, typer.Option(help="Largest change of the outputs, as a fraction of their ranges.", metavar="R")
    ] = 1e-2,
    apply: Annotated[
        str | None,
        typer.Option(
            metavar="FILE.json",
            help="Write the cheapest set of effects, for `acausal simulate SCENE --effects FILE.json`.",
        ),
    ] = None,
    outputs: Annotated[
        list[str] | None,
        typer.Option(
            help="Quantities to compare: paths with * and ?; those of the scene, or its outputs, if not given.",
            metavar="PATTERN",
        ),
    ] = None,
    tolerance: Annotated[
        float, typer.Option(help="Relative tolerance of a step.", metavar="R")
    ] = POLICY.defaults.tolerance,
    stop_time: StopTime = None,
    pairs: Annotated[int, typer.Option(help="Largest number of pairs of effects to try.", metavar="N")] = 15,
    limit: Annotated[float, typer.Option(help="Seconds after which a run is stopped.", metavar="S")] = 60.0,
    workers: Annotated[
        int | None, typer.Option(help="Parallel processes; one per core if not given.", metavar="N")
    ] = None,
    csv: Annotated[
        str | None, typer.Option(help="Write a row for each variant; an interrupted command continues.", metavar="FILE")
    ] = None,
    markdown: Annotated[str | None, typer.Option(help="Write the tables in Markdown.", metavar="FILE")] = None,
    json: Json = None,
    quiet: Quiet = False,
) -> None:
    """Show what each effect of a scene changes and costs, and the cheapest set within an accuracy."""
    with running(json) as standard_output:
        from acausal.study import effects as study
        from acausal.study.effects.choices_file import choices_document

        check_outputs((file_of(scene),), apply=apply, csv=csv, markdown=markdown, json=json)
        cls, values = find_scene(scene), read_settings(settings or ())
        journal = f"{csv}.journal" if csv else None
        with kept_runs(journal, "runs"), user_errors(cls), runs_bar(not quiet) as show:
            model = instance(cls)
            found = study(
                model,
                stop_time=stop_time_of(model, values, stop_time),
                accuracy=accuracy,
                tolerance=tolerance,
                outputs=outputs,
                parameters=values,
                inputs=read_inputs(inputs or ()),
                limit=limit,
                pairs=pairs,
                workers=workers,
                journal=journal,
                progress=show,
            )
        if csv:
            found.to_csv(csv)
        if markdown:
            found.to_markdown(markdown)
        if apply:
            write_json(choices_document(found, scene, values), apply, standard_output)
        if json:
            write_json({"scene": scene, **found.document()}, json, standard_output)
        if not quiet:
            typer.echo(found.table())
