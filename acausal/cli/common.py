"""What all commands share: arguments, errors as messages, and how a scene is compiled."""

from __future__ import annotations

import inspect
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, redirect_stdout
from pathlib import Path
from typing import IO, TYPE_CHECKING, Annotated, Any, NoReturn

import typer

from acausal.cli.scenes import brief, place_in, read_settings
from acausal.errors import AcausalError, AcausalWarning, DeclarationError, SimulationError
from acausal.language.component import Model
from acausal.result import check_writable

if TYPE_CHECKING:
    from acausal.compiler import CompiledModel

FAILED, WRONG, INTERRUPTED = 1, 2, 130
STOP_TIME = 1.0  # of a model that does not tell its own, in s

Scene = Annotated[str, typer.Argument(help="Name of a scene, or path/to/file.py:ClassName.", show_default=False)]
Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set", metavar="NAME=VALUE", help="Value of a parameter: a number, a word or a tuple such as 0,0,1."
    ),
]
Applied = Annotated[
    str | None,
    typer.Option(
        "--effects", metavar="FILE.json", help="Choices of effects, from `acausal effects --apply`; --set wins."
    ),
]
Json = Annotated[
    str | None, typer.Option("--json", metavar="FILE|-", help="Write a JSON document; - is standard output.")
]
Initial = Annotated[
    str,
    typer.Option("--initial", metavar="fixed|guesses|steady", help="What to do with states that no condition fixes."),
]
StopTime = Annotated[
    float | None, typer.Option(help="In s; the scene's own if not given.", metavar="S", show_default=False)
]
Quiet = Annotated[bool, typer.Option("--quiet", help="Print nothing but errors.")]


@contextmanager
def running(json: str | None = None, quiet: bool = False) -> Iterator[IO[str]]:
    """Turn errors into a message and an exit status; give the stream for a JSON document.

    With `json` "-" everything else that is printed goes to standard error; with `quiet` there are no warnings.
    """
    standard_output = sys.stdout
    try:
        if json not in (None, "-"):
            check_writable(json)
        with _told(quiet), redirect_stdout(sys.stderr) if json == "-" else nullcontext():
            yield standard_output
    except SimulationError as error:
        _stop(f"the simulation failed: {error}", FAILED)
    except AcausalError as error:
        _stop(str(error), WRONG)
    except KeyboardInterrupt:
        _stop("interrupted.", INTERRUPTED)


@contextmanager
def _told(quiet: bool) -> Iterator[None]:
    """Print warnings of this package as a line on standard error, or not at all, others as Python does."""
    with warnings.catch_warnings():
        warnings.simplefilter("always", AcausalWarning)
        plain = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *place: Any) -> None:
            if issubclass(category, AcausalWarning):
                if not quiet:
                    typer.echo(f"Warning: {message}", err=True)
            else:
                plain(message, category, *place)

        warnings.showwarning = show
        yield


@contextmanager
def blaming(cls: type[Model]) -> Iterator[None]:
    """Tell the line of the user's file where Python's own errors come from it."""
    try:
        yield
    except AcausalError:
        raise
    except Exception as error:
        place = place_in(error, Path(inspect.getfile(cls)))
        if not place:
            raise  # no fault of the user's file: whoever mends the engine needs the traceback
        raise DeclarationError(f"{place}: {brief(error)}") from error


def make_scene(
    scene: str, cls: type[Model], settings: list[str] | None, effects: str | None
) -> tuple[Model, dict[str, Any]]:
    """Return a scene and the values that the user gave."""
    values: dict[str, Any] = read_settings(settings or ())
    with blaming(cls):
        model = cls()
        if effects:
            from acausal.study.effects_file import with_effects

            values = with_effects(model, scene, effects, values)
        return model, values


def compile_scene(scene: str, cls: type[Model], settings: list[str] | None, effects: str | None) -> CompiledModel:
    """Compile a scene with what the user gave."""
    import acausal as ac

    model, values = make_scene(scene, cls, settings, effects)
    with blaming(cls):
        return ac.compile(model, parameters=values)


def stop_time_of(cls: type[Model], given: float | None) -> float:
    """Return the stop time that was given, or the scene's own."""
    if given is not None:
        return given
    own = getattr(cls, "stop_time", None)
    return float(own) if isinstance(own, int | float) else STOP_TIME


def _stop(message: str, status: int) -> NoReturn:
    typer.echo(f"Error: {message}", err=True)
    raise typer.Exit(status) from None
