"""Random machines of all components, as the source text that a user would write."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import count

import numpy as np
from hypothesis import strategies as st

HEAD = """import numpy as np

import acausal as ac
from acausal import Model, Scalar, chain, connect, fixed, guess, output, parameter, sin, time
from components import *
from components import rotational
"""

SECTION = "rho=2700, A=4e-4, J=1e-8"
AXES = ("(0, 0, 1)", "(1, 0, 0)", "(0, 1, 0)", "(1, 2, 2)")


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers of three decimals."""
    return st.integers(round(1000 * low), round(1000 * high)).map(lambda k: k / 1000)


def vectors(size: float) -> st.SearchStrategy[str]:
    """Triples of numbers, as text."""
    return st.tuples(*[numbers(-size, size)] * 3).map(str)


@dataclass
class Source:
    """Parts, connections, equations and outputs of a machine, line by line; and frames and shafts to go on from."""

    draw: st.DrawFn
    parts: list[str] = field(default_factory=list)
    connections: list[str] = field(default_factory=list)
    frames: list[str] = field(default_factory=lambda: ["self.world.frame_b"])
    outputs: dict[str, str] = field(default_factory=dict)
    names: count = field(default_factory=count)

    def part(self, kind: str, made: str) -> str:
        """Add a part and return its name."""
        name = f"{kind}{next(self.names)}"
        self.parts.append(f"{name} = {made}")
        return name

    def pick(self, *choices: str) -> str:
        """Draw one of some texts."""
        return self.draw(st.sampled_from(choices))

    def number(self, low: float, high: float) -> float:
        """Draw a number."""
        return self.draw(numbers(low, high))

    def vector(self, size: float) -> str:
        """Draw a vector, as text."""
        return self.draw(vectors(size))

    def text(self) -> str:
        """The module."""
        declared = [f"{name}: Scalar = output({name!r})" for name in self.outputs]
        lines = ["", "", "class Machine(Model):", *(f"    {line}" for line in [*self.parts, *declared])]
        if self.connections:
            lines += ["", "    def connections(self):", *(f"        yield {line}" for line in self.connections)]
        if self.outputs:
            told = (f"        yield self.{name} == {value}" for name, value in self.outputs.items())
            lines += ["", "    def equations(self):", *told]
        return HEAD + "\n".join(lines) + "\n"


def _law(s: Source, size: float) -> str:
    return s.pick(f"{s.number(-size, size)}", f"{s.number(-size, size)} * sin({s.number(0.5, 9)} * time)")


def _shaft(s: Source, flange: str, depth: int = 0, moved: bool = False) -> None:
    """Something on a shaft; friction has no torque of sticking where the motion of the shaft is given."""
    inertia = f"rotational.Inertia(J={s.number(0.01, 2)}"
    dry, last = "spring" if moved else "friction", "train" if depth < 2 else "torque"
    match s.pick("torque", "spring", "damper", "inertia", dry, "clutch", last):
        case "torque":
            s.connections.append(
                f"connect(self.{s.part('torque', f'rotational.Torque(tau={_law(s, 5)})')}.flange, {flange})"
            )
        case "spring" | "damper" as kind:
            law = f"c={s.number(1, 50)}" + ("" if kind == "spring" else f", d={s.number(0, 2)}")
            spring = s.part("spring", f"rotational.{'Spring' if kind == 'spring' else 'SpringDamper'}({law})")
            s.connections.append(f"chain({flange}, self.{spring}, self.{s.part('wall', 'rotational.Fixed()')}.flange)")
        case "inertia":
            s.connections.append(f"connect(self.{s.part('rotor', inertia + ')')}.flange_a, {flange})")
        case "friction":
            law = f"tau_sliding={s.number(0.01, 1)}"
            friction = s.part("friction", f"rotational.Friction({law})")
            s.connections.append(
                f"chain({flange}, self.{friction}, self.{s.part('wall', 'rotational.Fixed()')}.flange)"
            )
        case "clutch":
            clutch = s.part(
                "clutch",
                f"rotational.Clutch(tau_max={s.number(0.1, 5)}, f_normalized={s.pick('0.5', '1', 'sin(3 * time)**2')})",
            )
            rotor = s.part("rotor", f"{inertia}, phi=fixed(0), w=fixed({s.number(-2, 2)}))")
            s.connections.append(f"chain({flange}, self.{clutch}, self.{rotor})")
        case _:
            spring = s.part("spring", f"rotational.SpringDamper(c={s.number(1, 80)}, d={s.number(0, 1)})")
            rotor = s.part("rotor", f"{inertia}, phi=fixed({s.number(-1, 1)}), w=fixed({s.number(-2, 2)}))")
            s.connections.append(f"chain({flange}, self.{spring}, self.{rotor})")
            _shaft(s, f"self.{rotor}.flange_b", depth + 1)


def _train(s: Source) -> None:
    """A drive train of its own."""
    inertia = f"rotational.Inertia(J={s.number(0.01, 2)}"
    kind = s.pick("free", "position", "speed")
    if kind == "free":
        rotor = s.part("rotor", f"{inertia}, phi=fixed({s.number(-1, 1)}), w=fixed({s.number(-5, 5)}))")
    else:
        law = (
            f"rotational.Position(phi_ref={s.number(0.1, 1)} * sin({s.number(0.5, 5)} * time))"
            if kind == "position"
            else f"rotational.Speed(w_ref={_law(s, 3)}, phi=fixed(0))"
        )
        drive = s.part("drive", law)
        rotor = s.part("rotor", f"{inertia})")
        s.connections.append(f"chain(self.{drive}, self.{rotor})")
    s.outputs[f"angle_{rotor}"] = f"self.{rotor}.phi"
    _shaft(s, f"self.{rotor}.flange_b", moved=kind != "free")


def _joint(s: Source) -> str | None:
    """A joint between two frames; None for a rigid connection."""
    match s.pick("revolute", "revolute", "driven", "moved", "prismatic", "spherical", "rigid"):
        case "revolute":
            friction = s.pick("", f", d={s.number(0, 1)}", f", tau_dry={s.number(0, 0.5)}")
            start = f"phi=fixed({s.number(-3, 3)}), w=fixed({s.number(-3, 3)})"
            joint = s.part("hinge", f"Revolute(n={s.pick(*AXES)}, {start}{friction})")
            s.outputs[f"angle_{joint}"] = f"self.{joint}.phi"
        case "driven":
            start = f"phi=fixed({s.number(-3, 3)}), w=fixed({s.number(-3, 3)})"
            joint = s.part("hinge", f"Revolute(n={s.pick(*AXES)}, use_axis_flange=True, {start})")
            _shaft(s, f"self.{joint}.axis")
        case "moved":
            joint = s.part("hinge", f"Revolute(n={s.pick(*AXES)}, use_axis_flange=True)")
            law = f"{s.number(0.1, 1)} * sin({s.number(0.5, 5)} * time)"
            drive = s.part("drive", f"rotational.Position(phi_ref={law})")
            s.connections.append(f"connect(self.{drive}.flange, self.{joint}.axis)")
        case "prismatic":
            start = f"s=fixed({s.number(-1, 1)}), v=fixed({s.number(-1, 1)})"
            joint = s.part("slide", f"Prismatic(n={s.pick(*AXES)}, {start}, d={s.number(0, 2)})")
            s.outputs[f"travel_{joint}"] = f"self.{joint}.s"
        case "spherical":
            start = f"angles_fixed=True, angles_start={s.vector(1)}, w_rel=fixed({s.vector(2)})"
            joint = s.part("ball", f"Spherical({start})")
        case _:
            return None
    return joint


def _body(s: Source) -> tuple[str, bool]:
    """A body with mass and inertia about all axes, and whether it has a second end."""
    m, mass = s.number(0.1, 5), np.round(np.diag([s.number(0.05, 0.1) for _ in range(3)]), 3).tolist()
    along = f"({s.number(0.2, 2)}, 0, 0)"
    match s.pick("body", "shape", "rod", "box", "cylinder", "turned", "flexible", "chain"):
        case "body":
            return s.part("body", f"Body(m={m}, I={mass}, r_CM={s.vector(0.3)})"), False
        case "shape":
            return s.part("body", f"BodyShape(r={along}, m={m}, I={mass}, r_CM={s.vector(0.3)})"), True
        case "rod":
            rod = s.part("rod", f"BodyRod(r={along}, m={m})")
            # A rod has no inertia about its axis.
            return _loaded(s, rod, "disc", f"Body(m=0.1, I={mass})"), True
        case "box":
            return s.part("body", f"BodyBox(r={along}, width={s.number(0.05, 0.2)})"), True
        case "cylinder":
            return s.part("body", f"BodyCylinder(r={along}, diameter={s.number(0.05, 0.2)})"), True
        case "turned":
            bar = s.part("bar", f"FixedRotation(r={along}, n={s.pick(*AXES)}, angle={s.number(-3, 3)})")
            return _loaded(s, bar, "body", f"Body(m={m}, I={mass})"), True
        case "flexible":
            law = f"length={s.number(0.3, 1.5)}, E={s.pick('1e8', '1e9', '7e10')}, {SECTION}"
            more = s.pick(
                "", ", torsional_inertia=1e-6", ", axial='none'", ", alpha=0.1, beta=1e-4", ", geometric_stiffness=True"
            )
            beam = s.part("beam", f"FlexibleBeam({law}, elements={s.pick('1', '2', '3')}{more})")
        case _:
            law = f"length={s.number(0.5, 1.5)}, E={s.pick('1e8', '1e9')}, {SECTION}"
            beam = s.part("beam", f"SubstructuredBeam({law}, volumes={s.pick('1', '2', '3')}, beta=1e-3)")
    return _loaded(s, beam, "tip", f"Body(m={m}, I={mass})"), True


def _loaded(s: Source, part: str, name: str, body: str) -> str:
    """A part with a body on its second end."""
    s.connections.append(f"connect(self.{s.part(name, body)}.frame_a, self.{part}.frame_b)")
    return part


def _branch(s: Source) -> None:
    """A body on something that is there, or a free one."""
    body, goes_on = _body(s)
    if s.pick("joint", "joint", "joint", "free") == "free":
        start = f"angles_fixed=True, r_0=fixed({s.vector(2)}), v_0=fixed({s.vector(1)}), w_a=fixed({s.vector(2)})"
        base = s.part("base", f"Body(m=1, I=np.eye(3), {start})")
        s.connections.append(f"connect(self.{base}.frame_a, self.{body}.frame_a)")
    else:
        joint, frame = _joint(s), s.pick(*s.frames)
        s.connections.append(
            f"chain({frame}, self.{joint}, self.{body}.frame_a)" if joint else f"connect({frame}, self.{body}.frame_a)"
        )
    s.frames.append(f"self.{body}.frame_{'b' if goes_on else 'a'}")


def _four_bar(s: Source) -> None:
    """A planar loop that closes: its corners are drawn, lengths and angles follow."""
    crank, angle = s.number(0.2, 0.6), s.number(0.3, 2.8)
    B = crank * np.array([np.cos(angle), np.sin(angle)])
    D, C = np.array([s.number(1.0, 1.5), 0]), np.array([s.number(0.8, 1.6), s.number(0.7, 1.2)])
    coupler, rocker = float(np.linalg.norm(C - B)), float(np.linalg.norm(D - C))
    along, down = np.arctan2(*(C - B)[::-1]), np.arctan2(*(C - D)[::-1])
    drive = f"phi=fixed({angle}), w=fixed({s.number(-3, 3)})"
    first = s.part("crank_hinge", f"Revolute({drive})")
    arm = s.part("crank", f"BodyShape(r=({crank}, 0, 0), m={s.number(0.1, 2)}, r_CM=({crank / 2:.4g}, 0, 0))")
    second = s.part("pin", f"Revolute(phi=guess({along - angle:.4f}))")
    link = s.part("coupler", f"BodyShape(r=({coupler!r}, 0, 0), m={s.number(0.1, 2)}, r_CM=({coupler / 2:.4g}, 0, 0))")
    ground = s.part("ground", f"FixedTranslation(r=({D[0]}, 0, 0))")
    fourth = s.part("rocker_hinge", f"Revolute(phi=guess({down:.4f}))")
    last = s.part("rocker", f"BodyShape(r=({rocker!r}, 0, 0), m={s.number(0.1, 2)}, r_CM=({rocker / 2:.4g}, 0, 0))")
    third = s.part("joint", f"{s.pick('Revolute', 'RevolutePlanarLoopConstraint')}()")
    s.connections.append(
        f"chain(self.world, self.{first}, self.{arm}, self.{second}, self.{link}, self.{third}, self.{last}.frame_b)"
    )
    s.connections.append(f"chain(self.world, self.{ground}, self.{fourth}, self.{last})")
    s.outputs[f"angle_{fourth}"] = f"self.{fourth}.phi"
    s.frames.append(f"self.{link}.frame_a")


def _force(s: Source) -> None:
    """A force between two frames, or on one."""
    a, b = s.pick(*s.frames), s.pick(*s.frames)
    kind = s.pick("spring", "damper", "both", "force", "torque", "world", "turn")
    if kind in ("spring", "damper", "both"):
        law = {
            "spring": "Spring(c={0}, s_unstretched=0.1)",
            "damper": "Damper(d={1})",
            "both": "SpringDamperParallel(c={0}, d={1})",
        }
        part = s.part(kind, law[kind].format(s.number(0.1, 100), s.number(0, 5)))
        far = s.part("anchor", f"FixedTranslation(r=({s.number(2, 9)}, {s.number(2, 9)}, {s.number(2, 9)}))")
        s.connections.append(f"chain({a}, self.{far}, self.{part}, {b})")
    elif kind in ("force", "torque"):
        law = f"{kind}={s.vector(3)}, resolve_in_frame={s.pick(repr('world'), repr('frame_a'), repr('frame_b'))}"
        s.connections.append(f"chain({a}, self.{s.part(kind, f'{kind.title()}({law})')}, {b})")
    else:
        law = f"WorldForce(force={s.vector(3)})" if kind == "world" else f"WorldTorque(torque={s.vector(1)})"
        s.connections.append(f"connect(self.{s.part('load', law)}.frame_b, {b})")


@st.composite
def machines(draw: st.DrawFn) -> str:
    """Return the source of a machine that is right."""
    s = Source(draw)
    gravity = s.pick("World()", "World(g=1.62, n=(0, 0, -1))", "World(gravity=None)")
    s.parts.append(f"world = {gravity}")
    kinds = draw(
        st.lists(st.sampled_from(["branch", "branch", "branch", "force", "train", "loop"]), min_size=1, max_size=5)
    )
    made = {"branch": _branch, "force": _force, "train": _train, "loop": _four_bar}
    for kind in kinds:
        made[kind](s)
    return s.text()
