"""The command export: a scene as a file for other tools."""

from __future__ import annotations

from typing import Annotated

import typer

from acausal.cli.app import app
from acausal.cli.common import Applied, Quiet, Scene, Set, compile_scene, running
from acausal.cli.output import check_outputs
from acausal.cli.scenes import file_of, find_scene
from acausal.errors import DeclarationError
from acausal.result import shown_name


@app.command("export")
def export(
    scene: Scene,
    settings: Set = None,
    effects: Applied = None,
    fmu: Annotated[
        str | None,
        typer.Option(metavar="FILE.fmu", help="Write a Functional Mock-up Unit: Model Exchange and Co-Simulation."),
    ] = None,
    fmi_version: Annotated[
        int | None, typer.Option(metavar="2|3", help="Version of its interface; 3 if not given.", show_default=False)
    ] = None,
    platforms: Annotated[
        str | None,
        typer.Option(
            metavar="all|NAME,...",
            help="Where it runs, such as windows-x86_64; on platforms like this one if not given.",
        ),
    ] = None,
    free: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="Keep a parameter in the equations even if it is 0; may be repeated."),
    ] = None,
    dae: Annotated[
        str | None, typer.Option(metavar="FILE", help="Write the equations, for `acausal.load_dae` and other programs.")
    ] = None,
    full: Annotated[
        bool, typer.Option("--full", help="Keep unknowns that stay 0, such as motion out of the plane of a machine.")
    ] = False,
    quiet: Quiet = False,
) -> None:
    """Write a scene as a file that other tools simulate."""
    with running(quiet=quiet):
        from acausal.export import check_fmu

        version, names = _checked_options(fmu, dae, fmi_version, platforms, free)
        check_outputs((file_of(scene), effects), fmu=fmu, dae=dae)
        enclosed = check_fmu(fmu, version, names) if fmu is not None else {}
        compiled = compile_scene(scene, find_scene(scene), settings, effects)
        if fmu is not None:
            from acausal.export import export_fmu

            export_fmu(compiled, fmu, fmi_version=version, platforms=names, free=tuple(free or ()), full=full)
        elif dae is not None:
            from acausal.export import export_dae

            export_dae(compiled, dae, full=full)
        if not quiet:
            about = f": FMI {version}.0, for {', '.join(enclosed.values())}" if enclosed else ""
            typer.echo(f"wrote {shown_name(fmu or dae)}{about}")


def _checked_options(
    fmu: str | None, dae: str | None, fmi_version: int | None, platforms: str | None, free: list[str] | None
) -> tuple[int, tuple[str, ...]]:
    """Return version and platforms; raise DeclarationError for options that exclude each other."""
    if (fmu is None) == (dae is None):
        raise DeclarationError("export writes one file: give --fmu FILE.fmu or --dae FILE.")
    options = {"--fmi-version": fmi_version, "--platforms": platforms, "--free": free}
    if dae is not None and (idle := [name for name, given in options.items() if given]):
        raise DeclarationError(f"{idle[0]} does not apply to --dae {shown_name(dae)}; leave it out, or give --fmu.")
    names = tuple(name.strip() for name in (platforms if platforms is not None else "own").split(","))
    return 3 if fmi_version is None else fmi_version, names
