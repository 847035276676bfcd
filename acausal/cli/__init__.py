"""The `acausal` command."""

from acausal.cli.app import app, main

__all__ = ["app", "main"]
