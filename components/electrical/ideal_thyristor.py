"""IdealThyristor: ideal thyristor."""

from __future__ import annotations

from acausal import Scalar, discrete, input, reinit, when
from components.electrical.ideal_diode import IdealDiode


class IdealThyristor(IdealDiode):
    """Ideal thyristor: a diode that conducts only after it was fired."""

    fire: Scalar = input("truth value: fires while the voltage is positive")
    on: Scalar = discrete("1 while it conducts")

    def equations(self):
        yield from super().equations()
        yield when((self.fire > 0.5) & (self.s > 0), reinit(self.on, 1), at_start=True)
        yield when(self.s < 0, reinit(self.on, 0), at_start=True)

    def open(self):
        """Unless it conducts."""
        return self.on < 0.5
