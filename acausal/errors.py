"""Errors of acausal: what is wrong in the user's names, where, why, and the remedy."""

from __future__ import annotations

import os
import sys
import traceback
import warnings
from pathlib import Path

PACKAGE = str(Path(__file__).parent) + os.sep


class AcausalError(Exception):
    """Base class of every error that acausal raises on purpose.

    Parameters
    ----------
    message : str
        What is wrong, in the user's names; where; the likely cause; the remedy as code.

    Attributes
    ----------
    line : str
        File and line of the user's statement, where the message itself does not say it.
    place : str
        Component, file and line, once they are known.
    """

    line = ""
    place = ""

    def __str__(self) -> str:
        where = self.place or self.line
        return f"{where}: {super().__str__()}" if where else super().__str__()


class DeclarationError(AcausalError):
    """A component is declared or constructed wrongly (field, value, shape, name)."""


class ConnectError(AcausalError):
    """Two ports cannot be connected, or a graph of connections cannot be right."""


class UnbalancedModelError(AcausalError):
    """The model does not have as many equations as unknowns."""


class StructurallySingularError(AcausalError):
    """Counts match, but some equations cannot determine the unknowns that they contain."""


class InitializationError(AcausalError):
    """No consistent initial values: missing, contradictory, or not found."""


class SimulationError(AcausalError):
    """The integration failed; `result` holds what was computed until then.

    Parameters
    ----------
    message : str
        Time of the failure, the worst residuals by component, and the remedy.
    result : Result, optional
        The part of the simulation before the failure.

    Attributes
    ----------
    begun : bool
        Whether a step was taken.
    kept : str
        What `result` is, to begin a sentence.
    """

    begun = True
    kept = "The result up to there"

    def __init__(self, message: str, result: object | None = None) -> None:
        super().__init__(message)
        self.result = result

    def __str__(self) -> str:
        return self.text("is in error.result")

    def text(self, where: str = "") -> str:
        """Return the message, and where what was computed is found: "is in error.result"."""
        message = super().__str__()
        if not where or self.result is None or not self.begun:
            return message
        return f"{message}\n{self.kept} {where}."


class UnitsError(AcausalError):
    """The two sides of an equation certainly have different units."""


class ExportError(AcausalError):
    """A result or a model cannot be written."""


class AcausalWarning(UserWarning):
    """The result solves the equations but may not be what the user wants; or a setting has no effect."""


def user_line() -> str:
    """Return file and line of the innermost statement outside this package."""
    frame = sys._getframe(1)
    # By the name of the module: generated functions have no file.
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == __package__:
        frame = frame.f_back
    return f"{frame.f_code.co_filename}:{frame.f_lineno}"


def line_in(error: BaseException) -> str:
    """Return file and line of the innermost statement outside this package that an error went through, "" if there is none."""
    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        if not frame.filename.startswith(PACKAGE) and "/site-packages/" not in frame.filename:
            return f"{frame.filename}:{frame.lineno}"
    return ""


# numpy and contextlib decorate some of our functions.
SKIPPED = (__package__, "numpy", "contextlib")


def caution(text: str) -> None:
    """Warn with the user's line: the innermost one outside this package.

    Parameters
    ----------
    text : str
        What is doubtful, in the user's names; where; the remedy.
    """
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] in SKIPPED:
        level, frame = level + 1, frame.f_back
    warnings.warn(AcausalWarning(text), stacklevel=level)
