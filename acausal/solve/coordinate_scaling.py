"""Scales of coordinates in closed loops, independent of the unit of length: 1 mm of sliding is small beside 1 rad."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.constants import Constants
from acausal.compiler.constraint_jacobian import Constraints
from acausal.compiler.memo import memoized, memoized_latest
from acausal.policy import POLICY
from acausal.solve.sparse_blocks import Block, connected_blocks
from acausal.units import BASES, Dimension, parse

LOOPS, RANKS = POLICY.loops, POLICY.ranks


@memoized
def constraint_blocks(compiled: CompiledModel) -> list[Block]:
    """Blocks of constraints of one level that share coordinates, with the entries of D."""
    c = compiled.constraints
    return connected_blocks(c.entries[0], c.entries[1], (c.size, compiled.nx))


def loop_scales(compiled: CompiledModel, p: np.ndarray) -> np.ndarray:
    """Return the scales of the states in closed loops, shape (nx,): nominal values, or other ones.

    Coordinates of one unit without a declared nominal value that share constraints have a common scale: with it they change
    the constraints as much as those with declared values do; if there are none, as much as angles, which do not depend on
    the unit of length; else as much as the coordinates that change them most. The changes are typical ones around the
    guesses, because a crank at its dead centre, for example, changes nothing.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    p : array
        Values of its free parameters.
    """
    nominal = compiled.nominal[: compiled.nx]
    return nominal * _factors(compiled, p.tobytes()) if _groups(compiled) else nominal


@memoized_latest(1)
def _factors(compiled: CompiledModel, p: bytes) -> np.ndarray:
    """Factors of the nominal values.

    In the first round only coordinates of the first group vary, because the nominal value of the others may exceed the size
    of the machine. A slide across a rod changes its length in proportion to its distance from the middle, so that the second
    round yields the inverse tendency: the geometric mean of both rounds does not depend on the guess.
    """
    found, rounds = np.ones(compiled.nx), []
    for others in (0.0, 1.0):
        spread = others * found
        for _, groups in _groups(compiled):
            spread[groups[0][0]] = 1.0
        found = _round(compiled, np.frombuffer(p), spread)
        rounds.append(found)
    return np.sqrt(rounds[0] * rounds[1])


@np.errstate(all="ignore")
def _round(compiled: CompiledModel, p: np.ndarray, spread: np.ndarray) -> np.ndarray:
    """Factors from the constraint Jacobian around the guesses, within a spread relative to nominal values."""
    c, nx = compiled.constraints, compiled.nx
    nominal = compiled.nominal[:nx]
    around = LOOPS.around * np.random.default_rng(0).standard_normal((LOOPS.looks, nx))
    x = compiled.start(p, 0.0)[0][:nx] + nominal * spread * around
    constants = compiled.layout.begin(compiled.guards.estimate(p, 0.0, 0.0)[0], 1.0)
    J = _typical(c.held(x, p, np.zeros(len(x)), constants.vector)) * nominal[c.entries[1]]
    found, terms = np.ones(nx), None
    for first, groups in _groups(compiled):
        most = _most(c, J, groups)
        if np.any(most[_most(c, np.ones(len(J)), groups) > 0] <= RANKS.faint * np.max(most)):
            # Round-off or a small machine: motions of the whole loop cancel; the size of their terms counts instead.
            terms = _terms(compiled, x, p, constants) * nominal[c.entries[1]] if terms is None else terms
            adds_up = _most(c, terms, groups)
            most = np.where(most > RANKS.rank * adds_up, most, adds_up)
        to = np.where(most[0] > 0, most[0], np.max(most, axis=0)) if first else np.max(most, axis=0)
        for (states, _), own in list(zip(groups, most, strict=True))[int(first) :]:
            if own.any():
                found[states] = np.max(to[own > 0]) / np.max(own)
    return found


def _most(c: Constraints, J: np.ndarray, groups: list[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """Largest entry of each group in each equation, shape (groups, kinds)."""
    kinds = c.kinds[c.entries[0]]
    found = np.zeros((len(groups), int(np.max(c.kinds)) + 1))
    for own, (_, entries) in zip(found, groups, strict=True):
        np.maximum.at(own, kinds[entries], J[entries])
    return found


def _typical(J: np.ndarray) -> np.ndarray:
    """Median magnitude of each entry at n points, with 0 for entries that are not finite."""
    return np.median(np.abs(np.where(np.isfinite(J), J, 0.0)), axis=0)


def _terms(compiled: CompiledModel, x: np.ndarray, p: np.ndarray, constants: Constants) -> np.ndarray:
    """Typical size of the terms of each entry of the constraint Jacobian at n points, in the order of `Constraints.entries`."""
    c = compiled.constraints
    found = _typical(np.array([c.terms(row, p, 0.0, constants.vector)[1] for row in x]))
    columns = np.repeat(np.arange(compiled.nx), np.diff(c.pattern.indptr))
    place = {pair: k for k, pair in enumerate(zip(c.pattern.indices.tolist(), columns.tolist(), strict=True))}
    return np.array([found[place[pair]] if pair in place else 0.0 for pair in zip(*c.entries.tolist(), strict=True)])


@memoized
def _groups(compiled: CompiledModel) -> list[tuple[bool, list[tuple[np.ndarray, np.ndarray]]]]:
    """States of each block by unit, with their entries in equations that several units share.

    First, and flagged, those with a known scale, if any, else those without length and mass in their unit, such as angles.
    """
    c, unknown, found = compiled.constraints, set(compiled.reduced.flat.unknowns.names), []
    known = [declared or unit in unknown for unit, declared in compiled.sizes]
    labels = np.array(["" if known[k] else f"of {unit}" for k, (unit, _) in enumerate(compiled.sizes)])
    plain = {f"of {unit}" for k, (unit, _) in enumerate(compiled.sizes) if not known[k] and _is_plain(parse(unit))}
    for block in constraint_blocks(compiled):
        own, kinds = labels[c.entries[1][block.entries]], c.kinds[c.entries[0][block.entries]]
        shared = np.array([len(set(own[kinds == kind].tolist())) > 1 for kind in kinds], dtype=bool)
        names = sorted(set(own[shared].tolist()), key=lambda name: (name != "", name not in plain, name))
        if names:
            entries = [block.entries[shared & (own == name)] for name in names]
            states = [block.columns[labels[block.columns] == name] for name in names]
            first = names[0] == "" or names[0] in plain
            found.append((first, list(zip(states, entries, strict=True))))
    return found


def _is_plain(unit: Dimension) -> bool:
    """True if a unit is a power of time: independent of units of length and mass."""
    return all(not exponent for base, exponent in zip(BASES, unit.exponents, strict=True) if base != "s")
