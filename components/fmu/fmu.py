"""FMU: an FMU of another tool as a part."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import cache
from typing import Any

from acausal import DeclarationError, discrete, input, output, parameter
from components.fmu.co_simulation import HELD, CoSimulation, Powers
from components.fmu.interface import KINDS, Interface, read_interface
from components.fmu.model_exchange import KEPT, ModelExchange, fields_of


def FMU(
    path: str | os.PathLike[str], *, kind: str | None = None, powers: Sequence[tuple[str, str]] = (), **values: Any
) -> CoSimulation | ModelExchange:
    """Return an FMU as a part, see `CoSimulation` and `ModelExchange`; needs the package fmpy.

    Parameters
    ----------
    path : str or Path
        Name of the file. Fields have the names of the variables, with _ for what is no letter or digit; values are in SI.
    kind : str, optional
        "co_simulation", which is the default where the FMU has it or `step` is given, or "model_exchange".
    powers : sequence of (str, str)
        Pairs of fields, an input and an output, whose product is a power in W; for Co-Simulation.
    **values
        Values of fields; `step`, the communication step size in s, is needed if the FMU declares no default.

    Raises
    ------
    DeclarationError
        The file is no FMU, or none of this kind; an input or output is not a scalar number; a field in `powers` is unknown; or
        there is no communication step size.

    Examples
    --------
    >>> motor = FMU("motor.fmu", kind="model_exchange")  # doctest: +SKIP
    >>> tyre = FMU("tyre.fmu", step=1e-3, powers=[("v", "F")])  # doctest: +SKIP
    """
    if kind not in (None, *KINDS):
        raise DeclarationError(f"kind of an FMU is {kind!r}; it is one of {', '.join(KINDS)}.")
    if kind is None and (powers or "step" in values):
        kind = "co_simulation"
    taken = {*dir(CoSimulation), *dir(ModelExchange), *CoSimulation.fields, *ModelExchange.fields, HELD, KEPT, "states"}
    interface = read_interface(path, kind, taken)
    if interface.dynamics is not None:
        if powers:
            raise DeclarationError(
                "powers is for FMUs for Co-Simulation; the equations of this one join the others exactly."
            )
        return class_of(interface)(**values)
    if interface.step is None and "step" not in values:
        raise DeclarationError(f"{os.path.basename(path)!r} declares no step size; give one: FMU(..., step=1e-3).")
    inputs, outputs = ([signal.field for signal in part] for part in (interface.inputs, interface.outputs))
    for u, y in powers:
        if u not in inputs or y not in outputs:
            raise DeclarationError(
                f"powers has ({u!r}, {y!r}); it takes an input and an output of {os.path.basename(path)!r}, whose inputs are "
                f"{', '.join(inputs) or 'none'}, and outputs {', '.join(outputs) or 'none'}."
            )
    return class_of(interface, tuple((u, y) for u, y in powers))(**values)


@cache
def class_of(interface: Interface, powers: Powers = ()) -> type[Any]:
    """Return the class of the parts of an FMU."""
    fields: dict[str, Any] = {}
    for declare, part in ((input, interface.inputs), (output, interface.outputs)):
        fields |= {signal.field: declare(signal.description, unit=signal.unit) for signal in part}
    fields |= {s.field: parameter(s.description, unit=s.unit, default=s.start) for s in interface.parameters}
    base: type[Any] = CoSimulation if interface.dynamics is None else ModelExchange
    own = {"__module__": __name__, "__doc__": base.__doc__, "interface": interface, "rebuild": staticmethod(rebuilt)}
    if interface.dynamics is not None:
        own["dynamics"] = interface.dynamics
        return type("FMU", (base,), {**own, **fields, **fields_of(interface.dynamics)})
    fields[HELD] = discrete("outputs", shape=(len(interface.outputs),), start=tuple(s.start for s in interface.outputs))
    if interface.step is not None:
        fields["step"] = parameter("communication step size", unit="s", default=interface.step, positive=True)
    return type("FMU", (base,), {**own, **fields, "powers": powers})


def rebuilt(*own: Any) -> Any:
    """Return a part without its values, from what its class is made of."""
    cls: Any = class_of(*own)
    return cls.__new__(cls)
