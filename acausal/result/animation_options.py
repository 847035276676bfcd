"""Options of animations, checked before any work is done."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from acausal.animation.camera import VIEWS
from acausal.animation.frames import FRAMES
from acausal.errors import DeclarationError
from acausal.language.value_checks import shown as code
from acausal.result.lookup import Key

PAGES, FILMS = (".html", ".htm"), (".gif", ".mp4")
ENDINGS = (*PAGES, *FILMS, ".png")
EXAGGERATED = 1000  # largest scale of deformations
SMALLEST, LARGEST = 64, 4096  # width and height of a picture in pixels
FASTEST = (
    50  # frames per second: the delays of a GIF are multiples of 0.01 s, and browsers slow down those below 0.02 s
)


@dataclass(frozen=True)
class AnimationOptions:
    """Options of an animation: the arguments of `Result.animate`."""

    frames: int = FRAMES
    plots: Sequence[Key] = ()
    values: Sequence[str] = ()
    title: str = ""
    deformation: float = 1.0
    trails: Sequence[Key] = ()
    size: tuple[int, int] | None = None
    view: str | None = None
    fps: int | None = None

    def check(self, path: str | Path) -> None:
        """Raise DeclarationError for invalid options, and for those that the kind of file does not have."""
        check_frames(self.frames)
        for name, example in (("plots", "crank.phi"), ("values", "bending moment"), ("trails", "rod.frame_b")):
            check_list(name, getattr(self, name), example)
        number = not isinstance(self.deformation, bool) and isinstance(self.deformation, int | float | np.number)
        if not number or not 1 <= self.deformation <= EXAGGERATED:
            raise DeclarationError(f"deformation is a number from 1 to {EXAGGERATED}, not {code(self.deformation)}.")
        if not isinstance(self.title, str):
            raise DeclarationError(f"title is a text, not {code(self.title)}.")
        if self.view is not None and self.view not in VIEWS:
            raise DeclarationError(f"view is {', '.join(VIEWS[:-1])} or {VIEWS[-1]}, not {code(self.view)}.")
        self._check_picture(ending(path))

    def _check_picture(self, suffix: str) -> None:
        """Check the size and the rate of a film or still."""
        if self.size is not None:
            sizes = self.size if isinstance(self.size, Sequence) and not isinstance(self.size, str) else ()
            if len(sizes) != 2 or not all(_whole(n) and SMALLEST <= n <= LARGEST for n in sizes):
                raise DeclarationError(
                    f"size is width and height in pixels, such as (800, 600), each {SMALLEST} to {LARGEST}, not "
                    f"{code(self.size)}."
                )
            if suffix in PAGES:
                raise DeclarationError(
                    "size is for .gif, .mp4 and .png; a page is as large as its window. Leave it out."
                )
        if self.fps is not None:
            if not _whole(self.fps) or not 1 <= self.fps <= FASTEST:
                raise DeclarationError(f"fps is a whole number from 1 to {FASTEST}, not {code(self.fps)}.")
            if suffix not in FILMS:
                raise DeclarationError("fps is for .gif and .mp4; a page draws as often as its screen. Leave it out.")


def ending(path: str | Path) -> str:
    """Return the suffix of a name in lower case."""
    return Path(path).suffix.lower()


def check_frames(frames: Any) -> None:
    """Raise DeclarationError if a number of frames is invalid."""
    if not _whole(frames) or frames < 2:
        raise DeclarationError(f"frames is a whole number, 2 or more, not {code(frames)}.")


def check_list(name: str, given: Any, example: str) -> None:
    """Raise DeclarationError if an argument is not a list."""
    if isinstance(given, str) or not isinstance(given, Sequence):
        raise DeclarationError(f'{name} is a list, such as ["{example}"], not {code(given)}.')


def _whole(value: Any) -> bool:
    return isinstance(value, int | np.integer) and not isinstance(value, bool)
