"""Values of parameters and options that cannot be."""

import acausal as ac
from acausal import Component, Model, chain, fixed, parameter, structural
from components import Body, BodyShape, FixedTranslation, FlexibleBeam, Revolute, World
from tests.errors.broken.models import SECTION, Decay, Pendulum


def beam(**values):
    class M(Model):
        world, beam = World(), FlexibleBeam(**{"length": 1, "E": 1e9, "elements": 2, **SECTION, **values})

        def connections(self):
            yield chain(self.world, self.beam)

    ac.compile(M())


def negative_length(repaired):
    beam(length=1 if repaired else -1)


def negative_modulus(repaired):
    beam(E=1e9 if repaired else -1e9)


def zero_elements(repaired):
    beam(elements=1 if repaired else 0)


def half_an_element(repaired):
    beam(elements=2 if repaired else 2.5)


def weigh(m):
    class M(Pendulum):
        mass = Body(m=m)

    ac.compile(M())


def negative_mass(repaired):
    weigh(1 if repaired else -1)


def mass_of_text(repaired):
    weigh(1 if repaired else "heavy")


def mass_of_bool(repaired):
    weigh(1 if repaired else True)


def mass_of_nan(repaired):
    weigh(1 if repaired else float("nan"))


def parameter_of_wrong_shape(repaired):
    class M(Pendulum):
        bar = FixedTranslation(r=(1, 0, 0) if repaired else (1, 0))

    ac.compile(M())


def axis_of_length_0(repaired):
    class M(Pendulum):
        hinge = Revolute(n=(0, 0, 1 if repaired else 0))

    ac.compile(M())


def unknown_argument(repaired):
    BodyShape(m=1, r=(1, 0, 0)) if repaired else BodyShape(mass=1, r=(1, 0, 0))


def number_for_variable(repaired):
    Revolute(phi=fixed(0.1) if repaired else 0.1)


def unknown_parameter(repaired):
    ac.compile(Pendulum(), parameters={"mass.m" if repaired else "mass.mm": 2})


def variable_as_parameter(repaired):
    ac.compile(Pendulum(), parameters={"mass.m" if repaired else "hinge.phi": 2})


def unknown_variable(repaired):
    ac.simulate(Pendulum(), stop_time=0.1)["mass.r_0" if repaired else "mass.r0"]


def change(**values):
    ac.compile(Pendulum()).parameter_values({name.replace("_", ".", 1): value for name, value in values.items()})


def structural_zero(repaired):
    change(bar_r=(2, 0 if repaired else 1, 0))


def structural_changed(repaired):
    change(mass_m=2) if repaired else change(hinge_n=(0, 1, 0))


def too_many_entries_when_compiled(repaired):
    change(bar_r=(2, 0, 0) if repaired else (2, 0, 0, 0))


def bool_when_compiled(repaired):
    change(mass_m=2 if repaired else True)


def nan_when_compiled(repaired):
    change(bar_r=(2 if repaired else float("nan"), 0, 0))


def run(**options):
    ac.simulate(Pendulum(), **{"stop_time": 0.1, **options})


def stop_before_start(repaired):
    run(start_time=0 if repaired else 1)


def stop_of_text(repaired):
    run(stop_time=0.1 if repaired else "0.1")


def tolerance_0(repaired):
    run(tolerance=1e-5 if repaired else 0)


def half_an_interval(repaired):
    run(intervals=2 if repaired else 2.5)


def order_6(repaired):
    run(max_order=5 if repaired else 6)


def unknown_method(repaired):
    run(method="idas" if repaired else "rk4")


def unknown_initial(repaired):
    run(initial="guesses" if repaired else "guess")


class Spectrum:
    """Frequencies of a body."""

    def __init__(self, *frequencies):
        self.frequencies = frequencies

    def __repr__(self):
        return f"Spectrum{self.frequencies}"


class Modal(Component):
    spectrum = structural("frequencies of the modes", cls=Spectrum)
    modes = structural("number of modes", default=None, cls=int, maximum=lambda s: len(s.spectrum.frequencies))

    def equations(self):
        yield from ()


def modal(**values):
    class M(Decay):
        body = Modal(**{"spectrum": Spectrum(1.0, 2.0), **values})

    ac.compile(M())


def number_for_data(repaired):
    modal(**{} if repaired else {"spectrum": 3})


def file_name_for_data_without_files(repaired):
    modal(**{} if repaired else {"spectrum": "body.npz"})


def half_a_mode(repaired):
    modal(modes=2 if repaired else 2.5)


def more_modes_than_there_are(repaired):
    modal(modes=2 if repaired else 3)


def data_that_are_missing(repaired):
    class M(Decay):
        body = Modal(spectrum=Spectrum(1.0)) if repaired else Modal()

    ac.compile(M())


def three_dimensional_parameter(repaired):
    class M(Decay):
        cube = parameter("products", shape=lambda s: (2, 2) if repaired else (2, 2, 2), default=[[1, 1], [1, 1]])

    ac.compile(M())


def array_of_one_entry_for_a_scalar(repaired):
    weigh((1.0,)[0] if repaired else (1.0,))
