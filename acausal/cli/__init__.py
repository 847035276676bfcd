"""The `acausal` command."""

from acausal.cli import effects
from acausal.cli.app import app, main

__all__ = ["app", "effects", "main"]
