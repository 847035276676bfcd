"""Load: distributed forces and moments on a beam."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from acausal import DeclarationError
from components.beams.quadrature import POINTS, WEIGHTS

# Part of an element in which a load ends, over its length: less is round-off of s.
LEAST = 1e-9


@dataclass(frozen=True)
class Load:
    """Force and moment per length along a beam.

    Both are vectors, or functions f(s, t, r, v, R) that return one: s is x / length, t the time in s, r and v the place and
    velocity of the axis there in m and m/s, resolved in the world, and R the orientation of the section: R.T is the rotation
    matrix from the world, and R.w the angular velocity in rad/s, resolved in the section. Four points of Gauss an element
    are exact for loads up to the fourth power of s. Loads that turn with the section are not conservative.

    Parameters
    ----------
    force : array or callable, shape (3,)
        Force per length in N/m.
    moment : array or callable, shape (3,)
        Moment per length in N.m/m.
    axes : "world" or "section"
        Axes in which both are resolved.
    between : (float, float)
        First and last s of the load.

    Raises
    ------
    DeclarationError
        The axes are unknown, `between` is not within 0 and 1 in ascending order, or a function has other arguments.
    """

    force: Any = None
    moment: Any = None
    axes: str = "world"
    between: tuple[float, float] = (0.0, 1.0)

    def __post_init__(self) -> None:
        if self.axes not in ("world", "section"):
            raise DeclarationError(f'axes of a Load are "world" or "section", not {self.axes!r}.')
        first, last = self.between
        if not 0 <= first < last <= 1:
            raise DeclarationError(
                f"between of a Load is (first, last) with 0 <= first < last <= 1, not {self.between!r}."
            )
        for name, value in (("force", self.force), ("moment", self.moment)):
            if callable(value) and not _takes_five(value):
                raise DeclarationError(
                    f"{name} of a Load is a vector or a function f(s, t, r, v, R), with five arguments."
                )

    def part(self, k: int, parts: int) -> Load | None:
        """Return the load on one of several equal parts of the beam, None if there is none."""
        first, last = (min(max(parts * s - k, 0.0), 1.0) for s in self.between)
        if last - first < LEAST:
            return None

        def mapped(value: Any) -> Any:
            return (lambda s, *given: value((k + s) / parts, *given)) if callable(value) else value

        return replace(self, force=mapped(self.force), moment=mapped(self.moment), between=(first, last))

    def points(self, elements: int) -> Iterator[tuple[float, float, list[int]]]:
        """Yield place s from -1 to 1 in an element, weight over half its length, and the elements with this point."""
        whole = []
        for j in range(elements):
            first, last = (min(max(2 * (elements * s - j) - 1, -1.0), 1.0) for s in self.between)
            if last - first > 2 - LEAST:
                whole.append(j)
            elif last - first > LEAST:
                half = (last - first) / 2
                yield from (
                    (first + half * (1 + s), weight * half, [j]) for s, weight in zip(POINTS, WEIGHTS, strict=True)
                )
        if whole:
            yield from ((s, weight, whole) for s, weight in zip(POINTS, WEIGHTS, strict=True))

    def at(self, s: float, t: Any, r: Any, v: Any, R: Any) -> tuple[Any, Any]:
        """Return force and moment per length, None where there is none."""
        force, moment = (x(s, t, r, v, R) if callable(x) else x for x in (self.force, self.moment))
        return force, moment


def _takes_five(function: Callable[..., Any]) -> bool:
    try:
        inspect.signature(function).bind(*range(5))
    except TypeError:
        return False
    except ValueError:  # a function of C, which does not tell
        return True
    return True
