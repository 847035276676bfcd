"""Shafts and joints whose motion is prescribed twice."""

import acausal as ac
from acausal import Model, chain, connect, fixed, sin, time
from components import Body, Revolute, World
from components.rotational import Fixed, Inertia, Position, Speed, Spring


class Shaft(Model):
    """Two drives of one rotor."""

    rotor, one, two = Inertia(J=1), Position(phi_ref=time), Speed(w_ref=time)

    def connections(self):
        yield chain(self.one, self.rotor, self.two)


class Sprung(Shaft):
    """The second one turns it through a spring."""

    spring = Spring(c=1)

    def connections(self):
        yield chain(self.one, self.rotor, self.spring, self.two)


def driven_by_angle_and_constant_speed(repaired):
    class M(Model):
        rotor, position, speed = Inertia(J=1), Position(phi_ref=time), Speed(w_ref=2 + 0 * time)
        spring = Spring(c=1) if repaired else None

        def connections(self):
            yield chain(self.position, self.rotor)
            yield chain(self.speed, self.spring, self.rotor) if repaired else chain(self.speed, self.rotor)

    ac.simulate(M(), stop_time=0.1, initial="guesses")


def driven_by_two_angles(repaired):
    class M(Sprung if repaired else Shaft):
        two = Position(phi_ref=sin(time))

    ac.simulate(M(), stop_time=0.1, initial="guesses")


def driven_by_two_speeds(repaired):
    class M(Sprung if repaired else Shaft):
        one, two = Speed(w_ref=1), Speed(w_ref=2)

    ac.simulate(M(), stop_time=0.1, initial="guesses")


def driven_by_speed_and_filtered_angle(repaired):
    class M(Sprung if repaired else Shaft):
        one = Position(phi_ref=time, exact=False)

    ac.simulate(M(), stop_time=0.1, initial="guesses")


def driven_three_times(repaired):
    class M(Sprung if repaired else Shaft):
        three = Position(phi_ref=sin(time))
        third = Spring(c=1) if repaired else None

        def connections(self):
            yield from super().connections()
            yield chain(self.three, self.third, self.rotor) if repaired else chain(self.three, self.rotor)

    ac.simulate(M(), stop_time=0.1, initial="guesses")


def held_and_turned(repaired):
    class M(Sprung if repaired else Shaft):
        one, two = Position(phi_ref=0), Speed(w_ref=2)

    ac.simulate(M(), stop_time=0.1, initial="guesses")


def held_twice(repaired):
    class M(Sprung if repaired else Shaft):
        one, two = Position(phi_ref=0), Speed(w_ref=0)

    ac.simulate(M(), stop_time=0.1, initial="guesses")


def held_by_a_wall_too(repaired):
    class M(Shaft):
        one, two, spring = Speed(w_ref=0), Fixed(), Spring(c=1) if repaired else None

        def connections(self):
            end = chain(self.rotor, self.spring, self.two.flange) if repaired else chain(self.rotor, self.two.flange)
            yield from (chain(self.one, self.rotor), end)

    ac.simulate(M(), stop_time=0.1, initial="guesses")


def joint_driven_twice(repaired):
    class M(Model):
        world, hinge, mass = World(), Revolute(use_axis_flange=True), Body(m=1, r_CM=(1, 0, 0))
        motor, brake, spring = Speed(w_ref=time), Position(phi_ref=sin(time)), Spring(c=1) if repaired else None

        def connections(self):
            yield chain(self.world, self.hinge, self.mass)
            yield chain(self.motor, self.hinge.axis)
            yield (
                chain(self.brake, self.spring, self.hinge.axis)
                if repaired
                else connect(self.brake.flange, self.hinge.axis)
            )

    ac.simulate(M(), stop_time=0.1, initial="guesses")


def driven_and_prescribed(repaired):
    class M(Model):
        rotor, motor = Inertia(J=1, **({} if repaired else {"phi": fixed(0)})), Position(phi_ref=time)

        def connections(self):
            yield chain(self.motor, self.rotor)

        def equations(self):
            if not repaired:
                yield self.rotor.w == 3 + time

    ac.simulate(M(), stop_time=0.1, initial="guesses")
