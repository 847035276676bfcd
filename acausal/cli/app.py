"""The commands: list, simulate, check, linearize."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated

import typer

from acausal.cli.common import (
    Applied,
    Initial,
    Inputs,
    Json,
    Quiet,
    Scene,
    Set,
    StopTime,
    compile_scene,
    make_scene,
    message_of,
    running,
    stop_time_of,
    user_errors,
)
from acausal.cli.option_values import read_inputs, read_size
from acausal.cli.output import Files, check_outputs, modes_table, summary, write_json
from acausal.cli.progress import Progress, progress_bar, working
from acausal.cli.scenes import file_of, find_scene, scenes
from acausal.cli.streams import escape_unencodable, fitted, flushed, tell
from acausal.compiler.report import AtStart
from acausal.errors import DeclarationError, InitializationError, SimulationError
from acausal.result import Result, check_columns, match
from acausal.simulation.inputs import with_inputs
from acausal.simulation.model_settings import effective_settings
from acausal.simulation.run_cache import adaptive
from acausal.simulation.settings_checks import check_choice, checked_task

if TYPE_CHECKING:
    from acausal.compiler import CompiledModel

MODES = ("states", "eigenvalues", "frequencies_hz", "damping_ratios", "inputs", "outputs")

FIRST = """Acausal modelling of machines with rigid and flexible parts.

    acausal simulate pendulum --animate pendulum.html    a scene, as a page for any browser
    acausal list                                         all scenes
    acausal new machine.py                               a commented model to start from
    acausal show Revolute                                parameters, variables and ports of a component
    acausal --help                                       all commands"""

app = typer.Typer(
    help="Acausal modelling of machines with rigid and flexible parts.",
    invoke_without_command=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


def main() -> None:
    """Run the command line."""
    escape_unencodable()
    try:
        app(prog_name="acausal")
    except SystemExit as end:
        sys.exit(flushed(end.code))


@app.callback()
def first_words(context: typer.Context) -> None:
    """Acausal modelling of machines with rigid and flexible parts."""
    if context.invoked_subcommand is None:
        typer.echo(FIRST)


@app.command("list")
def list_scenes() -> None:
    """List the scenes with their descriptions."""
    with running():
        known = scenes()
        width = max(map(len, known), default=0)
        for name, cls in known.items():
            line = f"{name:{width}}  {(inspect.getdoc(cls) or '').partition(chr(10))[0]}".rstrip()
            typer.echo(fitted(line, sys.stdout, width + 2))


@app.command()
def simulate(
    scene: Scene,
    settings: Set = None,
    inputs: Inputs = None,
    extrapolation: Annotated[
        str, typer.Option(metavar="refuse|hold", help="What inputs are where their data end: refused, or held.")
    ] = "refuse",
    effects: Applied = None,
    stop_time: StopTime = None,
    tolerance: Annotated[
        float | None,
        typer.Option(
            help="Relative tolerance of a step; the scene's own or 1e-6 if not given.", metavar="R", show_default=False
        ),
    ] = None,
    accuracy: Annotated[
        float | None,
        typer.Option(
            help="Instead of a tolerance: largest error of the outputs as a fraction of their ranges; chooses "
            "tolerance and order, and the elements of adaptive beams.",
            metavar="R",
            show_default=False,
        ),
    ] = None,
    intervals: Annotated[
        int | None,
        typer.Option(
            help="The result has N + 1 points; the scene's own or 400 if not given.", metavar="N", show_default=False
        ),
    ] = None,
    method: Annotated[
        str | None,
        typer.Option(help="auto, idas, rosenbrock or resolve; the scene's own if not given.", metavar="NAME"),
    ] = None,
    constraints: Annotated[
        str | None,
        typer.Option(help="How loops stay closed: auto, states or projection.", metavar="NAME", show_default=False),
    ] = None,
    max_order: Annotated[
        int | None, typer.Option(help="Limit of the order; chosen if not given.", metavar="N", show_default=False)
    ] = None,
    max_steps: Annotated[
        int | None, typer.Option(help="Steps after which the run ends.", metavar="N", show_default=False)
    ] = None,
    max_seconds: Annotated[
        float | None, typer.Option(help="Seconds after which the run ends.", metavar="S", show_default=False)
    ] = None,
    initial: Initial = None,
    csv: Annotated[str | None, typer.Option(help="Write time and outputs.", metavar="FILE")] = None,
    plot: Annotated[str | None, typer.Option(help="Plot the outputs.", metavar="FILE.png")] = None,
    animate: Annotated[
        str | None,
        typer.Option(
            help="Write an animation: a page for any browser, or FILE.gif, FILE.mp4, FILE.png.", metavar="FILE.html"
        ),
    ] = None,
    explore: Annotated[
        str | None,
        typer.Option(help="Write a page with the tree of parts, plots and animation.", metavar="FILE.html"),
    ] = None,
    values: Annotated[
        list[str] | None,
        typer.Option(
            help="Colours of beams in the animation, such as 'bending moment', 'torque', 'axial force'; all.",
            metavar="NAME",
        ),
    ] = None,
    deformation: Annotated[
        float, typer.Option(help="Scale of deformations in the animation, 1 to 1000.", metavar="X", show_default=False)
    ] = 1.0,
    trails: Annotated[
        list[str] | None,
        typer.Option(help="Point whose path the animation draws: a frame, such as rod.frame_b.", metavar="PATH"),
    ] = None,
    view: Annotated[
        str | None, typer.Option(help="View of the animation: front, top, right or iso.", metavar="NAME")
    ] = None,
    size: Annotated[str | None, typer.Option(help="Size of the film or still in pixels.", metavar="WxH")] = None,
    fps: Annotated[int | None, typer.Option(help="Frames per second of the film.", metavar="N")] = None,
    json: Json = None,
    variables: Annotated[
        list[str] | None,
        typer.Option(help="More columns: paths with * and ?; plotted instead of the outputs.", metavar="PATTERN"),
    ] = None,
    quiet: Quiet = False,
) -> None:
    """Simulate a scene."""
    with running(json, quiet) as standard_output:
        import acausal as ac

        look = {"values": tuple(values or ()), "deformation": deformation, "trails": tuple(trails or ())}
        look |= {"view": view, "size": read_size(size), "fps": fps}
        files = Files(scene, csv, plot, json, standard_output, animate, look, explore)
        check_outputs((file_of(scene), effects), csv=csv, plot=plot, animate=animate, explore=explore, json=json)
        cls = find_scene(scene)
        model, given = make_scene(scene, cls, settings, effects)
        how = {
            "tolerance": tolerance,
            "accuracy": accuracy,
            "intervals": intervals,
            "method": method,
            "constraints": constraints,
            "max_order": max_order,
            "initial": initial,
        }
        limits = {"max_steps": max_steps, "max_seconds": max_seconds}
        with user_errors(cls):
            how["stop_time"] = stop_time_of(model, given, stop_time)
            task, _ = checked_task(model, given, how, **limits)
            data, ends = read_inputs(inputs or ()), (task.start_time, task.stop_time)
            given = with_inputs(model, given, data, extrapolation, ends=ends)
            with working("compiling", not quiet):
                compiled = ac.compile(model, parameters=given)
        # Refuse wrong names before the run.
        chosen = match(compiled.tree, variables or ())
        with user_errors(cls):
            files.check(compiled.tree)
        if csv is not None:
            check_columns(compiled.tree, (*compiled.outputs, *chosen))
        chosen_by = effective_settings(compiled, None, {"tolerance": tolerance, "accuracy": accuracy})["accuracy"]
        again = chosen_by is not None and bool(adaptive(compiled.tree))
        options = {**how, **limits, "parameters": given if again else None, "energy": True}
        with user_errors(cls):
            subject = model if again else compiled
            result = _rescue(lambda show: ac.simulate(subject, **options, progress=show), files, variables, quiet)
        with working("writing files", not quiet):
            files.write(result, _chosen(result, variables))
        if not quiet:
            typer.echo(summary(result))


@app.command()
def check(scene: Scene, settings: Set = None, effects: Applied = None, json: Json = None) -> None:
    """Compile a scene and report equations, unknowns, states, removed equations and seconds."""
    with running(json) as standard_output:
        check_outputs((file_of(scene), effects), json=json)
        compiled = compile_scene(scene, find_scene(scene), settings, effects)
        found = _at_start(compiled)
        typer.echo(compiled.summary(found))
        if json:
            write_json({"scene": scene, **compiled.report_at(found)}, json, standard_output)


@app.command()
def linearize(
    scene: Scene,
    settings: Set = None,
    inputs: Inputs = None,
    effects: Applied = None,
    initial: Initial = None,
    json: Json = None,
) -> None:
    """Linearise a scene about its initial point and list its modes."""
    with running(json) as standard_output:
        import acausal as ac

        check_outputs((file_of(scene), effects), json=json)
        check_choice("initial", initial)
        compiled, data = compile_scene(scene, find_scene(scene), settings, effects), read_inputs(inputs or ())
        with working("linearizing"):
            linear = ac.linearize(compiled, inputs=data, initial=initial)
        counts = f"{len(linear.states)} states, {len(linear.inputs)} inputs, {len(linear.outputs)} outputs"
        typer.echo(f"{type(compiled.tree).__name__}: {counts}; {len(linear.frequencies_hz)} frequencies")
        typer.echo(modes_table(linear.eigenvalues))
        if json:
            document = {key: getattr(linear, key) for key in MODES} | {
                "eigenvalues": linear.eigenvalues.astype(complex)
            }
            write_json({"scene": scene, **document}, json, standard_output)


def _at_start(compiled: CompiledModel) -> AtStart | None:
    """Return the redundant constraints and independent states of loops, which need consistent positions."""
    from acausal.solve.initialization.initial_modes import start
    from acausal.solve.problem import Problem

    if not compiled.constraints.size:
        return None
    try:
        return start(Problem(compiled, compiled.parameter_values(None)), 0.0, 0.0, "guesses").found(compiled)
    except InitializationError as error:
        tell(
            f"no consistent initial values were found, so redundant constraints and independent states are unknown: {error}"
        )
        return None


def _chosen(result: Result, patterns: list[str] | None) -> list[str]:
    """Return the names that match; with few volumes, as accuracy control may choose, a pattern may match none."""
    found: dict[str, None] = {}
    for pattern in patterns or ():
        try:
            found |= dict.fromkeys(match(result.tree, [pattern]))
        except DeclarationError as error:
            tell(f"left out: {error}")
    return list(found)


def _rescue(compute: Callable[[Progress], Result], files: Files, patterns: list[str] | None, quiet: bool) -> Result:
    """Run a simulation; if it fails or is interrupted, write the results so far."""
    try:
        with progress_bar(not quiet) as show:
            return compute(show)
    except (SimulationError, KeyboardInterrupt) as stop:
        part = getattr(stop, "result", None)
        if isinstance(part, Result):
            files.write(part, _chosen(part, patterns), error=message_of(stop) or "interrupted")
        raise
