"""The command show: parameters, variables and ports of a component."""

from __future__ import annotations

import inspect
from importlib import import_module
from typing import Annotated

import typer

from acausal.cli.app import app
from acausal.cli.common import running
from acausal.errors import DeclarationError
from acausal.nearest import most_similar
from acausal.result import shown_name

PARTS = "components"  # the package of components: this package does not depend on it


@app.command("show")
def show(
    name: Annotated[
        str,
        typer.Argument(
            metavar="NAME",
            help="A component, such as rotational.Damper; without a domain, those of all domains. Part of a name lists all "
            "matches.",
        ),
    ] = "",
) -> None:
    """Show parameters, variables and ports of a component; without a name, list all components."""
    with running():
        every = import_module(PARTS).table()
        word = name.lower()
        exact = [e for e in every if word in (e.name.lower(), e.name.rpartition(".")[2].lower())]
        near = exact or [e for e in every if word in f"{e.name} {e.domain}".lower()]
        if not near:
            raise DeclarationError(_unknown(name, [e.name for e in every]))
        tables = (f"{PARTS}.{e.name}: {inspect.getdoc(e.cls)}" for e in near)
        typer.echo("\n\n\n".join(tables) if exact or len(near) == 1 else repr(type(every)(near)))


def _unknown(name: str, known: list[str]) -> str:
    near = most_similar(name.rpartition(".")[2], [own.rpartition(".")[2] for own in known])
    alike = [own for own in known if near and own.rpartition(".")[2] == near]
    remedy = f"; did you mean {' or '.join(f'`{own}`' for own in alike)}?" if alike else "."
    return f"there is no component `{shown_name(name)}`{remedy} `acausal show` lists all."
