"""The `acausal` command."""

from acausal.cli import effects, export, study
from acausal.cli.app import app, main

__all__ = ["app", "effects", "export", "main", "study"]
