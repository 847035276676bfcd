"""FMUs of other tools as parts."""

from components.fmu.fmu import FMU

__all__ = ["FMU"]
