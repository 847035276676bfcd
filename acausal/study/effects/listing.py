"""The effects of a scene, its fullest variant, and settings that are compatible."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from acausal.flatten.component_tree import join, members
from acausal.flatten.instantiate import Instantiation
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.language.data import same


@dataclass(frozen=True)
class Effect:
    """An effect of a scene.

    Parameters
    ----------
    path : str
        Path of the field, such as "crank_bar.axial".
    description : str
        Its description.
    value : object
        The current choice.
    choices : tuple
        All choices, the most complete first.
    tries : tuple
        Choices that a study tries, including the current one, the most complete first.
    """

    path: str
    description: str
    value: Any
    choices: tuple[Any, ...]
    tries: tuple[Any, ...]


def effects_of(model: Component, settings: Mapping[str, Any] | None = None) -> tuple[Effect, ...]:
    """Return the effects of a model.

    A part takes an effect from an owner that has one of the same name: the effect is then listed once, as the owner's.

    Parameters
    ----------
    model : Component
        An instance, such as SliderCrank(crank="rigid").
    settings : mapping of str to value, optional
        Values by path that replace those of the model.
    """
    return tuple(_listed(Instantiation(model, settings).root, frozenset()))


def fullest(model: Component, settings: Mapping[str, Any]) -> tuple[tuple[Effect, ...], dict[str, Any]]:
    """Return the effects of the fullest scene, with the scene's own values, and the choices of the fullest scene by path.

    Every effect takes the most complete of its tried choices, which may create parts with further effects.

    Parameters
    ----------
    model : Component
        The scene.
    settings : mapping of str to value
        Values by path that replace those of the model.
    """
    found: dict[str, Effect] = {}
    chosen: dict[str, Any] = {}
    while True:
        listed = effects_of(model, fitting(model, {**settings, **chosen}))
        new = [effect for effect in listed if effect.path not in found]
        if not new:
            there = {effect.path for effect in listed}
            return tuple(e for p, e in found.items() if p in there), {p: v for p, v in chosen.items() if p in there}
        # The effects of a part are known only after those of its owner are chosen.
        top = min(_depth(effect.path) for effect in new)
        for effect in new:
            if _depth(effect.path) == top:
                found[effect.path] = effect
                chosen[effect.path] = effect.tries[0]


def fitting(model: Component, settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return the settings whose part exists in the scene they define; settings of the model itself are always kept.

    Parameters
    ----------
    model : Component
        The scene.
    settings : mapping of str to value
        Values by path; {"crank": "rigid", "crank_bar.axial": "none"} loses the second, as a rigid bar has no stretch.
    """
    kept = {path: value for path, value in settings.items() if not _depth(path)}
    for depth in sorted({_depth(path) for path in settings} - {0}):
        known = set(Instantiation(model, kept).settable())
        kept |= {p: value for p, value in settings.items() if _depth(p) == depth and p in known}
    return kept


def _listed(component: Component, owners: frozenset[str]) -> Iterator[Effect]:
    own = {n: d for n, d in component.fields.items() if isinstance(d, f.Structural) and d.effect}
    for name, declared in own.items():
        if name not in owners:
            yield _effect(join(component._path, name), declared, getattr(component, name))
    for member in members(component):
        yield from _listed(member, frozenset(own))


def _effect(path: str, declared: f.Structural, value: Any) -> Effect:
    choices = declared.choices or ()
    wanted: Iterable[Any] = choices if declared.tries is None else (*declared.tries, value)
    tries = tuple(c for c in choices if any(same(c, w) for w in wanted))
    return Effect(path, declared.description, value, choices, tries)


def _depth(path: str) -> int:
    return path.count(".")
