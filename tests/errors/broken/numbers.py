"""Values that there are not: divisions by 0, laws outside their range, parameters that are 0, settings of a run."""

import acausal as ac
from acausal import (
    Model,
    Scalar,
    acos,
    chain,
    cos,
    der,
    fixed,
    log,
    output,
    parameter,
    piecewise,
    quantity,
    reinit,
    sin,
    sqrt,
    time,
    variable,
    when,
)
from components import Body, World, rotational
from tests.errors.broken.models import Decay, Pendulum

E = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def law(function, of=1.0, stop=0.1, **simulate):
    """Run der(x) == function(x)."""

    class M(Model):
        x: Scalar = variable("x", start=of, fixed=True)
        k: Scalar = parameter("k", default=1.0)

        def equations(self):
            yield der(self.x) == function(self)

    ac.simulate(M(), stop_time=stop, **simulate)


def rate_divides_by_zero(repaired):
    law(lambda m: 1 / m.x, 1 if repaired else 0)


def rate_zero_over_zero(repaired):
    law(lambda m: 1 if repaired else (m.x - 1) / sin(m.x - 1))


def root_of_a_negative_number(repaired):
    law(lambda m: sqrt(m.x - (0.5 if repaired else 2)))


def acos_beyond_one(repaired):
    law(lambda m: acos((0.5 if repaired else 1.5) * m.x))


def root_of_a_parameter(repaired):
    law(lambda m: sqrt(m.k if repaired else -m.k))


def slope_that_is_infinite(repaired):
    law(lambda m: sqrt(m.x + (1e-6 if repaired else 0)), 0)


def root_that_ends(repaired):
    law(lambda m: -1 - sqrt(m.x), stop=0.5 if repaired else 0.8, intervals=20, method="idas")


def without_solution_later(repaired):
    class M(Model):
        x: Scalar = variable("x", start=1, fixed=True)
        z: Scalar = variable("z", start=1)

        def equations(self):
            yield der(self.x) == -1
            yield self.z**2 == (self.x * self.x if repaired else self.x)

    ac.simulate(M(), stop_time=0.8 if repaired else 1.5, intervals=20)


def implicit_division(repaired):
    class M(Decay):
        z: Scalar = variable("z")

        def more(self):
            yield self.z + sin(self.z) == 1 / (self.x - (2 if repaired else 1))

    ac.simulate(M(), stop_time=0.1)


def implicit_without_guess(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=1 if repaired else 0)

        def more(self):
            yield cos(self.z) == 0.5 * self.x

    ac.simulate(M(), stop_time=0.1)


def square_that_is_negative(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=1 if repaired else 0)

        def more(self):
            yield self.z**2 == (1 if repaired else -1)

    ac.simulate(M(), stop_time=0.1)


def logarithm_of_a_guess(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=1 if repaired else 0)

        def more(self):
            yield log(self.z) == self.x

    ac.simulate(M(), stop_time=0.1)


def initial_equation_without_value(repaired):
    class M(Model):
        x: Scalar = variable("x")

        def equations(self):
            yield der(self.x) == -self.x

        def initial_equations(self):
            yield self.x == sqrt((2 if repaired else -2) + self.x)

    ac.simulate(M(), stop_time=0.1)


def condition_without_value(repaired):
    class M(Decay):
        def more(self):
            yield when(log(self.x - (0 if repaired else 2)) < -1, reinit(self.x, 1))

    ac.simulate(M(), stop_time=0.1)


def jump_without_value(repaired):
    class M(Decay):
        def more(self):
            yield when(self.x < 0.95, reinit(self.x, sqrt(self.x - (0 if repaired else 2))))

    ac.simulate(M(), stop_time=0.1, method="idas")


def jump_of_a_derivative(repaired):
    class M(Model):
        y: Scalar = variable("y")
        v: Scalar = variable("v")

        def equations(self):
            yield self.y == piecewise((0, time < 0.05), time - 0.05 if repaired else 1)
            yield self.v == der(self.y)

    ac.simulate(M(), stop_time=0.1)


def rest_without_value(repaired):
    law(lambda m: -log(m.x), 1, initial="steady") if repaired else law(lambda m: -1 / m.x, 0, initial="steady")


class Unsteady(Model):
    x: Scalar = variable("x", start=1)
    k: Scalar = parameter("k", default=1.0)

    def equations(self):
        yield der(self.x) == self.k * (1 + self.x * self.x)


def rest_that_there_is_not(repaired):
    ac.simulate(Decay() if repaired else Unsteady(), stop_time=0.1, initial="fixed" if repaired else "steady")


def linear_without_slope(repaired):
    class M(Model):
        x: Scalar = variable("x", start=1 if repaired else 0, fixed=True)
        y: Scalar = output("y")

        def equations(self):
            yield der(self.x) == -self.x
            yield self.y == sqrt(self.x)

    ac.linearize(M())


def inertia_zero_later(repaired):
    class M(Model):
        shaft = rotational.Inertia(J=1, phi=fixed(0), w=fixed(1))

    ac.simulate(ac.compile(M()), parameters={"shaft.J": 2 if repaired else 0}, stop_time=0.1)


def mass_zero_later(repaired):
    ac.simulate(ac.compile(Pendulum()), parameters={"mass.m": 2 if repaired else 0}, stop_time=0.1)


def mass_zero_linearized(repaired):
    ac.linearize(ac.compile(Pendulum()), parameters={"mass.m": 2 if repaired else 0})


class Quotient(Decay):
    q: Scalar = parameter("q", default=1.0)
    ratio: Scalar = parameter("ratio", default=1 / q)
    z: Scalar = variable("z", start=0, fixed=True)

    def more(self):
        yield der(self.z) == self.ratio


def parameter_that_divides(repaired):
    ac.compile(Quotient(q=1 if repaired else 0))


def parameter_that_divides_later(repaired):
    ac.simulate(ac.compile(Quotient()), parameters={"q": 2 if repaired else 0}, stop_time=0.1)


def centre_of_gravity_field(repaired):
    class M(Model):
        world = World(gravity="point", mu=1)
        moon = Body(
            m=1,
            I=E,
            r_0=fixed((1 if repaired else 0, 0, 0)),
            v_0=fixed((0, 1, 0)),
            w_a=fixed((0, 0, 0)),
            angles_fixed=True,
        )

    ac.simulate(M(), stop_time=0.1)


def run(model=None, **settings):
    ac.simulate(model or Decay(), **{"stop_time": 0.1, **settings})


def stop_time_nan(repaired):
    run(stop_time=0.1 if repaired else float("nan"))


def stop_time_infinite(repaired):
    run(stop_time=0.1 if repaired else float("inf"))


def stop_time_with_a_unit(repaired):
    run(stop_time=0.1 if repaired else quantity(0.1, "s"))


def start_time_of_text(repaired):
    run(start_time=0.0 if repaired else "0")


def times_too_near(repaired):
    run(start_time=0 if repaired else 1e17, stop_time=100 if repaired else 1e17 + 100)


def ten_billion_intervals(repaired):
    run(intervals=10 if repaired else 10**10)


def intervals_of_a_float(repaired):
    run(intervals=1000 if repaired else 1e3)


def tolerance_below_rounding(repaired):
    run(tolerance=1e-9 if repaired else 1e-30)


def energy_of_text(repaired):
    run(energy=True if repaired else "no")


def progress_of_bool(repaired):
    run(progress=(lambda part, steps: None) if repaired else True)


def start_values_as_a_setting(repaired):
    run(initial="fixed" if repaired else {"x": 2})


def parameters_as_a_list(repaired):
    run(parameters={"p": 3} if repaired else ["p"])


def parameter_by_number(repaired):
    run(parameters={"p": 3} if repaired else {0: 3})


def parameter_inside_its_part(repaired):
    run(ac.compile(Pendulum()), parameters={"mass.m": 2} if repaired else {"mass": {"m": 2}})


def parameter_with_a_unit(repaired):
    run(ac.compile(Pendulum()), parameters={"mass.m": 2 if repaired else quantity(2, "m")})


def parameter_of_two(repaired):
    run(ac.compile(Pendulum()), parameters={"mass.m": 2 if repaired else [1, 2]})


def class_of_a_model(repaired):
    run(Decay() if repaired else Decay)


def name_of_a_model(repaired):
    run(Decay() if repaired else "spin-up")


def no_model(repaired):
    ac.simulate(Decay() if repaired else None, stop_time=0.1)


def part_of_a_model(repaired):
    run(Pendulum() if repaired else Pendulum().mass)


def inside_of_a_compiled_model(repaired):
    compiled = ac.compile(Decay())
    run(compiled if repaired else compiled.tree)


def compiled_twice(repaired):
    ac.compile(Decay() if repaired else ac.compile(Decay()))


def class_linearized(repaired):
    ac.linearize(Decay() if repaired else Decay)


def linearized_at_a_text(repaired):
    ac.linearize(Decay(), time=0 if repaired else "0")


def nothing_studied(repaired):
    if not repaired:
        ac.study(None)


def effects_of_a_class(repaired):
    if not repaired:
        ac.effects(Pendulum, stop_time=0.1)


def friction_without_limit(repaired):
    class Brake(Model):
        rotor = rotational.Inertia(J=1, phi=fixed(0), w=fixed(1))
        brake = rotational.Friction(tau_sliding=1e3 if repaired else 1e300)
        wall = rotational.Fixed()

        def connections(self):
            yield chain(self.rotor.flange_b, self.brake, self.wall.flange)

    run(Brake())
