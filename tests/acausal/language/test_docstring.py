"""The docstring of a component tells what its constructor takes, from its fields."""

import inspect

from acausal import Component, Model, Scalar, Vector3, effect, input, output, parameter, structural


class Rod(Component):
    """Rod.

    It is straight.

    Notes
    -----
    None.
    """

    m: Scalar = parameter("mass", unit="kg", minimum=0)
    r: Vector3 = parameter("from one end to the other", unit="m", default=(0, 0, 1), doc="It is not 0.")
    J: Scalar = parameter("moment of inertia", unit="kg.m2", default=lambda s: s.m, positive=True)
    kind: str = structural("kind", default="thin", choices=("thin", "thick"))
    n: int = structural("number of parts", default=1, minimum=1)
    bends: bool = effect("bending", default=False)
    f: Scalar = input("force", unit="N")


TEXT = """Rod.

It is straight.

Parameters
----------
m : float, in kg, at least 0
    Mass.
r : array, shape (3,), in m, default (0, 0, 1)
    From one end to the other. It is not 0.
J : float, in kg.m2, positive, optional
    Moment of inertia.
kind : "thin" or "thick", default "thin"
    Kind.
n : int, at least 1, default 1
    Number of parts.
bends : bool, default False
    Bending.
f : float or expression of time, in N
    Force.

Notes
-----
None."""


def test_parameters_stand_before_the_notes():
    assert inspect.getdoc(Rod) == TEXT


def test_values_of_the_class_body_are_its_defaults():
    class Heavy(Rod):
        """Heavy rod."""

        m = 7.5

    text = inspect.getdoc(Heavy) or ""
    assert text.startswith(
        "Heavy rod.\n\nParameters\n----------\nm : float, in kg, at least 0, default 7.5\n    Mass.\n"
    )


def test_what_a_class_says_itself_is_kept():
    class Written(Rod):
        """Rod.

        Parameters
        ----------
        m : float
            Mass.
        """

    class Silent(Rod):
        m = 1

    class Bare(Model):
        """Model without parameters."""

        y: Scalar = output("output", unit="m")

    assert (inspect.getdoc(Written) or "").endswith("m : float\n    Mass.")
    assert Silent.__doc__ is None
    assert inspect.getdoc(Bare) == "Model without parameters."
