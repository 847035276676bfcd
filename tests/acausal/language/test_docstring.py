"""Docstring and signature of a component list its fields."""

import inspect

from acausal import (
    Component,
    Connector,
    Model,
    Scalar,
    Vector3,
    effect,
    fixed,
    flow,
    input,
    output,
    parameter,
    port,
    structural,
    variable,
)


class Clamp(Connector):
    s: Scalar = variable("position", unit="m")
    f: Scalar = flow("force", unit="N")


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
    left = port(Clamp, "left end")
    v: Scalar = variable("der(s)", unit="m/s", start=2, fixed=True)
    s: Scalar = variable("position of the right end", unit="m")
    y: Scalar = output("signal")

    @port
    def right(self) -> Clamp | None:
        """Right end."""
        return Clamp() if self.bends else None


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

Ports
-----
left : Clamp
    Left end.
right : Clamp, optional
    Right end.

Variables
---------
Start values: v=fixed(...) holds, v=guess(...) is a first guess.

v : float, in m/s
    der(s).
s : float, in m
    Position of the right end.
y : float, output
    Signal.

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
    assert (
        inspect.getdoc(Bare)
        == "Model without parameters.\n\nVariables\n---------\ny : float, output, in m\n    Output."
    )


def test_the_signature_has_types_units_and_defaults():
    assert str(inspect.signature(Rod)) == (
        "(*, m: 'float, in kg, at least 0', r: 'array, shape (3,), in m' = (0, 0, 1), J: 'float, in kg.m2, positive' = ..., "
        "kind: '\"thin\" or \"thick\"' = 'thin', n: 'int, at least 1' = 1, bends: bool = False, "
        "f: 'float or expression of time, in N' = ..., v: 'float, in m/s; fixed() or guess()' = fixed(2), "
        "s: 'float, in m; fixed() or guess()' = guess(0.0), y: 'float, output; fixed() or guess()' = guess(0.0))"
    )


def test_the_signature_follows_the_class_body():
    class Heavy(Rod):
        m = 7.5
        s = fixed(3)

    class Own(Heavy):
        def __init__(self, length, **values):
            super().__init__(r=(0, 0, length), **values)

    shown = inspect.signature(Heavy).parameters
    assert shown["m"].default == 7.5
    assert repr(shown["s"].default) == "fixed(3)"
    assert str(inspect.signature(Own)) == "(length, **values)"


def test_fields_are_shown_by_what_they_are():
    assert repr(Rod.m) == "<parameter in kg: mass>"
    assert repr(Rod.v) == "<variable in m/s: der(s)>"
    assert repr(Rod.n) == "<structural parameter: number of parts>"
    assert repr(Rod.bends) == "<effect: bending>"
    assert repr(Rod.right) == "<port: Right end.>"
