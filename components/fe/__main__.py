"""`python -m components.fe reduce FILE`: reduce the matrices of an FE program, or a mesh, to a few modes."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from acausal import DeclarationError
from acausal.cli.common import Quiet, running
from acausal.cli.option_values import pair, value_of
from acausal.cli.output import check_outputs
from acausal.cli.progress import steps_bar
from acausal.cli.streams import escape_unencodable, flushed
from acausal.result import shown_name
from components.fe import ReducedBody, read_mesh, read_sid, reduce_body
from components.fe.formats.readers import SID, reader_of
from components.fe.nodes import rows_of

MODES = 10
SHOWN = 20  # modes listed in the summary

File = Annotated[
    str,
    typer.Argument(
        help="Matrices: .npz, CalculiX .sti, Abaqus _STIF1.mtx, Matrix Market .mtx, Ansys .full, Nastran .op4 (with their "
        "other files in the same folder); a SID; or a mesh.",
        show_default=False,
    ),
]
Out = Annotated[str, typer.Option(help="File of the reduced body.", metavar="body.npz", show_default=False)]
Frames = Annotated[
    list[str] | None,
    typer.Option("--frame", metavar="NAME=I,J,K", help="A frame at these nodes, counted from 0; may be repeated."),
]
ByNumber = Annotated[bool, typer.Option("--by-number", help="I, J, K are node numbers of the file.")]
Hold = Annotated[
    str,
    typer.Option(metavar="NAME|mean-axis|I,J,K", help="What the reference frame is fixed to: a frame, or nodes."),
]
Modes = Annotated[
    int | None, typer.Option(metavar="N", help=f"Number of modes; {MODES} if not given.", show_default=False)
]
Frequency = Annotated[
    float | None, typer.Option(metavar="HZ", help="All modes up to this frequency.", show_default=False)
]
Basis = Annotated[str, typer.Option(metavar="held|free|craig-bampton", help="Which modes.")]
Damping = Annotated[float, typer.Option(metavar="R", help="Damping ratio of every mode.")]
Length = Annotated[float, typer.Option(metavar="S", help="Unit of length of the file in m: 1e-3 for mm.")]
Mass = Annotated[float, typer.Option(metavar="S", help="Unit of mass of the file in kg: 1e3 for mm, N and Mg.")]
MeshMaterial = Annotated[
    str | None, typer.Option(metavar="E,NU,RHO", help="Of a mesh: in Pa, 1 and kg/m3.", show_default=False)
]

app = typer.Typer(
    help="Bodies from matrices of FE programs.",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


@app.callback()
def commands() -> None:
    """Bodies from matrices of FE programs."""


@app.command("reduce")
def reduce(
    file: File,
    out: Out,
    frames: Frames = None,
    by_number: ByNumber = False,
    hold: Hold = "mean-axis",
    modes: Modes = None,
    frequency: Frequency = None,
    basis: Basis = "held",
    damping: Damping = 0.0,
    length: Length = 1.0,
    mass: Mass = 1.0,
    material: MeshMaterial = None,
    quiet: Quiet = False,
) -> None:
    """Reduce the matrices of a body to a few modes, for `FEBody(reduced="body.npz")`."""
    with running(quiet=quiet), steps_bar(not quiet, 3) as show:
        check_outputs((file,), out=out)
        if Path(out).suffix.lower() != ".npz":
            raise DeclarationError(f"--out must end in .npz, such as body.npz, not `{shown_name(out)}`.")
        scales = {"length": _scale("--length", length), "mass": _scale("--mass", mass)}
        show("reading")
        if Path(file).suffix.lower() in SID:
            _unused(f"the SID {shown_name(file)} is already reduced", frame=frames, modes=modes, material=material)
            body = read_sid(file, **scales)
        else:
            if frequency is not None:
                _unused("--frequency determines the number of modes", modes=modes)
            M, K, nodes = _matrices(file, material, scales)
            places = _frames(frames or [], nodes, by_number)
            held = _hold(hold, places, nodes, by_number)
            options = {"modes": MODES if modes is None else modes, "frequency": frequency, "basis": basis}
            show("reducing")
            body = reduce_body(M, K, nodes, frames=places, hold=held, damping=damping, **options)
        show("writing")
        body.save(out)
        if not quiet:
            typer.echo(_summary(body, out))


def main() -> None:
    """Run the command line."""
    escape_unencodable()
    try:
        app(prog_name="python -m components.fe")
    except SystemExit as end:
        sys.exit(flushed(end.code))


def _matrices(file: str, material: str | None, scales: dict[str, float]) -> tuple[Any, Any, Any]:
    read = reader_of(file)
    if read is not None:
        _unused(f"{shown_name(file)} holds matrices", material=material)
        return read(file, **scales)
    if material is None:
        raise DeclarationError(f"{shown_name(file)} is not a file of matrices. For a mesh, add --material E,NU,RHO.")
    numbers = value_of(material, "--material")
    if not (isinstance(numbers, tuple) and len(numbers) == 3 and all(isinstance(x, int | float) for x in numbers)):
        raise DeclarationError(f"--material must be E,NU,RHO, such as 2.1e11,0.3,7850, not `{shown_name(material)}`.")
    E, nu, rho = numbers
    if scales["mass"] != 1:
        raise DeclarationError("--mass does not apply to a mesh: --material is in Pa and kg/m3. Remove --mass.")
    return read_mesh(file, E=E, nu=nu, rho=rho, length=scales["length"])


def _frames(texts: list[str], nodes: Any, by_number: bool) -> dict[str, list[int]]:
    found: dict[str, list[int]] = {}
    for text in texts:
        name, value = pair(text, "--frame must be NAME=I,J,K, such as --frame hinge=0,2,4")
        if name in found:
            raise DeclarationError(f"--frame defines `{shown_name(name)}` twice; remove one.")
        if not name.isidentifier():
            raise DeclarationError(
                f"--frame: `{shown_name(name)}` is not a valid frame name; use letters, digits and underscores."
            )
        found[name] = _nodes(value, f"--frame {name}", nodes, by_number)
    if not found:
        raise DeclarationError("a body needs at least one frame to be connected at: add --frame NAME=I,J,K.")
    return found


def _hold(text: str, frames: dict[str, list[int]], nodes: Any, by_number: bool) -> Any:
    if text in frames or text == "mean-axis":
        return text
    if text[:1].isdigit():
        return tuple(_nodes(text, "--hold", nodes, by_number))
    known = ", ".join([*frames, "mean-axis"])
    raise DeclarationError(f"--hold must be one of {known}, or three nodes I,J,K, not `{shown_name(text)}`.")


def _nodes(text: str, option: str, nodes: Any, by_number: bool) -> list[int]:
    try:
        numbers = [int(part) for part in text.split(",")]
    except ValueError:
        raise DeclarationError(f"{option} must list nodes, such as 0,2,4, not `{shown_name(text)}`.") from None
    return rows_of(nodes, numbers) if by_number else numbers


def _scale(option: str, value: float) -> float:
    if not 0 < value < float("inf"):
        raise DeclarationError(f"{option} must be a positive number, the unit in SI such as 1e-3, not {value:g}.")
    return value


def _unused(why: str, **options: Any) -> None:
    idle = [name for name, given in options.items() if given]
    if idle:
        raise DeclarationError(f"--{idle[0]} does not apply: {why}. Remove it.")


def _summary(body: ReducedBody, out: str) -> str:
    lines = [
        f"{shown_name(out)}: {body.n} modes, {body.mass:.6g} kg, frames {', '.join(i.name for i in body.interfaces)}"
    ]
    lines += [f"  mode {b + 1:3d}  {f:12.6g} Hz" for b, f in enumerate(body.frequencies[:SHOWN])]
    return "\n".join([*lines, f"  ... ({body.n} in all)"] if body.n > SHOWN else lines)


if __name__ == "__main__":
    main()
