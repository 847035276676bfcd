"""The cheapest set of effects within an accuracy: greedy search, each step verified by a simulation."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping, Sequence
from typing import Any

from acausal.study.effects.effect_rows import EffectRow

Search = Generator[Mapping[str, Any], EffectRow, EffectRow]


def search(
    singles: Sequence[EffectRow],
    reference: EffectRow,
    standing: EffectRow,
    outputs: Sequence[str],
    accuracy: float,
    fits: Callable[[Mapping[str, Any]], dict[str, Any]],
) -> Search:
    """Search greedily: yield the choices to measure, receive the row of each, and return the cheapest row.

    The search starts at the reference and adds switched effects, the largest saving first, as long as the outputs stay
    within the accuracy and the scene becomes cheaper.

    Parameters
    ----------
    singles : sequence of EffectRow
        Rows with one switched effect each.
    reference, standing : EffectRow
        The reference, and the scene with its own choices.
    outputs : sequence of str
        Outputs that must stay within the accuracy.
    accuracy : float
        Largest change as a fraction of an output's range.
    fits : callable
        Function from choices to those whose part exists together with the others.
    """

    def is_good(row: EffectRow) -> bool:
        return not row.error and row.change(outputs) <= accuracy

    best = reference
    candidates = [row for row in singles if is_good(row) and row.cheaper(reference)]
    for single in sorted(candidates, key=lambda row: row.seconds):
        wanted = fits({**best.choices, **single.choices})
        if wanted == best.choices or not single.choices.items() <= wanted.items():
            continue
        tried = single if wanted == single.choices else (yield wanted)
        # Noise may hide that a step is slower; compare with the reference too, so that such steps do not add up.
        if is_good(tried) and tried.cheaper(best) and tried.cheaper(reference):
            best = tried
    return standing if is_good(standing) and standing.cheaper(best) else best


def cheapest(
    searches: Mapping[str, Search], measure: Callable[[list[Mapping[str, Any]]], list[EffectRow]]
) -> dict[str, EffectRow]:
    """Run searches in parallel and return the result of each.

    Parameters
    ----------
    searches : mapping of str to generator
        From `search`, by name.
    measure : callable
        Function from a list of choices to a row for each.
    """
    found: dict[str, EffectRow] = {}
    answers: dict[str, Any] = dict.fromkeys(searches)
    while answers:
        requests = {}
        for name, answer in answers.items():
            try:
                requests[name] = searches[name].send(answer)
            except StopIteration as end:
                found[name] = end.value
        answers = dict(zip(requests, measure(list(requests.values())), strict=True))
    return {name: found[name] for name in searches}
