"""Effects: the result of a study of effects, with tables, files and choices to apply."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from acausal.language.data import same
from acausal.policy import POLICY
from acausal.result.files import whole
from acausal.result.tables import Table, write_csv
from acausal.study.effects.effect_rows import ALL, EffectRow, Interaction, as_fast
from acausal.study.effects.effect_tables import brief_changes, changes, columns, number, sets, together
from acausal.study.effects.listing import Effect

WIDTH = 100
ELSEWHERE = "(the changes of every output: --csv FILE, --markdown FILE)"


@dataclass(frozen=True)
class Effects:
    """Changes and costs of the effects of a scene.

    Parameters
    ----------
    scene : str
        Name of the model.
    accuracy, tolerance : float
        As given to `effects`.
    effects : tuple of Effect
        All effects of the fullest scene.
    reference, standing : EffectRow
        The reference of all comparisons, and the scene with its own choices.
    refused : str
        Why the fullest scene is not the reference, "" if it is.
    floor : EffectRow
        The reference at a tenth of the tolerance: smaller changes are integration errors.
    rows : tuple of EffectRow
        Rows with one switched effect each, the largest change first.
    interactions : tuple of Interaction
        Interactions of pairs, the largest first.
    untried : int
        Number of untried pairs.
    idle : tuple of mapping
        Switches that leave the equations unchanged, as the effect plays no role in the scene.
    cheapest : mapping of str to EffectRow
        The cheapest set for "all outputs" and, if there are several, for each output.
    choices : mapping of str to mapping
        All choices of these sets by path.

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
    reference: EffectRow
    standing: EffectRow
    refused: str
    floor: EffectRow
    rows: tuple[EffectRow, ...]
    interactions: tuple[Interaction, ...]
    untried: int
    idle: tuple[Mapping[str, Any], ...]
    cheapest: Mapping[str, EffectRow]
    choices: Mapping[str, Mapping[str, Any]]

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the compared outputs."""
        return tuple(self.reference.largest)

    def switched(self, name: str = ALL) -> dict[str, Any]:
        """Return the choices of a cheapest set that differ from the scene's own."""
        standing = {effect.path: effect.value for effect in self.effects}
        return {path: value for path, value in self.choices[name].items() if not same(value, standing[path])}

    def table(self) -> str:
        """Return everything as text for a terminal, at most 100 columns wide."""
        labelled = self._labelled()
        shown = changes(labelled, self.outputs).text(narrow=True)
        if max(map(len, shown.splitlines())) > WIDTH:
            shown = f"{brief_changes(labelled).text(narrow=True)}\n{ELSEWHERE}"
        found = [part.text(narrow=True) if isinstance(part, Table) else _wrap(part) for part in self._findings()]
        return "\n\n".join([_wrap(self._heading()), shown, *found, "\n".join(map(_wrap, self._recommendation()))])

    def to_markdown(self, path: str | Path) -> None:
        """Write everything as Markdown, including root mean square changes.

        Parameters
        ----------
        path : str or Path
            Name of the file, which is written atomically.
        """
        parts = [
            f"# Effects of {self.scene}",
            self._heading(),
            "Each change: the largest, then the root mean square.",
            changes(self._labelled(), self.outputs, rms=True),
            *self._findings(),
            *self._recommendation(),
        ]
        with whole(path) as file:
            file.write("\n\n".join(p.markdown() if isinstance(p, Table) else p for p in parts) + "\n")

    def to_csv(self, path: str | Path) -> None:
        """Write a row for each variant: kind, choices, changes and costs.

        Parameters
        ----------
        path : str or Path
            Name of the file, which is written atomically.
        """
        kinds = [
            ("reference", self.reference),
            ("as it stands", self.standing),
            (f"tolerance / {POLICY.study.tighter:g}", self.floor),
        ]
        kinds += [("effect", row) for row in self.rows]
        kinds += [(f"cheapest for {name}", row) for name, row in self.cheapest.items()]
        write_csv(path, columns(kinds, self.outputs))

    def document(self) -> dict[str, Any]:
        """Return everything as mappings, lists, texts and numbers."""
        return asdict(self)

    def _heading(self) -> str:
        r = self.reference
        which = "the scene as it stands" if self.refused else "the fullest scene"
        if not self.refused and not self.standing.choices:
            which += ", which is the scene as it stands"
        words = (
            f"{self.scene}: what each effect changes and costs, next to {which} ({r.equations} equations, {r.operations} "
            f"operations, {r.steps} steps, {r.seconds:.3g} s at tolerance {self.tolerance:g}). Changes are the largest, "
            "as a fraction of the range of the output."
        )
        if self.refused:
            words += f" The fullest scene is not the reference: {self.refused}"
        return words

    def _labelled(self) -> list[tuple[str, EffectRow]]:
        """Return the rows to show, each with its label."""
        labelled = [(row.name, row) for row in self.rows]
        if self.standing.choices:
            labelled.append(("the scene as it stands", self.standing))
        if not self.floor.error:
            labelled.append((f"(tolerance {self.tolerance / POLICY.study.tighter:g})", self.floor))
        return labelled

    def _findings(self) -> Iterator[str | Table]:
        """Yield failures, idle effects, interactions, and the cheapest sets."""
        for row in self.rows:
            if row.error:
                yield f"{row.name} failed: {row.error}"
        if self.idle:
            names = ", ".join(dict.fromkeys(path for choices in self.idle for path in choices))
            yield f"Irrelevant to this scene, because switching them changes no equation: {names}."
        worth = self._notable_interactions()
        if worth:
            yield together(worth)
        if self.interactions:
            yield self._interaction_words(bool(worth))
        yield f"Cheapest sets whose change stays within {self.accuracy:g}:"
        yield sets(self.cheapest)

    def _interaction_words(self, found: bool) -> str:
        if found:
            words = "An interaction is the change by both effects minus the sum of their single changes."
        else:
            words = f"None of {len(self.interactions)} pairs interacts: the change by both is the sum of the single changes."
        if self.untried:
            words += f" {self.untried} further pairs with smaller changes were not tried."
        return words

    def _notable_interactions(self) -> list[tuple[Interaction, str]]:
        """Return interactions above the integration error and a fraction of the accuracy, with the most affected output."""
        errors = self.floor.largest
        least = {name: max(POLICY.study.worth * self.accuracy, 3 * errors.get(name, 0.0)) for name in self.outputs}
        worth = []
        for i in self.interactions:
            where = max(i.size, key=lambda name: i.size[name] / least[name], default="")
            if i.error or i.size[where] > least[where]:
                worth.append((i, where))
        return sorted(worth, key=lambda pair: -pair[0].size.get(pair[1], 0.0))

    def _recommendation(self) -> Iterator[str]:
        best, standing = self.cheapest[ALL], self.standing
        if best.choices:
            yield f"For all outputs: {_saving(best, self.reference)}."
        else:
            yield (
                f"For all outputs together nothing can be left out: every saving changes one of them by more than "
                f"{self.accuracy:g}."
            )
        groups: dict[str, list[str]] = {}
        for name, row in self.cheapest.items():
            if name != ALL and row.choices != best.choices:
                groups.setdefault(_saving(row, self.reference), []).append(name)
        for words, names in groups.items():
            yield f"For {' or '.join(names)} alone: {words}."
        if not self.refused and not standing.error and standing.change() > self.accuracy:
            yield (
                f"The scene as it stands is less accurate: it differs by {number(standing.change())} from the fullest "
                f"({standing.worst})."
            )
        for name, error in self.floor.largest.items():
            if error > self.accuracy:
                yield (
                    f"The integration error of {name} is {number(error)}, so smaller changes of it are meaningless: take a "
                    f"tolerance below {self.tolerance:g}, or leave that output out."
                )
        switched = " ".join(f"--set {path}={value}" for path, value in self.switched().items())
        if switched:
            yield f"From the scene as it stands to the set for all outputs: {switched}"


def _saving(row: EffectRow, reference: EffectRow) -> str:
    """Describe a set and its saving."""
    if not row.choices:
        return "all effects of the reference"
    if as_fast(row, reference):
        return f"{row.name}; {row.work:.2f} of the operations, no measurable difference in time"
    times = f"{reference.seconds / row.seconds:.2g} times faster"
    return f"{row.name}; {times} ({row.seconds:.3g} s instead of {reference.seconds:.3g} s)"


def _wrap(words: str) -> str:
    return "\n".join(textwrap.wrap(words, WIDTH, break_on_hyphens=False, break_long_words=False))
