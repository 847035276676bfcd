"""Effects: what a study of effects found, as tables, files and choices to apply."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from acausal.result.files import whole
from acausal.study.effects_listing import Effect, same
from acausal.study.effects_rows import Interaction, Row

ALL = "all outputs"


@dataclass(frozen=True)
class Effects:
    """What the effects of a scene change and cost.

    Parameters
    ----------
    scene : str
        Name of the model.
    accuracy, tolerance : float
        As given to `effects`.
    effects : tuple of Effect
        All effects of the fullest scene.
    reference, standing : Row
        What the others are compared with, and the scene as it stands.
    refused : str
        Why the fullest scene is not the reference, "" if it is.
    floor : Row
        The reference at a tenth of the tolerance: changes below its own are those of the integration.
    rows : tuple of Row
        One switched effect each, the largest change first.
    interactions : tuple of Interaction
        Pairs, the largest interaction first.
    untried : int
        Number of pairs that were left out.
    idle : tuple of mapping
        Switches that leave the equations as they are: the scene does not call for the effect.
    cheapest : mapping of str to Row
        The cheapest set for "all outputs" and, where there are several, for each output.
    choices : mapping of str to mapping
        Every choice of these sets by path.

    Examples
    --------
    >>> found = ac.effects(SliderCrank(), stop_time=1.6)  # doctest: +SKIP
    >>> print(found.table())  # doctest: +SKIP
    >>> ac.simulate(SliderCrank(), stop_time=1.6, parameters=found.choices["all outputs"])  # doctest: +SKIP
    """

    scene: str
    accuracy: float
    tolerance: float
    effects: tuple[Effect, ...]
    reference: Row
    standing: Row
    refused: str
    floor: Row
    rows: tuple[Row, ...]
    interactions: tuple[Interaction, ...]
    untried: int
    idle: tuple[Mapping[str, Any], ...]
    cheapest: Mapping[str, Row]
    choices: Mapping[str, Mapping[str, Any]]

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of what was compared."""
        return tuple(self.reference.largest)

    def switched(self, name: str = ALL) -> dict[str, Any]:
        """Return the choices of a cheapest set that the scene does not make as it stands."""
        standing = {effect.path: effect.value for effect in self.effects}
        return {path: value for path, value in self.choices[name].items() if not same(value, standing[path])}

    def table(self) -> str:
        """Return everything as text for people, at most 120 columns wide."""
        from acausal.study.effects_text import text

        return text(self)

    def to_markdown(self, path: str | Path) -> None:
        """Write everything as Markdown, the root mean square changes as well.

        Parameters
        ----------
        path : str or Path
            Name of the file, written whole or not at all.
        """
        from acausal.study.effects_text import markdown

        with whole(path) as file:
            file.write(markdown(self))

    def to_csv(self, path: str | Path) -> None:
        """Write a row for each trial: what it is for, its choices, changes and costs.

        Parameters
        ----------
        path : str or Path
            Name of the file, written whole or not at all.
        """
        kinds = [("reference", self.reference), ("as it stands", self.standing), ("tolerance / 10", self.floor)]
        kinds += [("effect", row) for row in self.rows]
        kinds += [(f"cheapest for {name}", row) for name, row in self.cheapest.items()]
        costs = ("seconds", "time", "work", "operations", "equations", "equations_less", "steps", "error")
        with whole(path) as file:
            writer = csv.writer(file, lineterminator="\n")
            changes = [f"{name} {kind}" for name in self.outputs for kind in ("largest", "rms")]
            writer.writerow(["kind", "choices", *changes, *costs])
            for kind, row in kinds:
                each = [part.get(name, "") for name in self.outputs for part in (row.largest, row.rms)]
                writer.writerow([kind, row.name, *each, *[getattr(row, cost) for cost in costs]])

    def document(self) -> dict[str, Any]:
        """Return everything as mappings, lists, texts and numbers."""
        return asdict(self)
