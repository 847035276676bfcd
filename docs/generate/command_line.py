"""The directive `command-line`: the help of every command."""

from __future__ import annotations

from typing import Any

from sphinx.util.docutils import SphinxDirective
from typer.main import get_command

from acausal.cli import app


class CommandLine(SphinxDirective):
    """A section for each command, with its help as a terminal prints it."""

    def run(self) -> list[Any]:
        """Return the sections."""
        group: Any = get_command(app)
        texts = []
        for name, command in group.commands.items():
            width = {"terminal_width": 100, "max_content_width": 100}
            with command.make_context(f"acausal {name}", [], resilient_parsing=True, **width) as context:
                texts.append(f"## acausal {name}\n\n```text\n{command.get_help(context)}\n```")
        return self.parse_text_to_nodes("\n\n".join(texts), allow_section_headings=True)


def setup(app: Any) -> dict[str, bool]:
    """Add the directive."""
    app.add_directive("command-line", CommandLine)
    return {"parallel_read_safe": True}
