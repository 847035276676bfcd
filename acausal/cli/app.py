"""The commands: list, simulate, check, linearize."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext, redirect_stdout
from pathlib import Path
from typing import IO, TYPE_CHECKING, Annotated, NoReturn

import typer

from acausal.cli.output import Files, Progress, modes_table, progress_bar, summary, write_json
from acausal.cli.scenes import brief, find_scene, place_in, read_settings, scenes
from acausal.errors import AcausalError, DeclarationError, InitializationError, SimulationError
from acausal.language.component import Model
from acausal.result import Result, check_writable, match

if TYPE_CHECKING:
    from acausal.compiler import CompiledModel

FAILED, WRONG, INTERRUPTED = 1, 2, 130
MODES = ("states", "eigenvalues", "frequencies_hz", "damping_ratios", "inputs", "outputs")
STOP_TIME = 1.0  # of a model that does not tell its own, in s

app = typer.Typer(
    help="Acausal modelling of machines with rigid and flexible parts.",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)

Scene = Annotated[str, typer.Argument(help="Name of a scene, or path/to/file.py:ClassName.", show_default=False)]
Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set", metavar="NAME=VALUE", help="Value of a parameter: a number, a word or a tuple such as 0,0,1."
    ),
]
Json = Annotated[
    str | None, typer.Option("--json", metavar="FILE|-", help="Write a JSON document; - is standard output.")
]
Initial = Annotated[
    str,
    typer.Option("--initial", metavar="fixed|guesses|steady", help="What to do with states that no condition fixes."),
]


def main() -> None:
    """Run the command line."""
    app(prog_name="acausal")


@app.command("list")
def list_scenes() -> None:
    """List the scenes, a line each."""
    with _run():
        known = scenes()
        width = max(map(len, known), default=0)
        for name, cls in known.items():
            typer.echo(f"{name:{width}}  {(inspect.getdoc(cls) or '').partition(chr(10))[0]}".rstrip())


@app.command()
def simulate(
    scene: Scene,
    settings: Set = None,
    stop_time: Annotated[
        float | None, typer.Option(help="In s; the scene's own if not given.", metavar="S", show_default=False)
    ] = None,
    tolerance: Annotated[float, typer.Option(help="Relative tolerance of a step.", metavar="R")] = 1e-6,
    intervals: Annotated[int, typer.Option(help="The result has N + 1 points.", metavar="N")] = 400,
    method: Annotated[
        str | None,
        typer.Option(help="auto, idas, rosenbrock or resolve; the scene's own if not given.", metavar="NAME"),
    ] = None,
    constraints: Annotated[
        str, typer.Option(help="How loops stay closed: auto, states or projection.", metavar="NAME")
    ] = "auto",
    max_order: Annotated[
        int | None, typer.Option(help="Limit of the order; chosen if not given.", metavar="N", show_default=False)
    ] = None,
    initial: Initial = "fixed",
    csv: Annotated[str | None, typer.Option(help="Write time and outputs.", metavar="FILE")] = None,
    plot: Annotated[str | None, typer.Option(help="Draw the outputs.", metavar="FILE.png")] = None,
    json: Json = None,
    variables: Annotated[
        list[str] | None,
        typer.Option(help="More columns: paths with * and ?; drawn instead of outputs.", metavar="PATTERN"),
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="Print nothing but errors.")] = False,
) -> None:
    """Simulate a scene."""
    with _run(json) as standard_output:
        import acausal as ac

        files = Files(scene, csv, plot, json, standard_output)
        files.check()
        cls = find_scene(scene)
        compiled = _compile(cls, settings)
        chosen = match(compiled.tree, variables or ())
        options = {
            "stop_time": _stop_time(cls) if stop_time is None else stop_time,
            "tolerance": tolerance,
            "intervals": intervals,
            "method": method,
            "constraints": constraints,
            "max_order": max_order,
            "initial": initial,
            "energy": True,
        }
        result = _rescue(lambda show: ac.simulate(compiled, **options, progress=show), files, chosen, quiet)
        files.write(result, chosen)
        if not quiet:
            typer.echo(summary(result))


@app.command()
def check(scene: Scene, settings: Set = None, json: Json = None) -> None:
    """Compile a scene and tell what the compiler did: equations and unknowns, states, what was removed, seconds."""
    with _run(json) as standard_output:
        compiled = _compile(find_scene(scene), settings)
        _look_at_start(compiled)
        typer.echo(compiled.summary())
        if json:
            write_json({"scene": scene, **compiled.report}, json, standard_output)


@app.command()
def linearize(scene: Scene, settings: Set = None, initial: Initial = "fixed", json: Json = None) -> None:
    """Linearise a scene about its initial point and list its modes."""
    with _run(json) as standard_output:
        import acausal as ac

        linear = ac.linearize(_compile(find_scene(scene), settings), initial=initial)
        typer.echo(modes_table(linear.eigenvalues))
        if json:
            document = {key: getattr(linear, key) for key in MODES} | {
                "eigenvalues": linear.eigenvalues.astype(complex)
            }
            write_json({"scene": scene, **document}, json, standard_output)


def _look_at_start(compiled: CompiledModel) -> None:
    """Let the ranks of loops be known, which need consistent positions."""
    from acausal.solve.instant import start

    if compiled.closing.size:
        try:
            start(compiled, compiled.parameter_values(None), 0.0, 0.0, "guesses")
        except InitializationError as error:
            typer.echo(
                f"no consistent start was found, so ranks and independent states are not known: {error}", err=True
            )


@contextmanager
def _run(json: str | None = None) -> Iterator[IO[str]]:
    """Turn errors into a message and an exit status; give the stream for a JSON document.

    With `json` "-" everything else that is printed goes to standard error.
    """
    standard_output = sys.stdout
    try:
        if json not in (None, "-"):
            check_writable(json)
        with redirect_stdout(sys.stderr) if json == "-" else nullcontext():
            yield standard_output
    except SimulationError as error:
        _stop(f"the simulation failed: {error}", FAILED)
    except AcausalError as error:
        _stop(str(error), WRONG)
    except KeyboardInterrupt:
        _stop("interrupted.", INTERRUPTED)


def _stop(message: str, status: int) -> NoReturn:
    typer.echo(f"Error: {message}", err=True)
    raise typer.Exit(status) from None


def _compile(cls: type[Model], settings: list[str] | None) -> CompiledModel:
    import acausal as ac

    try:
        return ac.compile(cls(), parameters=read_settings(settings or ()))
    except AcausalError:
        raise
    except Exception as error:
        place = place_in(error, Path(inspect.getfile(cls)))
        if not place:
            raise  # no fault of the user's file: whoever mends the engine needs the traceback
        raise DeclarationError(f"{place}: {brief(error)}") from error


def _stop_time(cls: type[Model]) -> float:
    own = getattr(cls, "stop_time", None)
    return float(own) if isinstance(own, int | float) else STOP_TIME


def _rescue(compute: Callable[[Progress], Result], files: Files, chosen: list[str], quiet: bool) -> Result:
    """Run a simulation; where it fails or is interrupted, write what it has computed until then."""
    try:
        with progress_bar(not quiet) as show:
            return compute(show)
    except (SimulationError, KeyboardInterrupt) as stop:
        part = getattr(stop, "result", None)
        if isinstance(part, Result):
            files.write(part, chosen, error=str(stop) or "interrupted")
        raise
