"""All numerical thresholds in one record, each with the theory, test or scene that determines it.

They are relative to a tolerance, to the nominal value of an unknown or to the length of the run, or they are counts; time
limits of studies are in seconds.
"""

from __future__ import annotations

from dataclasses import dataclass

from acausal.policy.accuracy import Accuracy, Defaults, Estimate, Study
from acausal.policy.checks import Causes, Meeting, Promises, Validity
from acausal.policy.elimination import Elimination
from acausal.policy.events import Agenda, Clock, Instants, Rests, Sampling
from acausal.policy.integrate import Calls, Consistent, Divergence, Order, Rescue, Sizes
from acausal.policy.start import Loops, Newton, Ranks, Rest, Switches


@dataclass(frozen=True)
class Policy:
    """Thresholds by subject."""

    elimination: Elimination
    newton: Newton
    ranks: Ranks
    loops: Loops
    rest: Rest
    switches: Switches
    order: Order
    rescue: Rescue
    divergence: Divergence
    calls: Calls
    consistent: Consistent
    sizes: Sizes
    instants: Instants
    sampling: Sampling
    agenda: Agenda
    rests: Rests
    clock: Clock
    meeting: Meeting
    promises: Promises
    validity: Validity
    causes: Causes
    defaults: Defaults
    accuracy: Accuracy
    estimate: Estimate
    study: Study


POLICY = Policy(
    Elimination(),
    Newton(),
    Ranks(),
    Loops(),
    Rest(),
    Switches(),
    Order(),
    Rescue(),
    Divergence(),
    Calls(),
    Consistent(),
    Sizes(),
    Instants(),
    Sampling(),
    Agenda(),
    Rests(),
    Clock(),
    Meeting(),
    Promises(),
    Validity(),
    Causes(),
    Defaults(),
    Accuracy(),
    Estimate(),
    Study(),
)
