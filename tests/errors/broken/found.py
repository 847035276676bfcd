"""What random machines and random arguments found."""

from __future__ import annotations

import numpy as np

import acausal as ac
from acausal import Scalar, der, fixed, sin, time, variable
from components import Body, Revolute, Spring, World
from tests.acausal.solve.wheels import Car
from tests.errors.broken.models import Decay, Pendulum


def port_of_a_number(repaired):
    Body(m=1) if repaired else Body(m=1, frame_a=0.5)


def port_with_a_start(repaired):
    Revolute(phi=fixed(1)) if repaired else Revolute(frame_a=fixed(1))


def start_from_a_variable(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=1 if repaired else Decay.x, fixed=True)

        def more(self):
            yield der(self.z) == -self.z

    ac.simulate(M(), stop_time=0.1)


def number_of_400_digits(repaired):
    sin((2 if repaired else 10**400) * time)


def complex_number_of_numpy(repaired):
    sin((2 if repaired else np.complex128(1 + 2j)) * time)


def array_of_objects(repaired):
    sin(time) * (2 if repaired else np.array([1, None]))


def class_that_is_no_model(repaired):
    class M:
        def equations(self):
            yield from ()

    ac.compile(Decay() if repaired else M())  # type: ignore[arg-type]


def free_end_without_start(repaired):
    """A body on a spring, whose orientation has no start."""
    free = {"r_0": fixed((2, 0, 0)), "v_0": fixed((0, 0, 0)), "w_a": fixed((0, 0, 0)), "angles_fixed": True}

    class M(Pendulum):
        spring, tip = Spring(c=1), Body(m=1, I=np.eye(3), **(free if repaired else {}))

        def connections(self):
            yield from super().connections()
            yield ac.chain(self.bar, self.spring, self.tip)

    ac.simulate(M(), stop_time=0.01)


def parameter_that_changes(repaired):
    class M(Pendulum):
        mass = Body(m=2 if repaired else 2 + time)

    ac.compile(M())


def choice_of_an_array(repaired):
    class M(Pendulum):
        world = World(gravity=None if repaired else np.eye(3))

    ac.compile(M())


def wheels_steered_by_one_angle(repaired):
    ac.simulate(Car(ackermann=repaired), stop_time=1, tolerance=1e-8)
