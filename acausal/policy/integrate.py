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
    """How long a way is tried, and what comes after it."""

    # Steps for all outputs together before vibrations count as in the way; steps before a run counts as long.
    short: int = 40_000
    long: int = 100_000
    # The same for the one-step method that follows them, times the root of the tolerance: its steps between two outputs
    # grow more slowly with it, and who asks for more digits lets it follow more. On 400 outputs, at 1e-3, 1e-5, 1e-7: pendulum
    # 0.1, 3, 65 of 10, 119, 1,190 steps; slider-crank 19, 150, 400. At 1e-6 this is followed with 150 and not with 100, where
    # the damped rest of the run is a hundred times less exact.
    following: float = 150.0
    # Steps for one output at least.
    fewest_following: int = 5
    fewest_short: int = 100
    fewest_long: int = 1000
    # Parts of a run that failed in one call: at most 5 % are lost to the restarts.
    chunks: int = 25
    # Steps before a chunk or an output counts as hopeless.
    hopeless: int = 2_000_000
    # Halvings of an output interval with new choices of states: 2^-6 of it.
    halvings: int = 6
    # Steps in each of the last tries, and by how much the tolerance is loosened in them, and at most to what: near a
    # singular configuration of a loop long steps get past what short ones cannot (n-four-bar, the folding four-bar).
    patient: int = 20_000
    # Looks at the end of a run that was given up: each so many times nearer, and how many.
    nearer: float = 4.0
    approaches: int = 9
    # Of a stretch: what that many more steps bring it forward at least, unless they tend to 0.
    stalled: float = 1e-6
    looser: tuple[float, ...] = (1.0, 1e2, 1e4)
    loosest: float = 1e-4
    # Output intervals of a run with a larger tolerance, at most.
    loosened: int = 10


@dataclass(frozen=True)
class Calls:
    """One call of an integrator."""

    # Least number of times in a call at which the choice of states is checked.
    fine: int = 60
    # Looks at the projection after a call cost about the cube of the number of constraints each: their sum, and bounds.
    work: float = 2e7
    looks: tuple[int, int] = (8, 100)
    # Rows of a call of a method without a Newton iteration that are solved at once: as many as one evaluation takes.
    settled: int = 16
    # Of the terms of algebraic equations, what they leave between steps at most where these rows need not be solved: over
    # the tolerance, which is 15 at most in scenes without loops but the governor (300), and in any case (governor, 0.014);
    # where there is no solution it is about all of them, and 0.016 at the least that was seen behind a fold.
    left: tuple[float, float] = (1000.0, 0.015)
    # Fixed steps between two looks at the keyboard: a step of 1e4 operations takes 5 us, so that a call by Python is
    # less than a hundredth of a block, and an interrupt waits for some ms.
    steps_of_a_block: int = 256
    # Of the terms of an equation: a solution leaves rounding, values that are none leave about all of them.
    holds: float = 1e-3
    # Steps after which loops are looked at for flat positions: a few turns.
    steps: int = 64
    # The same at first where constraints follow from one another, which may not last; twice as many each time.
    few: int = 8
    # Of the most that so many steps of the core brought a loop forward: where they bring less, and more than this part of them
    # is taken again, it creeps towards a flat position, where unknowns grow without end: of n-four-bar at 1e-7 19 to 48 %.
    window: int = 32
    creeps: float = 1e-3
    often: float = 0.15
    # Relative rounding error of an equation of some terms, over the part of the tolerance that a Newton iteration may
    # leave; tolerances below the second come near it.
    rounding: float = 1e-14
    near_rounding: float = 1e-8
    # What the Newton iteration may leave, as a fraction of the tolerance: errors of a loose one excite lightly damped
    # vibrations, which then cost steps; near a singular configuration of a loop they are enlarged.
    newton: float = 0.05
    newton_in_loops: float = 0.005
    # Operations of the core before Python looks for an interrupt, some hundredths of a second: 10 evaluations a step.
    at_once: int = 3_000_000
    # Of the time, and of the run: a call that begins so near the last row goes on from it.
    here: float = 1e-9


@dataclass(frozen=True)
class Branches:
    """Jumps of algebraic unknowns within a step, which is divided again and again where they change most."""

    # Parts at once, and how often: a law may be as steep as a millionth of a step.
    parts: int = 6
    zooms: int = 8
    # Of the size of an unknown, changes that count; and of a change, what a part of it may take where it is smooth.
    slight: float = 0.05
    share: float = 0.5


@dataclass(frozen=True)
class Consistent:
    """Algebraic unknowns on their equations."""

    # Relative change in a Newton step, after which the next one would change rounding only: it converges quadratically.
    settled: float = 1e-7
    # The same where per cents count.
    roughly: float = 3e-2
    # Such steps more where a sine of something large keeps the first one from converging so.
    again: int = 10
    # The same for linear equations: elimination with pivots leaves rounding times the change (Higham 2002, section 9.3).
    once: float = 1.0
    # Of the largest unknown: what is smaller may be rounding, which never settles.
    noise: float = 1e-9
    # Times at which sizes of terms are taken, and times in a call from which on that is repeated: it costs little then.
    looks: int = 4
    many: int = 200
    # Of the largest value of a variable that is given under two names: they differ by rounding of what they were made of.
    given: float = 1e-9


@dataclass(frozen=True)
class Energy:
    """Integrals of power."""

    # Nodes of a spline to begin with, rows of a leg that there must be at least, to have more, and nodes at most.
    fewest: int = 48
    rows: int = 192
    most: int = 2**17
    # Nodes in a step, or between two rows, at most: what a step follows does not vary faster.
    a_step: int = 32
    # Intervals between rows that make a stretch at least: splines of order 5 need 6 nodes, every second row too.
    least: int = 10
    # Steps of an interval from which on a method of order 2 is right; higher orders are with one (measured on the spin-up).
    resolved: int = 8
    # Of the error by halving the intervals, 2^6 for smooth powers, with some caution.
    gain: int = 20
    # Points beside the nodes where the power itself is evaluated, and what a spline through nodes that are near enough to
    # each other may miss there, of the greatest power: nodes a whole turn apart agree with each other on anything.
    probes: int = 24
    alike: float = 1e-2
    # Of what one of two works does not balance, the part that another one may leave that is clearly better.
    clearly: float = 0.5
    # Rows at which the stored energy is evaluated, and what of it counts as exchanged even if it rests: powers that cancel
    # leave rounding, which no spline follows.
    looks: int = 9
    rounding: float = 1e-9


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
