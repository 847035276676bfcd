"""Slider-crank of elastic or rigid bars, driven by a torque until 0.7 s (beam paper, section 5.3)."""

import acausal as ac
from acausal import Model, Scalar, chain, connect, effect, fixed, output, parameter, part, structural, time
from components import Body, BodyRod, FlexibleBeam, Prismatic, Revolute, SubstructuredBeam, World
from components.rotational import Torque

D, A, J = 2770.0, 0.7854e-4, 4.909e-10  # density, area and second moment of area of both bars


class SliderCrank(Model):
    """Crank and rod initially at rest and in line along +x, in the outer dead centre."""

    stop_time = 1.6
    formulations = ac.with_and_without(
        ac.Formulation("one frame", {"rod": "elastic", "rod_volumes": 1}, {"rod_elements": (4, 8)}),
        ac.Formulation("volumes", {"rod": "elastic"}, {"rod_volumes": (4, 8), "rod_elements": (4, 8)}, exact=True),
        ac.Formulation("volumes of 2", {"rod": "elastic"}, {"rod_volumes": (2, 4), "rod_elements": (4, 8)}, exact=True),
        stiffened="rod_bar.geometric_stiffness",
    )
    crank: str = effect("elasticity of the crank", default="elastic", choices=("elastic", "rigid"))
    rod: str = effect("elasticity of the rod", default="elastic", choices=("elastic", "rigid"))
    crank_elements: int = structural("finite elements of the crank", default=3, minimum=1)
    rod_elements: int = structural("total number of finite elements of the rod", default=8, minimum=1)
    rod_volumes: int = structural("volumes of the rod", default=1, minimum=1)
    slider_mass: Scalar = parameter("mass of the slider", unit="kg", default=0, minimum=0)
    gravity: Scalar = parameter("acceleration of gravity", unit="m/s2", default=0)
    world, guide, slider = World(g=gravity), Prismatic(), Body(m=slider_mass)
    bearing, pin, wrist = Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0)), Revolute(), Revolute()
    drive = Torque(tau=ac.piecewise((0.01 * (1 - ac.exp(-time / 0.167)), time <= 0.7), 0))
    crank_angle: Scalar = output("angle of the crank at the bearing", unit="rad")
    slider_position: Scalar = output("distance of the slider from the bearing", unit="m")
    rod_tip_deflection: Scalar = output("transverse displacement of the rod tip from the root tangent", unit="m")
    rod_mid_deflection: Scalar = output("transverse distance of the rod midpoint from the chord", unit="m")

    @part
    def crank_bar(self):
        beam = FlexibleBeam(length=0.152, E=1e9, rho=D, A=A, J=J, elements=self.crank_elements)
        return beam if self.crank == "elastic" else BodyRod(r=(0.152, 0, 0), m=D * A * 0.152)

    @part
    def rod_bar(self):
        n, rest = divmod(self.rod_elements, self.rod_volumes)
        if rest:
            raise ac.DeclarationError("rod_volumes must divide rod_elements; try rod_elements=8, rod_volumes=4.")
        beam = SubstructuredBeam(length=0.304, E=5e7, rho=D, A=A, J=J, volumes=self.rod_volumes, elements_per_volume=n)
        return beam if self.rod == "elastic" else BodyRod(r=(0.304, 0, 0), m=D * A * 0.304)

    def connections(self):
        yield from (connect(self.drive.flange, self.bearing.axis), chain(self.world, self.guide, self.slider))
        yield chain(self.world, self.bearing, self.crank_bar, self.pin, self.rod_bar, self.wrist, self.slider)

    def equations(self):
        yield from (self.crank_angle == self.bearing.phi, self.slider_position == self.guide.s)
        yield self.rod_tip_deflection == (0 if self.rod == "rigid" else self.rod_bar.node_deflection[-1, 1])
        yield self.rod_mid_deflection == (0 if self.rod == "rigid" else self.rod_bar.middle_deflection)


if __name__ == "__main__":
    ac.simulate(SliderCrank(), stop_time=SliderCrank.stop_time).plot("slider_position", path="slider-crank.png")
