"""Errors and warnings of acausal."""

from __future__ import annotations

import os
import sys
import traceback
import warnings
from collections.abc import Callable
from pathlib import Path

PACKAGE = str(Path(__file__).parent) + os.sep


class AcausalError(Exception):
    """Base class of all errors that acausal raises.

    Parameters
    ----------
    message : str
        The fault in the user's names, its place, the likely cause, and the remedy as code.

    Attributes
    ----------
    line : str
        File and line of the user's statement, where the message does not contain them.
    place : str
        Component, file and line, as soon as they are known.
    """

    line = ""
    place = ""

    def __str__(self) -> str:
        where = self.place or self.line
        return f"{where}: {super().__str__()}" if where else super().__str__()

    @property
    def _render_traceback_(self) -> Callable[[], list[str]]:
        """The function by which IPython shows the error, as scripts do: without the lines of libraries."""
        from acausal.tracebacks import is_short, user_traceback

        if not is_short():
            raise AttributeError("full tracebacks are those of IPython")
        return lambda: user_traceback(self, self.__traceback__).splitlines()


class DeclarationError(AcausalError):
    """Invalid declaration or construction of a component (field, value, shape or name)."""


class ConnectError(AcausalError):
    """Invalid connection of two ports, or an invalid graph of connections."""


class UnbalancedModelError(AcausalError):
    """The model does not have as many equations as unknowns."""


class StructurallySingularError(AcausalError):
    """The numbers of equations and unknowns match, but some equations cannot determine their unknowns."""


class InitializationError(AcausalError):
    """Initial values are missing or contradictory, or the solver did not find consistent ones."""


class SimulationError(AcausalError):
    """The integration failed; `result` holds the part before the failure.

    Parameters
    ----------
    message : str
        Time of the failure, the worst residuals by component, and the remedy.
    result : Result, optional
        The part of the simulation before the failure.

    Attributes
    ----------
    begun : bool
        True if at least one step was taken.
    kept : str
        Subject of the sentence that tells where `result` is.
    """

    begun = True
    kept = "The result up to there"

    def __init__(self, message: str, result: object | None = None) -> None:
        super().__init__(message)
        self.result = result

    def __str__(self) -> str:
        return self.text("is in error.result")

    def text(self, where: str = "") -> str:
        """Return the message, followed by the place of the partial result: "is in error.result"."""
        message = super().__str__()
        if not where or self.result is None or not self.begun:
            return message
        return f"{message}\n{self.kept} {where}."


class UnitsError(AcausalError):
    """Units that differ for certain, such as those of the two sides of an equation."""


class ExportError(AcausalError):
    """A result or a model cannot be written."""


class AcausalWarning(UserWarning):
    """A doubtful result or model, or a setting without effect."""


def user_line() -> str:
    """Return file and line of the innermost statement outside this package."""
    frame = sys._getframe(1)
    # Compare module names: generated functions have no file.
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == __package__:
        frame = frame.f_back
    return f"{frame.f_code.co_filename}:{frame.f_lineno}"


def line_in(error: BaseException) -> str:
    """Return file and line of the innermost frame of a traceback outside this package, "" if there is none."""
    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        if not frame.filename.startswith(PACKAGE) and "/site-packages/" not in frame.filename:
            return f"{frame.filename}:{frame.lineno}"
    return ""


# Frames to skip: numpy and contextlib decorate functions of this package.
SKIPPED = (__package__, "numpy", "contextlib")


def caution(text: str) -> None:
    """Warn at the user's line, the innermost one outside this package.

    Parameters
    ----------
    text : str
        The doubt in the user's names, its place and the remedy.
    """
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] in SKIPPED:
        level, frame = level + 1, frame.f_back
    warnings.warn(AcausalWarning(text), stacklevel=level)
