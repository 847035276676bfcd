"""Scenes of the gallery and the components in them."""

from __future__ import annotations

from functools import cache

import models
from acausal import Model
from acausal.flatten.collected_statements import collect_statements
from acausal.flatten.component_tree import walk
from models.signals import Crane, MotorDrive, QuarterCar, RectifierDrive, Wiper
from models.vehicle import Car, Shifting

MORE = (Crane, MotorDrive, QuarterCar, RectifierDrive, Wiper, Car, Shifting)
SCENES: dict[str, type[Model]] = models.SCENES | {
    cls.__module__.rpartition(".")[2].replace("_", "-"): cls for cls in MORE
}


def on_command_line(name: str) -> str:
    """Return what the command line takes for a scene."""
    cls = SCENES[name]
    return name if name in models.SCENES else f"{cls.__module__.replace('.', '/')}.py:{cls.__name__}"


@cache
def _classes() -> dict[str, set[type]]:
    trees = {name: collect_statements(cls(), {}).build.root for name, cls in SCENES.items()}
    return {name: {type(part) for part in walk(tree)} for name, tree in trees.items()}


def scenes_with(cls: type) -> list[str]:
    """Return the scenes that contain a component, by the names of their pages."""
    return [name for name, classes in _classes().items() if cls in classes]
