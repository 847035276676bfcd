"""The `acausal` command."""

from acausal.cli import effects, study
from acausal.cli.app import app, main

__all__ = ["app", "effects", "main", "study"]
