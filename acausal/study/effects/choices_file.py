"""Files with choices of effects: written by a study, applied to later runs of the same scene."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path, PurePath
from typing import Any

from acausal.errors import DeclarationError
from acausal.flatten.instantiate import unknown_name
from acausal.language.component import Component
from acausal.result import document, read_text, shown_name
from acausal.study.effects.effect_rows import ALL
from acausal.study.effects.effects_result import Effects
from acausal.study.effects.listing import effects_of, fitting


def choices_document(found: Effects, scene: str, settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return the cheapest set for all outputs as a document.

    Parameters
    ----------
    found : Effects
        The study.
    scene : str
        Name of the scene on the command line.
    settings : mapping of str to value
        Values by path of the study.
    """
    best = found.cheapest[ALL]
    return {
        "scene": scene,
        "settings": dict(settings),
        "accuracy": found.accuracy,
        "outputs": list(found.outputs),
        "change": best.change(),
        "times_faster": found.reference.seconds / best.seconds,
        "effects": dict(found.choices[ALL]),
    }


def with_effects(model: Component, scene: str, path: str | Path, settings: Mapping[str, Any]) -> dict[str, Any]:
    """Merge settings with the choices of a file; settings take precedence.

    Parameters
    ----------
    model : Component
        The scene, not compiled.
    scene : str
        Its name on the command line.
    path : str or Path
        The file.
    settings : mapping of str to value
        Values by path.

    Raises
    ------
    DeclarationError
        If the file cannot be read, contains no choices, is for another scene, or names effects that the scene lacks.
    """
    choices = _read(path, scene)
    _check_names(model, choices, path)
    together = fitting(model, {**choices, **settings})
    return {name: value for name, value in together.items() if name not in settings} | dict(settings)


def _read(path: str | Path, scene: str) -> dict[str, Any]:
    text = read_text(path)
    try:
        found = document(text)
    except ValueError as error:
        what = str(error) if str(error).startswith("has ") else f"is not a JSON document: {error}"
        raise DeclarationError(f"{shown_name(path)} {what}.") from None
    choices = found.get("effects") if isinstance(found, dict) else None
    if not isinstance(choices, dict) or "scene" not in found:
        raise DeclarationError(
            f"{shown_name(path)} contains no choices of effects; `acausal effects {scene} --apply {path}` writes such a file."
        )
    # Compare file names alone: the user's file may have been moved, or named from another directory.
    if PurePath(str(found["scene"])).name != PurePath(scene).name:
        raise DeclarationError(
            f"{shown_name(path)} is for the scene {found['scene']}, not for {scene}; `acausal effects {scene} --apply FILE.json` "
            "writes one for it."
        )
    return choices


def _check_names(model: Component, choices: Mapping[str, Any], path: str | Path) -> None:
    for effect in effects_of(model):
        if effect.path in choices and not any(choices[effect.path] == choice for choice in effect.choices):
            value, allowed = json.dumps(choices[effect.path]), [json.dumps(choice) for choice in effect.choices]
            must = " or ".join(allowed) if len(allowed) == 2 else f"one of {', '.join(allowed)}"
            text = f"`{effect.path}` of {type(model).__name__} is {value}; it must be {must}."
            raise DeclarationError(f"{shown_name(path)}: {text}")
    try:
        known = [effect.path for effect in effects_of(model, fitting(model, choices))]
    except DeclarationError as error:
        raise DeclarationError(f"{shown_name(path)}: {error}") from None
    for name in choices:
        if name not in known:
            message = unknown_name(name, known).replace("in the model", "among the effects of the scene", 1)
            raise DeclarationError(f"{shown_name(path)}: {message}")
