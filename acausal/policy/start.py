"""Thresholds of what finds a start: Newton iterations, ranks, loops, rest."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf


@dataclass(frozen=True)
class Newton:
    """The damped iteration on the initial system; sizes of unknowns are their nominal values plus what they are."""

    # Deuflhard 2004, section 3.3: a damped iteration that is to converge does so in a few tens of steps.
    iterations: int = 60
    # Evaluations in which undamped steps of the core find algebraic unknowns, if that is accepted: one, and its confirmation.
    quick: int = 2
    # Change in a step, over the size: the next one, of its square, is rounding.
    converged: float = 1e-8
    # A last correction below this is rounding itself.
    rounding: float = 1e-13
    # Damping below which the residual does not fall; 2^-20 of a step.
    damping: float = 1e-6
    # Rounding errors of an equation, over those of one term: sums of up to 1,000 terms.
    terms: float = 1e3
    # Residual, over the change that the sizes of its unknowns make in it: ten times `converged`.
    consistent: float = 1e-7
    # What the residual norm may keep beside its natural decrease: rounding of scaled steps.
    floor: float = 1e-14
    # Steps of the homotopy (Allgower & Georg 1990) over its path: the first, by how much they grow and shrink, and the
    # shortest before the path counts as ended.
    first: float = 0.1
    growth: float = 1.5
    shrinkage: float = 3.0
    shortest: float = 1e-4


@dataclass(frozen=True)
class Ranks:
    """Ranks of Jacobians whose columns count in nominal values and whose rows have length 1."""

    # Singular values, over the number of rows: loops are closed to 1e-9, and so are their directions. So is the length of a row,
    # over that of the longest of its equation: an axis that is off by rounding would lock a four-bar.
    rank: float = 1e-9
    # Length of the longest row of an equation, over that of all or 1, from which on it may be rounding: that is looked at then.
    faint: float = 1e-6
    # The least singular value of a loop in which nothing moves that may be meant to: axes of a four-bar that are off by 0.01 rad.
    locked: float = 1e-2
    # Rows up to which matrices are small: they are dense, all in one; rounding of the singular values of others is no more.
    small: int = 100
    # Singular value of which the square is well above rounding.
    squared: float = 1e-5
    # Positions where ranks are lost are known only as well as the root of how well loops close.
    nearly: float = 1e-5
    # Where the independent part of a constraint is this small, forces are large enough to stop an integrator.
    beside: float = 1e-3
    # Part of a condition that is independent of the ones before: the root of rounding, with some room.
    independent: float = 1e-7
    # Small motions after which a rank is computed again, in nominal values; long enough to see a rank that rises with
    # the square of them, short enough to stay in a mechanism of flat links (n-four-bar).
    motion: float = 1e-2
    shake: float = 1e-3
    away: float = 0.1
    # Random motions in which a rank is computed again: one that stays low in three is low.
    motions: int = 3
    # How well the loops must close after such a motion: its effect on ranks is that of `closed` over `motion`.
    moved: float = 1e-10
    # Singular values that a step of least norm takes as 0, and those that polishing does: beside a singular configuration.
    least_norm: float = 1e-12
    polish: float = 1e-7
    # A constraint that cannot be dropped counts as that much longer than others.
    kept: float = 1e3
    # So do, where states are chosen, those that no constraint holds, coordinates before their rates, and guessed states.
    unheld: float = 100.0
    coordinate: float = 10.0
    guessed: float = 10.0


@dataclass(frozen=True)
class Loops:
    """Closed loops; a residual counts over the change that nominal values of the states make in it."""

    # Rounding of a loop of some ten joints, with room for one that turned a thousand times.
    closed: float = 1e-9
    # What a constraint that follows from others may be off by: the root of that, as ranks are known, with some room.
    opened: float = 1e-4
    # Rows of a run at which that is looked at: a loop that opens may close again after whole turns.
    seen: int = 20
    # Rates beside a singular configuration are known only as well as the root of that, but for a factor.
    rough: float = 1e-6
    # Disturbances of the guesses, in nominal values, after which closing is tried again: a loop that folds the wrong way
    # needs a large one.
    attempts: tuple[float, ...] = (0.0, 0.03, 0.1, 0.3, 1.0, 1.0, 1.0)
    # How far loops may miss where soft conditions yield, over the size of the motion: places in a mesh have three digits at
    # least, and elastic parts are strained by no more than this.
    taken: float = 1e-3
    # Evaluations of a try, relative changes at which it ends, and steps of least norm that polish it.
    evaluations: int = 200
    ends: float = 1e-15
    polishing: int = 5
    # Damping of the first step of a try, over the greatest square of a residual's gradient. From random guesses of five
    # mechanisms closed positions are the nearer the larger it is; from 0.1 on it makes little difference.
    damping: float = 0.1
    # How well constraints that are kept hold those that follow from them: below the first others are kept, from the second on
    # they stay when a call begins. Of Bennett's linkage and of two cranks on a coupler the best choice has 0.56 to 0.98.
    unfit: float = 0.25
    fairly: float = 0.5
    # Nominal values by which states of loops move in the first call of a method that is looked at after it, where that may
    # happen: a tenth from one look to the next (`calls.fine`). Later calls are twice as long as the one before.
    first: float = 6.0
    # Cosine between constraints and the directions in which coordinates follow them: below it the choice is unfit
    # (errors grow with 1/cosine, factor 20), and what sparing stiff coordinates may cost (factor 3).
    worn: float = 0.05
    # What coordinates of one unit change in constraints, over what others do, that their sizes follow: a machine of 1e6 mm.
    slight: float = 1e-7
    # Places around the guesses at which they do, and how far away in nominal values: joints turn that far.
    looks: int = 16
    around: float = 1.0
    # The former in a large mechanism, over the best of a choice among n states; how well cosines of large ones are known.
    fit: float = 0.5
    angles: float = 1e-3
    spared: float = 0.3
    # Of the logarithm of an entry: entries as near to each other are one, and sums of up to 2^20 logarithms are exact.
    grid: float = 2.0**-20
    # Decades above the square of the feedback, both in 1/s2, that a coordinate may resist before it counts as stiff.
    decades: int = 12
    # How much stiffer than those that can close a loop are parts that do not give way when it follows a jump, in 1/s2 over 1/s2:
    # vibrations thirty times as fast. What their sizes count then, over those of others.
    stiffer: float = 1e3
    stiff: float = 1e-6
    # Way out of a singular configuration in nominal values: its square is the error of what is left out.
    away: float = 1e-4
    # Change of speeds on it, over the greatest: on a branch it is of the order of the way.
    stays: float = 1e-2
    # Speed of joints, in nominal values, that is rest: rates of a singular configuration are known no better than that.
    rest: float = 1e-4
    # What a coordinate is integrated by follows it; beyond this fraction of its size it has lost it.
    apart: float = 0.1
    # Smallest singular value of constraints, over their sizes, in a flat position: nearer, errors choose the way (flat.c). It
    # is looked for in so many parts of a step, and again beside the least of them: 1 / 4^5 of a step is nearer than that.
    flat: float = 1e-3
    parts: int = 8
    zooms: int = 6
    # Returns of what is integrated to what the constraints allow in a run, e-fold each (Baumgarte 1972): slow against
    # the motion, and enough for errors of a run not to add up.
    feedback: float = 10.0


@dataclass(frozen=True)
class Rest:
    """Equilibrium."""

    # A derivative that is 0, over the change that nominal values of the unknowns make in it.
    still: float = 1e-7
    # Turns of a cyclic coordinate at which loads are the same in steady rotation, in nominal values (1 rad): no two of them, nor
    # 0, are alike for a rotor of up to 20 blades. Part of a turn within which a drive that speeds up changes the speed.
    turns: tuple[float, ...] = (1.0, 2.3)
    later: float = 1e-3
    # Steps of the fourth order in a turn whose rates change on the way: errors of (1/32)^4 / 120 = 1e-8.
    parts: int = 32
    # Change of an entry of a linear system in a turn, over the largest of its row, that is none: ten times `still`.
    periodic: float = 1e-6
    # How fast states return to invariants in the search, in 1/s, as in `linearize`.
    feedback: float = 1.0
    # Random signs of rounding errors: the largest effect of eight is within a factor of a few of the largest there is.
    signs: int = 8
    # Newton steps, and implicit Euler steps that follow the motion.
    newton: int = 60
    relaxation: int = 1000
    # Largest change of a state in a step, in nominal values: a joint that turns by no more stays on its branch.
    far: float = 0.3
    # Change of a coordinate beyond which an equilibrium may not be the one that is near: a quarter of a turn, and some.
    turn: float = 1.6
    # Steps of the relaxation over the time of the fastest motion at the guess: the first, their growth, the last, and the
    # shortest; part of the step that limits would allow, as in other controls of steps (Hairer & Wanner 1996, section IV.8).
    first: float = 1e-3
    growth: float = 2.0
    safety: float = 0.8
    last: float = 1e8
    shortest: float = 1e-12
    # Attempts of the relaxation: how far a step may lead in nominal values, and what a second iteration may change in it, over
    # it. Soft modes go far by steps that are nearly exact; stiff parts that ring bend each step, though nothing moves far.
    limits: tuple[tuple[float, float], ...] = ((inf, 0.2), (0.3, inf), (inf, 0.5))
    # By what a step is shortened that is too long.
    shrinkage: float = 2.0
    # Change in a step, over the size, that is rounding.
    converged: float = 1e-12
    halvings: int = 6
    # What a step must take off the residuals, as a fraction of what it would take off linear ones (Armijo's rule).
    decrease: float = 0.1
    # Steps back to the guess, the shortest part of one, and the way back that is none.
    back: int = 20
    short: float = 0.1
    there: float = 1e-9
    # A state is at its guess within that, in nominal values.
    guess: float = 1e-6
    # Push off an unstable equilibrium, in nominal values.
    push: float = 1e-2
    # Influence of a state on everything, over the greatest, that is rounding.
    faint: float = 1e-13
    # Singular value of what is free, but for rounding.
    weak: float = 1e-11
    # Growth that is none, over the size of the eigenvalue; and over the root of rounding, by which double zeros split.
    grows: float = 1e-6
    split: float = 10.0


@dataclass(frozen=True)
class Switches:
    """Switches that fit the start."""

    # Rounds until they do; each settles one switch at least, and chains of ideal parts have a few.
    rounds: int = 20
    # Rounds beyond them where they repeat themselves, in which switches change one at a time: 5,000 sets of n saturations in
    # random monotone feedback, n up to 8, took 2 n at most. All assignments of six switches are as many.
    tries: int = 64
    # Change of a discrete variable, over its value, that is none.
    same: float = 1e-9
    # Excess of a condition, over its scale, that may be rounding: at dead centre the pistons of a V6 engine move at 2e-16 m/s,
    # this way or the other.
    rounding: float = 1e-14
