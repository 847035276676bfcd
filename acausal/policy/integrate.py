"""Thresholds of the integration: order, rescues, values on the equations, energies, sizes."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Order:
    """Order limit of the multistep method."""

    # Oscillations so many times faster than the motion are not resolved by its steps: spin-up at 1e-6 with order 5 took 394,523
    # steps, a rigid pendulum over 100 s at 1e-10 with order 2 took 500,760.
    fast: float = 30.0
    # States up to which all eigenvalues are computed; with constraints, iterations would find those of the projection.
    dense: int = 64
    looped: int = 400
    # Slowest eigenvalues among which the motion is.
    slow: int = 6
    # An eigenvalue of less turns in the run does not move.
    moving: float = 0.1
    # Steps of the power iterations: the size of an eigenvalue is wanted to some ten per cent.
    powers: int = 4
    # Shift of the inverse iteration, over the fastest rate.
    shift: float = 1e-9
    # Steps of BDF 5 on an undamped oscillation, in radians of it, up to which it is stable.
    stable: float = 0.71
    highest: int = 5
    # Steps for all outputs together, and for one, after which a limit that may be wrong is in doubt: ten times the trial.
    doubt: int = 20_000
    fewest: int = 40
    # Parts of a run on which both limits are tried, parts after which they are tried again (free vibration at 1e-6 and 400
    # intervals: on a 400th, the start of order 5 costs more than its steps, and order 2 wins), and by how much the highest
    # order must win (free vibration at 1e-6: 6 times, at 1e-4 it loses; the pendulum gets cheap with order 2).
    heads: int = 200
    chunks: int = 3
    gain: int = 3
    # Order 2 with fewer steps for an output than so many times those with which the highest order is stable is not in doubt: a
    # step of the highest order takes half the evaluations (free vibration, stable with 249: order 2 takes 153 steps at 1e-4
    # and 231 at 3e-5, where it is the better limit, and 681 at 1e-6, where it is not).
    cheap: float = 1.5
    # A limit of 2 that takes so many times the steps with which the highest order is stable has lost.
    dear: float = 4.0
    # Half angle of the wedge around the negative real axis in which BDF is stable (Hairer & Wanner II, V.2.7), by order.
    wedge: tuple[tuple[int, float], ...] = ((5, 51.84), (4, 73.35), (3, 86.03))


@dataclass(frozen=True)
class Rescue:
    """Fallback after a refusal of an integrator."""

    # Steps for all outputs before vibrations count as the cause, and before a run counts as long.
    short: int = 40_000
    long: int = 100_000
    # The same for the one-step method that resolves vibrations, times the square root of the tolerance: more digits allow more
    # steps. With 400 outputs, at 1e-3, 1e-5, 1e-7, the pendulum takes 0.1, 3, 65 of 10, 119, 1,190 steps an output, the
    # slider-crank 19, 150, 400. At 1e-6 it is resolved with 150 and not with 100, where the damped rest is 100 times less exact.
    following: float = 150.0
    # Least number of steps for one output.
    fewest_following: int = 5
    fewest_short: int = 100
    fewest_long: int = 1000
    # Steps between two outputs in the last tries, factors of the tolerance in them, and its largest value: near a singular
    # configuration of a loop long steps succeed where short ones do not (n-four-bar, the folding four-bar).
    patient: int = 20_000
    looser: tuple[float, ...] = (1.0, 1e2, 1e4)
    loosest: float = 1e-4
    # Part of an output interval within which states chosen for loops are fit: 2^-6.
    shortest: float = 0.015
    # Output intervals with a larger tolerance in a run.
    loosened: int = 10
    # Progress of as many steps as are allowed, relative to the run: with less, the run does not lead on.
    stalled: float = 1e-4


@dataclass(frozen=True)
class Divergence:
    """Runs whose states grow without bound."""

    # Part of a run in which states show what is usual, growth over that, and how much shorter steps become: a pole on a cart
    # with the wrong sign of feedback turns by 1e5 rad, with 200,000 steps. Machines that are still at first grow as much from
    # rounding, but are not taken for divergent: what is below its tolerance at first does not count.
    early: float = 0.1
    growth: float = 1e8
    shorter: float = 1e3


@dataclass(frozen=True)
class Calls:
    """Slices of an integration, and settings of IDAS."""

    # Fixed steps between two checks for an interrupt: a step of 1e4 operations takes 5 us, so that a call from Python is less
    # than a hundredth of a block, and an interrupt waits for some ms.
    steps_of_a_block: int = 256
    # Round-off of an equation of some terms, relative to the part of the tolerance that a Newton iteration may leave;
    # tolerances below the second are near it.
    rounding: float = 1e-14
    near_rounding: float = 1e-8
    # Error of Newton iterations relative to the tolerance: larger errors excite lightly damped vibrations, which then cost
    # steps; near a singular configuration of a loop they grow.
    newton: float = 0.05
    newton_in_loops: float = 0.005
    # Tolerance of IDAS relative to that of the run, where there are loops without vibrations that outputs cannot show: on
    # over-constrained loops with springs its errors were 30 to 80 times those of the one-step method. Below the second, rounding
    # counts.
    stricter_in_loops: float = 0.01
    strictest: float = 1e-10
    # Steps of a slice after which the states chosen for loops are checked.
    few: int = 8
    # Operations of the core in a slice, some hundredths of a second, for which an interrupt waits: 10 evaluations a step.
    at_once: int = 3_000_000
    # A step takes at least as long as so many operations: 2 to 4 us by IDAS.
    least: int = 150


@dataclass(frozen=True)
class Consistent:
    """Algebraic unknowns that satisfy their equations."""

    # Relative change in a Newton step after which the next step would change round-off only, by quadratic convergence.
    settled: float = 1e-7
    # The same where per cents are sufficient.
    roughly: float = 3e-2
    # Values relative to the largest unknown that may be round-off, which never converges.
    noise: float = 1e-9
    # Difference of two names of one variable relative to its largest value: round-off of their terms.
    given: float = 1e-9


@dataclass(frozen=True)
class Sizes:
    """Sizes of states that declare none."""

    # States that reach less than that part of their size need another one: errors were ten times those of the tolerance.
    smaller: float = 0.1
    # What reaches less, in nominal values and as a fraction of the absolute tolerance, rests but for rounding: a falling free
    # body turns by 2e-13 rad/s, which is not worth following. What begins with a value does not rest.
    rest: float = 1e-11
    lost: float = 1e-4
    # Runs after which sizes are accepted: each improves those of a motion lost in the tolerance.
    passes: int = 5
    # Tolerance of the run that finds them for an exported model, where only that factor of 10 matters.
    looking: float = 1e-3
