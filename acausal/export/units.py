"""Units in the base units of FMI."""

from __future__ import annotations

from acausal.units import BASES, factors, parse

ANGLES = {"rad": 1, "sr": 2}  # powers of rad, which FMI counts as a base unit


def exponents(unit: str) -> dict[str, int] | None:
    """Return the powers of kg, m, s, A, K, mol, cd and rad that are not 0; None where one is not an integer.

    The factor to these units is always 1, because acausal has coherent units only.

    Parameters
    ----------
    unit : str
        In the syntax of `acausal.units.parse`.
    """
    angle = sum(ANGLES.get(symbol, 0) * power for symbol, power in factors(unit))
    powers = dict(zip((*BASES, "rad"), (*parse(unit).exponents, angle), strict=True))
    if any(power.denominator != 1 for power in powers.values()):
        return None
    return {base: int(power) for base, power in powers.items() if power}
