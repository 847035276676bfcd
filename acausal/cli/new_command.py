"""The command new: a commented model in a file, to start from."""

from __future__ import annotations

import os
import re
from importlib.resources import files
from pathlib import Path
from typing import Annotated

import typer

from acausal.cli.app import app
from acausal.cli.common import running
from acausal.errors import DeclarationError
from acausal.result import shown_name
from acausal.result.files import whole

MODEL = "new_model.txt"  # with NAME for the class and FILE for the file without its ending


@app.command("new")
def new(
    file: Annotated[str, typer.Argument(metavar="FILE.py", help="Name of the file, which must not exist.")],
) -> None:
    """Write a commented model that runs, to be changed."""
    with running():
        path = Path(file)
        if path.suffix != ".py":
            raise DeclarationError(f"{shown_name(file)} does not end in .py.")
        if os.path.lexists(path):
            raise DeclarationError(f"{shown_name(file)} exists; choose another name.")
        name = "".join(word[:1].upper() + word[1:] for word in re.split(r"[\W_]+", path.stem))
        if not name.isidentifier():
            raise DeclarationError(f"{shown_name(file)} gives no name of a class: begin it with a letter.")
        with whole(path) as stream:
            text = (files(__package__) / MODEL).read_text(encoding="utf-8")
            stream.write(text.replace("NAME", name).replace("FILE", path.stem))
        typer.echo(
            f"Wrote {file}. Run it:\n    acausal simulate {file}:{name} --stop-time 2 --animate {path.stem}.html"
        )
