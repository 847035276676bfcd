"""Components and simulations with any values for their arguments, as source text."""

from __future__ import annotations

from hypothesis import strategies as st

import components
from acausal import Component
from components import TwoFlanges, TwoFrames, rotational
from tests.fuzz.damage import VALUES
from tests.fuzz.machines import HEAD, numbers

CLASSES: dict[str, type[Component]] = {
    name: cls
    for prefix, module in (("", components), ("rotational.", rotational))
    for name, cls in ((prefix + name, getattr(module, name)) for name in module.__all__)
    if isinstance(cls, type) and issubclass(cls, Component) and not name.endswith("DrivenJoint")
}
NAMES = sorted({field for cls in CLASSES.values() for field in cls.fields})
GIVEN = {
    "Body": "m=1, I=np.eye(3)",
    "BodyBox": "r=(1, 0, 0), width=0.1",
    "BodyCylinder": "r=(1, 0, 0), diameter=0.1",
    "BodyRod": "r=(1, 0, 0), m=1",
    "BodyShape": "r=(1, 0, 0), m=1, I=np.eye(3)",
    "FlexibleBeam": "length=1, E=1e9, rho=1e3, A=1e-3, J=1e-7",
    "SubstructuredBeam": "length=1, E=1e9, rho=1e3, A=1e-3, J=1e-7, volumes=2",
    "rotational.Inertia": "J=1, phi=fixed(0), w=fixed(1)",
    "Revolute": "phi=fixed(0.1), w=fixed(0)",
    "Prismatic": "s=fixed(0.1), v=fixed(0)",
    "Spherical": "angles_fixed=True, w_rel=fixed((1, 2, 3))",
}


@st.composite
def constructed(draw: st.DrawFn) -> str:
    """Return a small machine around one component with some arguments of any kind."""
    name = draw(st.sampled_from(sorted(CLASSES)))
    cls = CLASSES[name]
    fields = st.sampled_from(sorted(cls.fields)) if cls.fields and draw(st.booleans()) else st.sampled_from(NAMES)
    values = st.sampled_from(VALUES) | numbers(-10, 10).map(str)
    given = draw(st.dictionaries(fields, values, min_size=1, max_size=3))
    usual = GIVEN.get(name, "")
    extra = ", ".join(f"{key}={value}" for key, value in given.items() if f"{key}=" not in usual)
    changed = usual
    for key, value in given.items():
        if f"{key}=" in usual and "(" not in usual:
            changed = ", ".join(
                f"{key}={value}" if part.startswith(f"{key}=") else part for part in changed.split(", ")
            )
    made = f"{name}({', '.join(part for part in (changed, extra) if part)})"
    return HEAD + SURROUNDINGS[_ends(cls)].replace("MADE", made)


def _ends(cls: type[Component]) -> str:
    if issubclass(cls, TwoFlanges):
        return "flanges"
    if issubclass(cls, TwoFrames):
        return "frames"
    return "one"


SURROUNDINGS = {
    "frames": """
class Machine(Model):
    world = World()
    hinge = Revolute(phi=fixed(0.1), w=fixed(0))
    arm = BodyShape(r=(1, 0, 0), m=1, I=np.eye(3))
    it = MADE
    tip = Body(m=1, I=np.eye(3))

    def connections(self):
        yield chain(self.world, self.hinge, self.arm, self.it, self.tip)
""",
    "flanges": """
class Machine(Model):
    first = rotational.Inertia(J=1, phi=fixed(0), w=fixed(1))
    it = MADE
    last = rotational.Inertia(J=1, phi=guess(0), w=guess(0))

    def connections(self):
        yield chain(self.first, self.it, self.last)
""",
    "one": """
class Machine(Model):
    world = World()
    hinge = Revolute(phi=fixed(0.1), w=fixed(0), use_axis_flange=True)
    arm = BodyShape(r=(1, 0, 0), m=1, I=np.eye(3))
    it = MADE

    def connections(self):
        yield chain(self.world, self.hinge, self.arm)
        port = next(iter(p for name in ("frame_a", "frame_b", "flange") if (p := getattr(self.it, name, None))), None)
        yield connect(port, self.hinge.axis if hasattr(self.it, "flange") else self.arm.frame_b)
""",
}

SMALL = """
class Machine(Model):
    world = World()
    hinge = Revolute(phi=fixed(0.1), w=fixed(0))
    arm = BodyShape(r=(1, 0, 0), m=1, I=np.eye(3))
    angle: Scalar = output("angle")

    def connections(self):
        yield chain(self.world, self.hinge, self.arm)

    def equations(self):
        yield self.angle == self.hinge.phi

"""
OPTIONS = (
    *(
        "stop_time",
        "start_time",
        "tolerance",
        "accuracy",
        "intervals",
        "parameters",
        "initial",
        "method",
        "constraints",
    ),
    *("max_order", "energy", "progress", "model", "time"),
)
MORE = (
    *(
        "'idas'",
        "'states'",
        "'guesses'",
        "'steady'",
        "{'arm.m': 2}",
        "{'arm.m': 0}",
        "{'arm.m': -1}",
        "{'arm': 1}",
        "{1: 2}",
    ),
    *(
        "{'arm.m': 'x'}",
        "{'hinge.phi': 1}",
        "{'arm.r': (1, 2)}",
        "['arm.m', 2]",
        "5",
        "1e-6",
        "12",
        "0.5",
        "{'arm.m': time}",
    ),
)
CALLS = (
    *(
        "ac.simulate(Machine(), OPTIONS)",
        "ac.simulate(ac.compile(Machine()), OPTIONS)",
        "ac.linearize(Machine(), OPTIONS)",
    ),
    *(
        "ac.compile(Machine(), VALUE)",
        "ac.simulate(VALUE, OPTIONS)",
        "ac.compile(VALUE)",
        "ac.simulate(Machine, OPTIONS)",
    ),
    *(
        "ac.simulate(Machine(), stop_time=1)[VALUE]",
        "ac.simulate(Machine(), stop_time=1).plot(VALUE)",
        "ac.linearize(VALUE)",
    ),
    *("ac.simulate(Machine(), stop_time=1).to_csv(VALUE)", "ac.simulate(Machine(), stop_time=1).to_dataframe(VALUE)"),
    *("ac.simulate(Machine(), stop_time=1)['arm.frame_a.r_0', VALUE]", "ac.study(VALUE)", "ac.effects(VALUE)"),
)


@st.composite
def options(draw: st.DrawFn) -> str:
    """Return a small machine, and a call with any options."""
    values = st.sampled_from((*VALUES, *MORE, *MORE))
    names = st.sampled_from(OPTIONS)
    given = draw(st.dictionaries(names, values, min_size=1, max_size=3))
    call = draw(st.sampled_from(CALLS))
    call = call.replace("OPTIONS", ", ".join(f"{key}={value}" for key, value in given.items()))
    return HEAD + SMALL + call.replace("VALUE", draw(values)) + "\n"
