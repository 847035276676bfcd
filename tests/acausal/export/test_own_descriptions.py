"""What a model declares of its own parameters and inputs is what an exported model says of them."""

from __future__ import annotations

import re
import zipfile

import pytest

import acausal as ac
from acausal import Model, Scalar, Vector3, chain, connect, fixed, input, output, parameter, sin, time
from components import Body, BodyRod, Revolute, World
from components.rotational import Inertia, Torque


class Arm(Model):
    L: Scalar = parameter("length of the arm", unit="m", default=0.3)
    world, joint = World(), Revolute(phi=fixed(0), w=fixed(0))
    rod = BodyRod(r=(L, 0, 0), m=1)

    def connections(self):
        yield chain(self.world, self.joint, self.rod)


class Hand(Model):
    m: Scalar = parameter("mass of the hand", unit="kg", default=1.0)
    at: Vector3 = parameter("centre of the hand", unit="m", default=(1, 2, 3))
    body = Body(m=m, r_CM=at)


class Robot(Model):
    load: Scalar = parameter("what it carries", unit="kg", default=0.3)
    place: Vector3 = parameter("where it carries it", unit="m", default=(1, 2, 3))
    same: Scalar = parameter("as heavy", unit="kg", default=load)
    world, joint, hand = World(), Revolute(phi=fixed(0), w=fixed(0)), Hand(m=load, at=place)

    def connections(self):
        yield chain(self.world, self.joint, self.hand.body)


class Plant(Model):
    u: Scalar = input("torque that the controller asks for", unit="N.m")
    motor, rotor = Torque(tau=u), Inertia(J=1, phi=fixed(0), w=fixed(0))
    w: Scalar = output("speed", unit="rad/s")

    def connections(self):
        yield connect(self.motor.flange, self.rotor.flange_a)

    def equations(self):
        yield self.w == self.rotor.w


def said(model, path, version):
    ac.export_fmu(model, path, fmi_version=version)
    text = zipfile.ZipFile(path).read("modelDescription.xml").decode()
    return dict(re.findall(r'name="([^"]*)"[^>]*?description="([^"]*)"', text))


@pytest.mark.parametrize("version", [2, 3])
def test_descriptions_are_those_of_the_declaration(tmp_path, version):
    assert said(Arm(), tmp_path / "arm.fmu", version)["L"] == "length of the arm"
    assert said(Plant(), tmp_path / "plant.fmu", version)["u"] == "torque that the controller asks for"
    found = said(Robot(), tmp_path / "robot.fmu", version)
    assert (found["load"], found["same"], found["hand.m"]) == ("what it carries", "as heavy", "mass of the hand")
    assert {found[f"place[{k}]"] for k in range(3)} == {"where it carries it"}
    assert {found[f"hand.at[{k}]"] for k in range(3)} == {"centre of the hand"}
    assert found["hand.body.m"] == "mass"


LAW = r"Give a function of time where Plant is a part: `class Whole\(Model\): part = Plant\(u=\.\.\.\)`"


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize(
    ("value", "problem"),
    [
        ([0, 1, 2], "must be one number"),
        (lambda t: t, "is a function; it must be a number"),
        ("sin(t)", "'sin\\(t\\)'; it must be a number"),
        (None, "is None; it must be a number"),
    ],
)
def test_a_value_of_an_input_that_is_no_number_tells_where_a_law_goes(compiled, value, problem):
    model = ac.compile(Plant()) if compiled else Plant()
    with pytest.raises(ac.DeclarationError, match=rf"`u`.*{problem}.* {LAW}"):
        ac.simulate(model, stop_time=1, parameters={"u": value})


def test_a_law_is_given_where_the_model_is_a_part():
    class Driven(Plant):
        motor = Torque()

        def equations(self):
            yield from super().equations()
            yield self.motor.tau == self.u

    class Whole(Model):
        part = Driven(u=sin(time))

    result = ac.simulate(Whole(), stop_time=1, tolerance=1e-8)
    assert result["part.w"][-1] == pytest.approx(0.45969769, abs=1e-6)  # 1 - cos(1)
