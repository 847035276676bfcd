"""FMU: an FMU of another tool as a part."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import cache
from typing import Any, ClassVar

from acausal import Component, DeclarationError, Scalar, call, discrete, input, output, parameter, time
from components.blocks.periodic_block import at_instants
from components.fmu.interface import Interface, read_interface
from components.fmu.slave import Slave

Powers = tuple[tuple[str, str], ...]
HELD = "held"


class CoSimulation(Component):
    """FMU for Co-Simulation, with its inputs, outputs and parameters as fields.

    At each communication point, from the start of the run on, the FMU takes the values of its inputs just before, and its
    outputs are held until the next one. `coupling_error` is what that falsifies the energies by which the two sides exchange:
    the sum over all steps h of abs(y_k u_(k+1) - u_k y_(k+1)) h / 2, for the pairs in `powers`.
    """

    step: Scalar = parameter("communication step size", unit="s", positive=True)
    next: Scalar = discrete("next communication point", unit="s", start=time)
    coupling_error: Scalar = discrete("energy that held signals add or lose", unit="J")
    interface: ClassVar[Interface]
    powers: ClassVar[Powers]

    def equations(self):
        own = self.interface
        u, p = ([getattr(self, signal.field) for signal in part] for part in (own.inputs, own.parameters))
        slave, held = Slave(own, self.powers), getattr(self, HELD)
        act = call(slave, [u, p, self.step], [held, self.coupling_error])
        yield at_instants(self.next, self.step, act)
        for k, signal in enumerate(own.outputs):
            yield getattr(self, signal.field) == held[k]

    def __reduce__(self) -> Any:
        return _rebuilt, (self.interface, self.powers), self.__dict__


def FMU(path: str | os.PathLike[str], *, powers: Sequence[tuple[str, str]] = (), **values: Any) -> CoSimulation:
    """Return an FMU for Co-Simulation as a part, see `CoSimulation`; needs the package fmpy.

    Parameters
    ----------
    path : str or Path
        Name of the file. Fields have the names of the variables, with _ for what is no letter or digit; values are in SI.
    powers : sequence of (str, str)
        Pairs of fields, an input and an output, whose product is a power in W.
    **values
        Values of fields; `step`, the communication step size in s, is needed if the FMU declares no default.

    Raises
    ------
    DeclarationError
        The file is no FMU for Co-Simulation; an input or output is not a scalar number; a field in `powers` is unknown; or
        there is no communication step size.

    Examples
    --------
    >>> tyre = FMU("tyre.fmu", step=1e-3, powers=[("v", "F")])  # doctest: +SKIP
    """
    interface = read_interface(path, {*dir(CoSimulation), *CoSimulation.fields, HELD})
    if interface.step is None and "step" not in values:
        raise DeclarationError(f"{os.path.basename(path)!r} declares no step size; give one: FMU(..., step=1e-3).")
    inputs, outputs = ([signal.field for signal in part] for part in (interface.inputs, interface.outputs))
    for u, y in powers:
        if u not in inputs or y not in outputs:
            raise DeclarationError(
                f"powers has ({u!r}, {y!r}); it takes an input and an output of {os.path.basename(path)!r}, whose inputs are "
                f"{', '.join(inputs) or 'none'}, and outputs {', '.join(outputs) or 'none'}."
            )
    return _class_of(interface, tuple((u, y) for u, y in powers))(**values)


@cache
def _class_of(interface: Interface, powers: Powers) -> type[CoSimulation]:
    """Return the class of the parts of an FMU."""
    fields: dict[str, Any] = {
        HELD: discrete("outputs", shape=(len(interface.outputs),), start=tuple(s.start for s in interface.outputs))
    }
    for declare, part in ((input, interface.inputs), (output, interface.outputs)):
        fields |= {signal.field: declare(signal.description, unit=signal.unit) for signal in part}
    fields |= {s.field: parameter(s.description, unit=s.unit, default=s.start) for s in interface.parameters}
    if interface.step is not None:
        fields["step"] = parameter("communication step size", unit="s", default=interface.step, positive=True)
    own = {"__module__": __name__, "__doc__": CoSimulation.__doc__, "interface": interface, "powers": powers}
    return type("FMU", (CoSimulation,), {**own, **fields})


def _rebuilt(interface: Interface, powers: Powers) -> CoSimulation:
    cls = _class_of(interface, powers)
    return cls.__new__(cls)
