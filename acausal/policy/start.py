"""Thresholds of the initialisation: Newton iterations, ranks, loops, equilibria, modes."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf


@dataclass(frozen=True)
class Newton:
    """Damped Newton iteration on the initial system; unknowns are scaled by nominal value plus magnitude."""

    # A convergent damped iteration needs a few tens of steps (Deuflhard 2004, section 3.3).
    iterations: int = 60
    # Evaluations of an undamped iteration in the core: one step and its confirmation.
    quick: int = 2
    # Scaled Newton step: the next one is of the order of its square, which is round-off.
    converged: float = 1e-8
    # Scaled Newton step at round-off level.
    rounding: float = 1e-13
    # Damping factor at which the iteration fails: 2^-20.
    damping: float = 1e-6
    # Round-off of an equation, relative to that of one term: sums of up to 1,000 terms.
    terms: float = 1e3
    # Residual, relative to its change by the scales of its unknowns: ten times `converged`.
    consistent: float = 1e-7
    # Residual norm, in addition to its natural decrease: round-off of scaled steps.
    floor: float = 1e-14
    # Step of the homotopy (Allgower & Georg 1990), relative to its path: the first, growth and reduction factor, and the
    # smallest, at which the homotopy fails.
    first: float = 0.1
    growth: float = 1.5
    shrinkage: float = 3.0
    shortest: float = 1e-4


@dataclass(frozen=True)
class Ranks:
    """Ranks of Jacobians with columns scaled by nominal values and rows of length 1."""

    # Singular value, relative to the number of rows: loops close to 1e-9, which limits their directions. Also the length of a
    # row, relative to the longest row of its equation: an axis off by round-off would otherwise lock a four-bar.
    rank: float = 1e-9
    # Length of the longest row of an equation, relative to that of all or to 1, below which it is compared with round-off.
    faint: float = 1e-6
    # Smallest singular value of a loop without mobility that causes a warning: axes of a four-bar that are off by 0.01 rad.
    locked: float = 1e-2
    # Rows of a matrix for dense decompositions, whose round-off is that of sparse ones.
    small: int = 100
    # Singular value whose square is well above round-off.
    squared: float = 1e-5
    # Singular value in a singular configuration, whose position is known to the square root of the closing tolerance.
    nearly: float = 1e-5
    # Singular value near a singular configuration, where large forces can stop an integrator.
    beside: float = 1e-3
    # Part of a condition that is independent of the previous ones: the square root of round-off, times ten.
    independent: float = 1e-7
    # Small motions before a rank is computed again, in nominal values: large enough for a rank that rises with their square,
    # small enough for a mechanism of flat links (n-four-bar).
    motion: float = 1e-2
    shake: float = 1e-3
    away: float = 0.1
    # Number of random motions: a rank that is low in three is low.
    motions: int = 3
    # Closing error of loops after such a motion: the ratio `closed` / `motion` affects ranks.
    moved: float = 1e-10
    # Singular values that count as 0 in minimum-norm steps, and in the final corrections near a singular configuration.
    least_norm: float = 1e-12
    polish: float = 1e-7
    # Weight of constraints that cannot be dropped, relative to others.
    kept: float = 1e3
    # Weights in the choice of states: of states without constraints, of coordinates before their rates, of guessed states.
    unheld: float = 100.0
    coordinate: float = 10.0
    guessed: float = 10.0


@dataclass(frozen=True)
class Loops:
    """Closed loops; residuals are relative to their change by the nominal values of the states."""

    # Residual: round-off of a loop of some ten joints after a thousand revolutions.
    closed: float = 1e-9
    # Residual of a redundant constraint during a run: the square root of `closed`, by which ranks are uncertain, times three.
    opened: float = 1e-4
    # Number of rows checked for it: a loop that opens may close again after whole revolutions.
    seen: int = 20
    # Residual of the rates near a singular configuration: they are known to the square root of `closed` at best.
    rough: float = 1e-6
    # Perturbations of the guesses, in nominal values, in successive attempts to close loops: a loop in the wrong assembly
    # configuration needs a large one.
    attempts: tuple[float, ...] = (0.0, 0.03, 0.1, 0.3, 1.0, 1.0, 1.0)
    # Gap of a loop that soft conditions may close, relative to the motion: positions in a mesh have at least three digits,
    # and the strain of elastic parts is at most this.
    taken: float = 1e-3
    # Evaluations of an attempt, relative step at which it ends, and number of final minimum-norm corrections.
    evaluations: int = 200
    ends: float = 1e-15
    polishing: int = 5
    # Initial Levenberg-Marquardt damping, relative to the largest squared gradient of a residual. For random guesses of five
    # mechanisms, larger damping finds closer positions, with little difference above 0.1.
    damping: float = 0.1
    # Conditioning of the independent constraints relative to all: above it the subset stays where an integration begins (below a
    # quarter another one is selected, kept.c). The best subsets of Bennett's linkage and of two cranks have 0.56 to 0.98.
    fairly: float = 0.5
    # Cosine between constraints and directions of projection: below it the selection is unsuitable, because errors grow with
    # its reciprocal, 20.
    worn: float = 0.05
    # Random positions for the scales of coordinates: number, and distance from the guesses in nominal values, a usual rotation.
    looks: int = 16
    around: float = 1.0
    # `worn` in a large mechanism, relative to the best selection among n states; tolerance of singular values of large
    # matrices; cosine required when stiff coordinates are spared, at which errors grow by a factor of 3.
    fit: float = 0.5
    angles: float = 1e-3
    spared: float = 0.3
    # Grid of logarithms of entries: close entries become equal, and sums of up to 2^20 logarithms are exact.
    grid: float = 2.0**-20
    # Decades of the stiffness of a coordinate above the square of the feedback, both in 1/s2, that are distinguished.
    decades: int = 12
    # Stiffness of coordinates that do not follow a jump, relative to those that can close the loop, in 1/s2: vibrations
    # thirty times as fast. Weight of these coordinates, relative to others.
    stiffer: float = 1e3
    stiff: float = 1e-6
    # Step out of a singular configuration in nominal values: the error of linearisation is its square.
    away: float = 1e-4
    # The same where accelerations are taken from its middle and end, in so many iterations: the error is its third power.
    farther: float = 1e-2
    iterations: int = 6
    # Change of speeds in this step, relative to the largest speed: on a branch it is of the order of the step.
    stays: float = 1e-2
    # Speed of joints at rest, in nominal values: rates in a singular configuration are not known better.
    rest: float = 1e-4
    # Smallest singular value of scaled constraints in a singular configuration: below it, errors select the branch (flat.c).
    flat: float = 1e-3
    # Time constants of the feedback of states to the constraints in a run (Baumgarte 1972): slow compared with the motion,
    # but sufficient to prevent an accumulation of errors.
    feedback: float = 10.0


@dataclass(frozen=True)
class Rest:
    """Equilibrium."""

    # Derivative that counts as 0, relative to its change by the nominal values of the unknowns.
    still: float = 1e-7
    # Rotations of a cyclic coordinate at which loads are compared in steady rotation, in nominal values (1 rad): no two of them,
    # nor 0, are equivalent for a rotor of up to 20 blades. Time of another comparison, relative to that of the rotation.
    turns: tuple[float, ...] = (1.0, 2.3)
    later: float = 1e-3
    # Runge-Kutta steps of order 4 for a rotation with variable rates: errors of (1/32)^4 / 120 = 1e-8.
    parts: int = 32
    # Change of an entry of a linear system by a rotation, relative to the largest of its row, that counts as 0: 10 `still`.
    periodic: float = 1e-6
    # Feedback of states to invariants in the search, in 1/s, as in `linearize`.
    feedback: float = 1.0
    # Samples of random signs of round-off: the largest effect of eight is close to the largest possible one.
    signs: int = 8
    # Newton steps, and implicit Euler steps of the pseudo-transient continuation.
    newton: int = 60
    relaxation: int = 1000
    # Largest change of a state in a step, in nominal values: a joint stays on its branch.
    far: float = 0.3
    # Change of a coordinate, in rad or nominal values, above which an equilibrium is not near its guess: a quarter of a turn.
    turn: float = 1.6
    # Steps of the continuation, relative to the period of the fastest motion at the guess: the first, growth, the last, and the
    # smallest; safety factor of the step control (Hairer & Wanner 1996, section IV.8).
    first: float = 1e-3
    growth: float = 2.0
    safety: float = 0.8
    last: float = 1e8
    shortest: float = 1e-12
    # Limits of a step in successive attempts: its length in nominal values, and the relative change by a second Newton
    # iteration. Soft modes permit long, nearly linear steps; vibrating stiff parts make steps non-linear without much motion.
    limits: tuple[tuple[float, float], ...] = ((inf, 0.2), (0.3, inf), (inf, 0.5))
    # Reduction factor of a step beyond its limits.
    shrinkage: float = 2.0
    # Scaled Newton step at round-off level.
    converged: float = 1e-12
    halvings: int = 6
    # Decrease of the residuals in a step, relative to that of the linear model (Armijo's rule).
    decrease: float = 0.1
    # Steps back to the guess: their number, the smallest fraction of one, and the remaining distance that counts as 0.
    back: int = 20
    short: float = 0.1
    there: float = 1e-9
    # Distance of a state from its guess that counts as 0, in nominal values.
    guess: float = 1e-6
    # Perturbation of an unstable equilibrium, in nominal values.
    push: float = 1e-2
    # Influence of a state, relative to the largest, at round-off level.
    faint: float = 1e-13
    # Singular value of undetermined directions, at round-off level.
    weak: float = 1e-11
    # Growth rate that counts as 0, relative to the eigenvalue, and to the splitting of double zeros by round-off.
    grows: float = 1e-6
    split: float = 10.0


@dataclass(frozen=True)
class Switches:
    """Consistent modes at the start."""

    # Principal pivots: each determines at least one switch, and chains of ideal parts have a few.
    rounds: int = 20
    # Further pivots, one switch at a time, if the sequence repeats: 5,000 sets of n saturations in random monotone feedback, n
    # up to 8, took at most 2 n. Six switches have as many assignments.
    tries: int = 64
    # Change of a discrete variable, relative to its value, that counts as 0.
    same: float = 1e-9
    # Event indicator at round-off level, relative to its scale: at dead centre the pistons of a V6 engine move at 2e-16 m/s,
    # in either direction.
    rounding: float = 1e-14
