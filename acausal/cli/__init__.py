"""The `acausal` command."""

from acausal.cli import effects_command, export_command, new_command, show_command, study_command
from acausal.cli.app import app, main

__all__ = ["app", "effects_command", "export_command", "main", "new_command", "show_command", "study_command"]
