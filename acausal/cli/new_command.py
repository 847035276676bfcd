"""The command new: a commented model in a file, to start from."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Annotated

import typer

from acausal.cli.app import app
from acausal.cli.common import running
from acausal.errors import DeclarationError
from acausal.result import shown_name
from acausal.result.files import whole

MODEL = '''"""NAME: a mass on a flexible beam, which swings on a damped hinge."""

import acausal as ac
from acausal import Model, Scalar, chain, fixed, output, parameter
from components import Body, FlexibleBeam, Revolute, World
from components.rotational import Damper


class NAME(Model):
    # Parameters can be changed without compiling again: --set load=1.0, or simulate(..., parameters={"load": 1.0}).
    load: Scalar = parameter("mass at the tip", unit="kg", default=0.5)

    # Parts. `acausal show Revolute` lists the parameters, variables and ports of a class; units are SI units.
    world = World()  # gravity acts along -y
    hinge = Revolute(phi=fixed(0), w=fixed(0), use_axis_flange=True)  # turns about z, starts at rest
    damper = Damper(d=0.1)
    beam = FlexibleBeam(length=0.4, E=1e9, rho=5540, A=18e-4, J=1.215e-8, elements=4, geometric_stiffness=True)
    tip = Body(m=load)

    # Outputs are plotted and written to files if nothing else is asked for.
    height: Scalar = output("height of the tip", unit="m")

    def connections(self):
        # chain() connects frame_b of each part to frame_a of the next one; connect(a, b) joins two ports.
        yield chain(self.world, self.hinge, self.beam, self.tip)
        yield chain(self.hinge.support, self.damper, self.hinge.axis)

    def equations(self):
        yield self.height == self.tip.r_0[1]


if __name__ == "__main__":
    result = ac.simulate(NAME(), stop_time=2)
    print(result["height"][-1], result["hinge.phi"][-1])  # any variable by its path
    result.plot("height", "hinge.phi", path="FILE.png")
    result.animate("FILE.html")
'''


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
            stream.write(MODEL.replace("NAME", name).replace("FILE", path.stem))
        typer.echo(
            f"Wrote {file}. Run it:\n    acausal simulate {file}:{name} --stop-time 2 --animate {path.stem}.html"
        )
