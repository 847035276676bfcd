"""CoSimulation: an FMU for Co-Simulation as a part."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from acausal import Component, Scalar, call, discrete, parameter, time
from components.blocks.periodic_block import at_instants
from components.fmu.interface import Interface
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
    rebuild: ClassVar[Callable[..., Any]]  # from what its class is made of
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
        return self.rebuild, (self.interface, self.powers), self.__dict__
