import numpy as np
import pytest

from tests.reference import cantilever, rotating_beam


def test_at_rest():
    expected = cantilever.bending_frequencies(1.0, 1.0, 1.0, 3)
    np.testing.assert_allclose(rotating_beam.frequencies(0.0, False, 3), expected, rtol=1e-9)
    np.testing.assert_allclose(rotating_beam.frequencies(0.0, True, 3), expected, rtol=1e-9)


@pytest.mark.parametrize(
    ("speed", "first", "second"),
    # Wright, Smith, Thresher, Wang, Vibration modes of centrifugally stiffened beams, Journal of Applied Mechanics 49 (1982),
    # uniform beam out of the plane of rotation, hub of no radius.
    [
        (1, 3.6816, 22.1810),
        (2, 4.1373, 22.6149),
        (3, 4.7973, 23.3203),
        (4, 5.5850, 24.2733),
        (5, 6.4495, 25.4461),
        (6, 7.3604, 26.8091),
        (8, 9.2568, 29.9954),
        (10, 11.2023, 33.6404),
        (12, 13.1702, 37.6031),
    ],
)
def test_published_frequencies(speed, first, second):
    np.testing.assert_allclose(rotating_beam.frequencies(speed, False, 2), [first, second], atol=6e-5)


def test_a_string_in_the_limit():
    # At high speed the beam is a rope: frequencies sqrt(k (2 k - 1)) times the speed out of the plane, 1 and sqrt(6).
    found = rotating_beam.frequencies(300.0, False, 2) / 300
    assert found[0] == pytest.approx(1, abs=0.02)
    assert found[1] == pytest.approx(np.sqrt(6), rel=0.02)
