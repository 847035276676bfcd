"""Progress of long work on the terminal; quiet without one."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Timer

from acausal.cli.streams import tell

Progress = Callable[[float, int], None] | None
PATIENCE = 2.0  # seconds of work without a sign of it


@contextmanager
def working(what: str, wanted: bool = True) -> Iterator[None]:
    """Show on the terminal what takes more than two seconds, until it is done.

    Parameters
    ----------
    what : str
        The work, such as "compiling".
    wanted : bool
        False shows nothing.
    """
    if not wanted or sys.stderr is None or not sys.stderr.isatty():
        yield
        return
    from rich.console import Console

    status = Console(stderr=True).status(f"{what} ...")
    timer = Timer(PATIENCE, status.start)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        timer.join()
        status.stop()


@contextmanager
def progress_bar(wanted: bool) -> Iterator[Progress]:
    """Yield a function that shows the progress of a long run on the terminal; None without a terminal."""
    with _bar(wanted) as show:
        yield show and (lambda fraction, steps: show(fraction, 1.0, f"{steps} steps"))


@contextmanager
def runs_bar(wanted: bool) -> Iterator[Callable[[int, int, str], None] | None]:
    """Yield a function that shows how many runs of a study are done; None without a terminal."""
    with _bar(wanted) as show:
        yield show and (lambda done, total, what: show(done, total, f"{done} of {total} runs: {what}"))


@contextmanager
def kept_runs(journal: str | None, what: str) -> Iterator[None]:
    """Tell on an interrupt where finished runs are kept.

    Parameters
    ----------
    journal : str or None
        The file that keeps them.
    what : str
        What is run: "cases".
    """
    try:
        yield
    except KeyboardInterrupt:
        kept = f"finished {what} are kept in {journal}: the same command continues from there"
        tell(
            kept if journal else f"finished {what} are lost; with --csv FILE the command can continue where it stopped"
        )
        raise


@contextmanager
def steps_bar(wanted: bool, total: int) -> Iterator[Callable[[str], None]]:
    """Yield a function that shows on the terminal which of a few stages begins; it does nothing without a terminal."""
    with _bar(wanted) as show:
        done = iter(range(total))
        yield lambda what: show(next(done), total, what) if show else None


@contextmanager
def _bar(wanted: bool) -> Iterator[Callable[[float, float, str], None] | None]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    console = Console(stderr=True)
    if not wanted or not console.is_terminal:
        yield None
        return
    columns = (
        BarColumn(),
        TextColumn("{task.percentage:.0f} %"),
        TimeRemainingColumn(),
        TextColumn("{task.description}"),
    )
    bar = Progress(*columns, console=console, transient=True)
    task = bar.add_task("", total=1.0)

    def show(done: float, total: float, what: str) -> None:
        bar.start()  # a short run never calls this function and so shows no bar
        bar.update(task, completed=done, total=total, description=what)

    try:
        yield show
    finally:
        bar.stop()
