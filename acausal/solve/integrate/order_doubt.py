"""When the order limit of the multistep method is in doubt."""

from __future__ import annotations

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.integrate.methods import METHODS

ORDER = POLICY.order


def is_open(integrator: Integrator, times: np.ndarray) -> bool:
    """Return whether the highest order may take fewer steps than are allowed, although it is stable in short ones only.

    Vibrations that may be damped do not matter: where they need many steps, the one-step method takes over.
    """
    settings = integrator.settings
    if not METHODS[integrator.way.method].multistep or not settings.order_is_open or settings.may_ring(times):
        return False
    return _stable(integrator, times) < settings.patience(integrator.way, times)


def patience(integrator: Integrator, times: np.ndarray) -> int:
    """Return the steps for an output interval after which the present order is given up."""
    most = integrator.settings.patience(integrator.way, times)
    dear = int(ORDER.dear * _stable(integrator, times))
    return most if integrator.order == ORDER.highest else min(most, max(ORDER.fewest, dear))


def doubt(integrator: Integrator, times: np.ndarray) -> int:
    """Return the steps for an output interval after which the order limit is in doubt."""
    cheap = int(ORDER.cheap * _stable(integrator, times))
    return min(patience(integrator, times), max(ORDER.fewest, cheap, ORDER.doubt // (len(times) - 1)))


def _stable(integrator: Integrator, times: np.ndarray) -> float:
    """Return the steps for an output interval with which the highest order is stable."""
    return integrator.settings.spectrum.fastest * float(np.max(np.diff(times), initial=0.0)) / ORDER.stable
