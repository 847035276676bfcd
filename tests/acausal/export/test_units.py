"""Units in the base units of FMI."""

import pytest

from acausal.export.units import exponents


@pytest.mark.parametrize(
    ("unit", "powers"),
    [
        ("", {}),
        ("1", {}),
        ("m", {"m": 1}),
        ("kg.m2/s2", {"kg": 1, "m": 2, "s": -2}),
        ("N.m", {"kg": 1, "m": 2, "s": -2}),
        ("N.m/rad", {"kg": 1, "m": 2, "s": -2, "rad": -1}),
        ("N.m.s/rad", {"kg": 1, "m": 2, "s": -1, "rad": -1}),
        ("rad/s2", {"s": -2, "rad": 1}),
        ("rad/rad", {}),
        ("J/(kg.K)", {"m": 2, "s": -2, "K": -1}),
        ("J/(rad.K)", {"kg": 1, "m": 2, "s": -2, "K": -1, "rad": -1}),
        ("sr", {"rad": 2}),
        ("Hz", {"s": -1}),
        ("cd.mol/A", {"cd": 1, "mol": 1, "A": -1}),
        ("m^(4/2)", {"m": 2}),
        ("m^(1/2)", None),
        ("rad^(1/2)", None),
    ],
)
def test_exponents(unit, powers):
    assert exponents(unit) == powers
