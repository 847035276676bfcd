import copy
import pickle
from fractions import Fraction

import pytest

from acausal.errors import DeclarationError
from acausal.units import BASES, DIMENSIONLESS, Dimension, factors, parse

M, KG, S = parse("m"), parse("kg"), parse("s")
JOULE = Dimension(2, 1, -2, 0, 0, 0, 0)


@pytest.mark.parametrize(
    "text", ["kg.m2/s2", "N.m", "N.m/rad", "J", "kg*m^2/s**2", "kg m2 s-2", "W.s", " J ", "kg.m2.s^-2"]
)
def test_spellings_of_an_energy_are_one_object(text):
    assert parse(text) is JOULE


@pytest.mark.parametrize("text", ["", "1", "rad", "m/m", "rad2", "N.s/(kg.m.s-1)"])
def test_dimensionless(text):
    assert parse(text) is DIMENSIONLESS


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("N", "kg.m/s2"),
        ("Pa", "N/m2"),
        ("W", "J/s"),
        ("W", "V.A"),
        ("Hz", "rad/s"),
        ("1/s", "s-1"),
        ("N.m.s/rad", "kg.m2/s"),
        ("C", "A.s"),
        ("F", "C/V"),
        ("Ohm", "V/A"),
        ("S", "1/Ohm"),
        ("H", "Wb/A"),
        ("T", "kg/(A.s2)"),
        ("Wb", "V.s"),
        ("J/(kg.K)", "m2/s2/K"),
        ("m^(1/2)", "m^(2/4)"),
    ],
)
def test_derived_units(text, same):
    assert parse(text) is parse(same)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("", []),
        ("1", []),
        ("N.m/rad", [("N", 1), ("m", 1), ("rad", -1)]),
        ("kg*m^2/(s**2.rad)", [("kg", 1), ("m", 2), ("s", -2), ("rad", -1)]),
        ("m^(1/2)/s/s", [("m", Fraction(1, 2)), ("s", -1), ("s", -1)]),
    ],
)
def test_factors(text, found):
    assert list(factors(text)) == found


def test_operators():
    assert KG * M / S**2 is parse("N")
    assert (M**2) ** Fraction(1, 2) is M
    assert M**0 is DIMENSIONLESS
    assert M != S


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("kg.m/s2", "N"),
        ("J", "N.m"),
        ("N/m2", "Pa"),
        ("J/s", "W"),
        ("kg.m2", "kg.m2"),
        ("rad/s", "1/s"),
        ("J/(kg.K)", "m2/(s2.K)"),
        ("m^(1/2)", "m^(1/2)"),
        ("rad", "1"),
    ],
)
def test_text(text, shown):
    assert str(parse(text)) == shown
    assert parse(shown) is parse(text)


@pytest.mark.parametrize(
    ("text", "mend"),
    [
        ("mm", '"m" (1 mm = 1e-3 m)'),
        ("N/mm", '"m" (1 mm = 1e-3 m)'),
        ("deg", '"rad" (1 deg = pi/180 rad)'),
        ("g", '"kg" (1 g = 1e-3 kg)'),
        ("mg", '"kg" (1 mg = 1e-3*1e-3 kg)'),
        ("rpm", '"rad/s"'),
        ("min", '"s" (1 min = 60 s)'),
        ("degC", '273.15 in "K"'),
        ("kN", '"N"'),
        ("Nm", 'did you mean "N.m"?'),
        ("hz", 'did you mean "Hz"?'),
        ("ohms", 'did you mean "Ohm"?'),
        ("xyzzy", "known are"),
        ("W/m.K", '"/(m.K)"'),
        ("/s", '"1/s"'),
        ("10", 'cannot read "10"'),
        ("N..m", 'cannot read ""'),
        ("m/", 'cannot read ""'),
        ("kg.(m/s", "cannot read"),
    ],
)
def test_refused_with_the_mend(text, mend):
    with pytest.raises(DeclarationError) as error:
        parse(text)
    assert mend in str(error.value)


def test_interned_and_frozen():
    assert copy.deepcopy(JOULE) is JOULE
    assert pickle.loads(pickle.dumps(JOULE)) is JOULE
    with pytest.raises(AttributeError, match="immutable"):
        JOULE.exponents = (0,) * 7
    with pytest.raises(DeclarationError, match="7 exponents"):
        Dimension(1)


def test_base_units_have_one_exponent():
    assert [parse(base).exponents.index(1) for base in BASES] == list(range(7))
