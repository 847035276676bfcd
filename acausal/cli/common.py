"""Common parts of the commands: arguments, errors as messages, compilation of a scene."""

from __future__ import annotations

import errno
import inspect
import signal
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import current_thread, main_thread
from typing import IO, TYPE_CHECKING, Annotated, Any, NoReturn

import typer

from acausal.cli.faults import brief, exit_error, place_in
from acausal.cli.option_values import read_settings
from acausal.cli.progress import working
from acausal.cli.scenes import instance
from acausal.cli.streams import WRONG, report_unwritten, reserved_output, tell
from acausal.errors import AcausalError, AcausalWarning, DeclarationError, SimulationError
from acausal.language.component import Model
from acausal.result import check_writable
from acausal.simulation.stop_time import own_stop_time

if TYPE_CHECKING:
    from acausal.compiler import CompiledModel

FAILED, INTERRUPTED, TERMINATED = 1, 130, 143
# Errors of a standard output that is full, closed or no longer read.
NO_OUTPUT = (errno.EPIPE, errno.ENOSPC, errno.EBADF, errno.EIO, errno.EFBIG)
STOP_TIME = 1.0  # default in s, for models that declare none

Scene = Annotated[str, typer.Argument(help="Name of a scene, or path/to/file.py:ClassName.", show_default=False)]
Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set", metavar="NAME=VALUE", help="Value of a parameter: a number, a word or a tuple such as 0,0,1."
    ),
]
Inputs = Annotated[
    list[str] | None,
    typer.Option(
        "--input",
        metavar="NAME=FILE.csv:COLUMN",
        help="Data of an input; times are in the column `time`, else in the first.",
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
    str | None,
    typer.Option(
        "--initial",
        metavar="fixed|guesses|steady",
        help="What to do with states without an initial condition; the scene's own or fixed if not given.",
        show_default=False,
    ),
]
StopTime = Annotated[
    float | None, typer.Option(help="In s; the scene's own if not given.", metavar="S", show_default=False)
]
Quiet = Annotated[bool, typer.Option("--quiet", help="Print nothing but errors.")]


@contextmanager
def running(json: str | None = None, quiet: bool = False) -> Iterator[IO[str]]:
    """Turn errors into a message and an exit status; yield the stream for a JSON document.

    With `json` "-" all other output goes to standard error; with `quiet` warnings are hidden.
    """
    try:
        if json not in (None, "-"):
            check_writable(json)
        with _print_warnings(quiet), _terminable(), reserved_output(json == "-") as standard_output:
            yield standard_output
    except OSError as error:
        if error.filename is not None or error.errno not in NO_OUTPUT:
            raise
        raise typer.Exit(report_unwritten(error)) from None
    except MemoryError:
        _stop("there is not enough memory; take fewer intervals, elements or variables.", FAILED)
    except SimulationError as error:
        _stop(f"the simulation failed: {message_of(error)}", FAILED)
    except AcausalError as error:
        _stop(str(error), WRONG)
    except Terminated:
        _stop("terminated.", TERMINATED)
    except KeyboardInterrupt:
        _stop("interrupted.", INTERRUPTED)


def message_of(error: BaseException) -> str:
    """Return the message of an error in the words of the command line: results are in files, not in `error.result`."""
    return error.text("is kept") if isinstance(error, SimulationError) else str(error)


class Terminated(KeyboardInterrupt):
    """SIGTERM was received; results so far are written, as after an interrupt."""


@contextmanager
def _terminable() -> Iterator[None]:
    """Treat the first SIGTERM like a keyboard interrupt; a second one ends the process at once."""

    def terminate(*_: Any) -> None:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        raise Terminated("terminated")

    takes = current_thread() is main_thread() and signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    if takes:
        signal.signal(signal.SIGTERM, terminate)
    try:
        yield
    finally:
        if takes:
            signal.signal(signal.SIGTERM, signal.SIG_DFL)


@contextmanager
def _print_warnings(quiet: bool) -> Iterator[None]:
    """Print warnings of this package on standard error, each text once, or none if quiet; others as Python does."""
    printed: set[str] = set()
    with warnings.catch_warnings():
        warnings.simplefilter("always", AcausalWarning)
        plain = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *place: Any) -> None:
            if not issubclass(category, AcausalWarning):
                plain(message, category, *place)
            elif not quiet and str(message) not in printed:
                printed.add(str(message))
                tell(f"Warning: {message}")

        warnings.showwarning = show
        yield


@contextmanager
def user_errors(cls: type[Model]) -> Iterator[None]:
    """Turn Python errors that come from the user's file into messages with file and line."""
    try:
        yield
    except AcausalError:
        raise
    except Exception as error:
        place = place_in(error, Path(inspect.getfile(cls)))
        if not place:
            raise  # an error of the engine: keep the traceback
        raise DeclarationError(f"{place}: {brief(error)}") from error
    except SystemExit as error:
        raise exit_error(error, Path(inspect.getfile(cls))) from None


def make_scene(
    scene: str, cls: type[Model], settings: list[str] | None, effects: str | None
) -> tuple[Model, dict[str, Any]]:
    """Return a scene and the values given by the user."""
    values: dict[str, Any] = read_settings(settings or ())
    with user_errors(cls):
        model = instance(cls)
        if effects is not None:
            from acausal.study.effects.choices_file import with_effects

            values = with_effects(model, scene, effects, values)
        return model, values


def compile_scene(scene: str, cls: type[Model], settings: list[str] | None, effects: str | None) -> CompiledModel:
    """Compile a scene with the values given by the user."""
    import acausal as ac

    model, values = make_scene(scene, cls, settings, effects)
    with user_errors(cls), working("compiling"):
        return ac.compile(model, parameters=values)


def stop_time_of(model: Model, values: dict[str, Any], given: float | None) -> float:
    """Return the given stop time, or the scene's own, or the default."""
    own = own_stop_time(model, values) if given is None else given
    return STOP_TIME if own is None else own


def _stop(message: str, status: int) -> NoReturn:
    tell(f"Error: {message}")
    raise typer.Exit(status) from None
