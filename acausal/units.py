"""Units of coherent SI as strings, and their dimensions.

Only units of scale 1 are accepted: values are always in SI, and an angle in radians is dimensionless.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from math import pi, prod
from typing import ClassVar

from acausal.errors import DeclarationError
from acausal.nearest import most_similar

Exponent = int | Fraction

BASES = ("m", "kg", "s", "A", "K", "mol", "cd")


class Dimension:
    """Product of powers of the SI base units; interned, so that equal dimensions are one object.

    Parameters
    ----------
    *exponents : int or Fraction
        Exponents of m, kg, s, A, K, mol, cd.
    """

    __slots__ = ("exponents",)
    exponents: tuple[Exponent, ...]
    _interned: ClassVar[dict[tuple[Exponent, ...], Dimension]] = {}

    def __new__(cls, *exponents: Exponent) -> Dimension:
        """Return the interned dimension of these exponents."""
        known = cls._interned.get(exponents)
        if known is None:
            if len(exponents) != len(BASES):
                raise DeclarationError(f"a Dimension has {len(BASES)} exponents ({', '.join(BASES)}): got {exponents}.")
            new = super().__new__(cls)
            object.__setattr__(new, "exponents", exponents)
            known = cls._interned.setdefault(exponents, new)
        return known

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a Dimension is immutable: cannot set {name}")

    def __reduce__(self) -> tuple[type[Dimension], tuple[Exponent, ...]]:
        # Copies and unpickled dimensions must be interned as well.
        return Dimension, self.exponents

    def __mul__(self, other: Dimension) -> Dimension:
        return _multiply(self, other)

    def __truediv__(self, other: Dimension) -> Dimension:
        return _divide(self, other)

    def __pow__(self, power: Exponent) -> Dimension:
        return _power(self, power)

    def __repr__(self) -> str:
        return f"Dimension({str(self)!r})"

    def __str__(self) -> str:
        return _NAMES.get(self) or _base_text(self)


@cache
def _multiply(left: Dimension, right: Dimension) -> Dimension:
    return Dimension(*(a + b for a, b in zip(left.exponents, right.exponents, strict=True)))


@cache
def _divide(left: Dimension, right: Dimension) -> Dimension:
    return Dimension(*(a - b for a, b in zip(left.exponents, right.exponents, strict=True)))


@cache
def _power(base: Dimension, power: Exponent) -> Dimension:
    return Dimension(*(a * power for a in base.exponents))


def _base_text(dimension: Dimension) -> str:
    """Return a dimension in base units, such as kg.m2/s2 or 1/(m.s)."""

    def product(sign: int) -> list[str]:
        # Customary order: the mass first.
        pairs = sorted(zip(BASES, dimension.exponents, strict=True), key=lambda pair: pair[0] != "kg")
        return [_factor_text(base, sign * exponent) for base, exponent in pairs if sign * exponent > 0]

    above, below = product(1), product(-1)
    text = ".".join(above) or "1"
    if not below:
        return text
    return f"{text}/{below[0]}" if len(below) == 1 else f"{text}/({'.'.join(below)})"


def _factor_text(base: str, exponent: Exponent) -> str:
    if exponent == 1:
        return base
    return f"{base}{exponent}" if exponent.denominator == 1 else f"{base}^({exponent})"


DIMENSIONLESS = Dimension(0, 0, 0, 0, 0, 0, 0)

_SYMBOLS: dict[str, Dimension] = {"rad": DIMENSIONLESS, "sr": DIMENSIONLESS} | {
    base: Dimension(*(int(i == j) for j in range(len(BASES)))) for i, base in enumerate(BASES)
}

_SLASH = re.compile(r"/(?![^(]*\))")  # not the slash of a power (1/2)
_PRODUCT = re.compile(r"\s*[.*·]\s*|\s+")
_FACTOR = re.compile(r"(?P<symbol>[^\W\d_]+)(?:\^?(?P<integer>-?\d+)|\^\((?P<fraction>-?\d+(?:/[1-9]\d*)?)\))?")

_PREFIXES = {"n": "1e-9", "u": "1e-6", "µ": "1e-6", "m": "1e-3", "c": "1e-2", "d": "1e-1"} | {
    "h": "1e2", "k": "1e3", "M": "1e6", "G": "1e9"
}  # fmt: skip
_OTHERS = {
    "g": ("kg", "1e-3"),
    "t": ("kg", "1e3"),
    "deg": ("rad", "pi/180"),
    "rev": ("rad", "2*pi"),
    "rpm": ("rad/s", "pi/30"),
    "min": ("s", "60"),
    "h": ("s", "3600"),
    "bar": ("Pa", "1e5"),
    "l": ("m3", "1e-3"),
}


@cache
def parse(text: str) -> Dimension:
    """Return the dimension of a unit of coherent SI.

    Parameters
    ----------
    text : str
        Modelica style, "kg.m2/s2", "N.m/rad", "J/(kg.K)", "s-1"; also "kg*m^2", "kg m2". "", "1", "rad" are
        dimensionless.

    Returns
    -------
    Dimension
        The exponents of the SI base units.

    Raises
    ------
    DeclarationError
        If the unit is unknown, ambiguous, or not of scale 1.
    """
    dimension = DIMENSIONLESS
    for symbol, power in factors(text):
        dimension = dimension * _SYMBOLS[symbol] ** power
    return dimension


def factors(text: str) -> Iterator[tuple[str, Exponent]]:
    """Yield the symbols of a unit, the dimensionless rad included, with their powers: negative after the slash.

    Parameters
    ----------
    text : str
        Unit as for `parse`, with the same errors.
    """
    if text and text.isspace():
        raise DeclarationError('the unit is blank: write "1" for a pure number.')
    above, *below = _SLASH.split(text.replace("**", "^").strip())
    if above:
        yield from _factors_of_product(above, text)
    for divisor in map(str.strip, below):
        if divisor.startswith("(") and divisor.endswith(")"):
            divisor = divisor[1:-1]
        elif len(_PRODUCT.split(divisor)) > 1:
            raise DeclarationError(
                f'unit "{text}" is ambiguous after "/": write "/({divisor})" to divide by all of it.'
            )
        for symbol, power in _factors_of_product(divisor, text):
            yield symbol, -power
    if below and not above:
        raise DeclarationError(f'unit "{text}" has nothing before "/": write "1{text.strip()}".')


def _factors_of_product(product: str, text: str) -> Iterator[tuple[str, Exponent]]:
    for factor in _PRODUCT.split(product.strip()):
        if factor == "1":
            continue
        match = _FACTOR.fullmatch(factor)
        if match is None:
            raise DeclarationError(f'cannot read "{factor}" in unit "{text}": write units as "kg.m2/s2" or "J/(kg.K)".')
        symbol, integer, fraction = match.groups()
        if symbol not in _SYMBOLS:
            raise _unknown(symbol, text)
        yield symbol, Fraction(fraction) if fraction else int(integer or 1)


def in_si(text: str) -> float | None:
    """Return the SI value of a number with a unit, such as 0.001 for "1 mm"; None for other texts and unknown units."""
    found = re.fullmatch(r"\s*([-+]?\d+\.?\d*(?:[eE][-+]?\d+)?)\s*([^\W\d].*?)\s*", text)
    if not found:
        return None
    number, unit = found.groups()
    scale = _scale(unit)
    if scale:
        return float(number) * scale[1]
    try:
        parse(unit)
    except DeclarationError:
        return None
    return float(number)


def _scale(symbol: str) -> tuple[str, float] | None:
    """Return the SI unit and the scale of a unit that is not coherent SI; None for other symbols."""
    known = _other_scale(symbol)
    if known is None:
        return None
    factors = [f.split("/") for f in known[1].replace("pi", repr(pi)).split("*")]
    return known[0], prod(float(above) / prod(map(float, below)) for above, *below in factors)


def _other_scale(symbol: str) -> tuple[str, str] | None:
    """Return the SI unit and the scale, as text, of a unit that is not coherent SI; None for other symbols."""
    if symbol in _OTHERS:
        return _OTHERS[symbol]
    if symbol not in _SYMBOLS and symbol[0] in _PREFIXES and symbol[1:] in (*_SYMBOLS, "g"):
        scale = _PREFIXES[symbol[0]]
        return ("kg", f"{scale}*1e-3") if symbol[1:] == "g" else (symbol[1:], scale)
    return None


def _unknown(symbol: str, text: str) -> DeclarationError:
    """Return the error for an unknown symbol, with the unit to write instead."""
    where = "" if symbol == text else f' (in "{text}")'
    if symbol == "degC":
        return DeclarationError(f'unit "degC"{where} has an offset: give the value in SI, value + 273.15 in "K".')
    name, factor = _other_scale(symbol) or (_nearest(symbol), "")
    if factor:
        return DeclarationError(
            f'unit "{symbol}"{where} is not coherent SI: give values in SI, in "{name}" (1 {symbol} = {factor} {name}).'
        )
    hint = f'did you mean "{name}"?' if name else f"known are {', '.join(_SYMBOLS)}."
    return DeclarationError(f'unit "{symbol}"{where} is unknown: {hint} Give values in SI.')


def _nearest(symbol: str) -> str:
    """Return the known unit most similar to a symbol, such as N.m for Nm or Hz for hz; "" if there is none."""
    known = "|".join(sorted(_SYMBOLS, key=len, reverse=True))
    if re.fullmatch(f"(?:{known})+", symbol):
        return ".".join(re.findall(known, symbol))
    by_lower = {name.lower(): name for name in _SYMBOLS}
    return by_lower.get(most_similar(symbol.lower(), by_lower), "")


for _name, _definition in {
    "N": "kg.m/s2",
    "Pa": "N/m2",
    "J": "N.m",
    "W": "J/s",
    "Hz": "1/s",
    "C": "A.s",
    "V": "W/A",
    "F": "C/V",
    "Ohm": "V/A",
    "S": "A/V",
    "H": "V.s/A",
    "Wb": "V.s",
    "T": "Wb/m2",
}.items():
    _SYMBOLS[_name] = parse(_definition)

# Names in messages. N.m is right for a moment and for an energy, which have one dimension; Hz is left out because it
# would be wrong for an angular velocity.
_NAMES = {parse(name): name for name in ("N", "N.m", "Pa", "W", "C", "V", "F", "Ohm", "H", "T", "Wb")}
