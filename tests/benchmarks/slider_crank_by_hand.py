"""The elastic slider-crank, derived by hand for this one planar mechanism.

No component library: the equations below were written down for a chain of planar beams and nothing else, so that their
size and speed are the mark for what a compiler makes of general components, and a place to try methods of integration.
They follow Schiavo, Vigano, Ferretti (2006), sections 3 and 5.3, with formulas derived anew.

A volume is a beam of N linear elements in its own frame, tangent at its root and moving with acceleration a, angular
acceleration z and angular velocity w, all resolved in the frame. A material point is at r = (x + S1 U, S2 U) and has the
acceleration a + z J r - w^2 r + 2 w J r' + r'' (J turns by a right angle). By virtual work, with the integrals M_ij of
Si' Sj, s_i of Si and x_i of x Si over the mass, and X_i, Y_i those of Si r_x, Si r_y,

    nodal  = a_x s1 + a_y s2 + z (X_2 - Y_1) - w^2 (X_1 + Y_2) + 2 w (M21 - M12) U' + (M11 + K11 / 12 + M22) U''
    moment = p x a + I z + w I' + X_2 . U'' - Y_1 . U''        (p, I: first and second moment of mass about the root)

K11 / 12, of the slopes of S1, makes the masses along the mean of consistent and lumped ones. The rows of `nodal` at the
root are the load there (the tip's load does not work on the root). The next frame is turned by the section's rotation as a
finite angle, or by the pin. The crank's angle phi is the only state of the rigid motion; the rod's angle theta and angular
velocity w follow from the slider's y = 0 and y' = 0, its reaction N from y'' = 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from tests.benchmarks.planar_element import beam_matrices


@dataclass(frozen=True)
class Section:
    """A beam of section 5.3, in SI units."""

    length: float
    E: float
    rho: float = 2770.0
    A: float = 0.7854e-4
    J: float = 4.909e-10


CRANK, ROD = Section(0.152, 1e9), Section(0.304, 5e7)


@dataclass(frozen=True)
class HandModel:
    """Semi-explicit DAE of the mechanism.

    Attributes
    ----------
    dae : dict
        ``t x z p ode alg quad`` for `casadi.integrator`; p is 1 while the torque acts, quad the power supplied.
    outputs, energy : casadi.Function
        Of (x, z): crank angle, slider position, deflection of the rod's end and middle; energy stored.
    kinds : list of str
        Of each state: angle, rate, and for the elastic coordinates u, v, theta and their rates du, dv, dtheta.
    """

    dae: dict[str, ca.SX]
    outputs: ca.Function
    energy: ca.Function
    kinds: list[str]


def _cross(r: ca.SX, f: ca.SX) -> ca.SX:
    return r[0] * f[1] - r[1] * f[0]


def _turn(angle: ca.SX, r: ca.SX) -> ca.SX:
    c, s = ca.cos(angle), ca.sin(angle)
    return ca.vertcat(c * r[0] - s * r[1], s * r[0] + c * r[1])


@dataclass(frozen=True)
class Motion:
    """Motion of a frame: position in the world, angle, and in its own axes velocity, acceleration; w, z angular ones."""

    r: ca.SX
    angle: ca.SX
    v: ca.SX
    w: ca.SX
    a: ca.SX
    z: ca.SX


def _right_angle(r: ca.SX) -> ca.SX:
    return ca.vertcat(-r[1], r[0])


class Volume:
    """A beam in its frame: unknown coordinates, and the inertia and elastic forces of the motion of the frame."""

    def __init__(self, section: Section, elements: int, rigid: bool, name: str) -> None:
        self.section, self.N = section, elements
        self.l = section.length / elements
        self.free = [] if rigid else list(range(3, 3 * elements + 3))
        self.q, self.qd, self.qdd = (ca.SX.sym(f"{name}_{s}", len(self.free)) for s in ("q", "qd", "qdd"))
        self.U, self.Ud, self.Udd = (self._nodes(q) for q in (self.q, self.qd, self.qdd))
        self.mu = section.rho * section.A * self.l
        b = beam_matrices(elements)
        self.s1, self.s2, self.x1, self.x2 = (ca.sparsify(ca.DM(s)) for s in (b.s1, b.s2, b.x1, b.x2))
        self.M11, self.M12, self.M22 = (ca.sparsify(ca.DM(m)) for m in (b.M11, b.M12, b.M22))
        # Masses along are the mean of consistent and lumped ones; those exceed these by an integral of S1'' S1' over six.
        self.own = self.M11 + self.M22 + ca.sparsify(ca.DM(b.K_axial)) / 12
        stiffness = section.E * section.A / self.l * b.K_axial + section.E * section.J / self.l**3 * b.K_bending
        self.K = ca.sparsify(ca.DM(stiffness))
        self.X1, self.Y1 = self.M11 @ self.U + self.l * self.x1, self.M12 @ self.U
        self.X2, self.Y2 = self.M12.T @ self.U + self.l * self.x2, self.M22 @ self.U
        xx = self.N**3 / 3 * self.l**2 + self.l * ca.dot(self.x1, self.U) + ca.dot(self.U, self.X1)
        self.I = self.mu * (xx + ca.dot(self.U, self.Y2))
        self.p = self.mu * ca.vertcat(self.N**2 / 2 * self.l + ca.dot(self.s1, self.U), ca.dot(self.s2, self.U))

    def _nodes(self, q: ca.SX) -> ca.SX:
        U = ca.SX(3 * self.N + 3, 1)
        for k, index in enumerate(self.free):
            U[index] = self.l * q[k] if index % 3 == 2 else q[k]
        return U

    @property
    def kinds(self) -> list[str]:
        """Kind of each elastic coordinate."""
        return [("u", "v", "theta")[index % 3] for index in self.free]

    @property
    def tip(self) -> ca.SX:
        """Position of the tip."""
        return ca.vertcat(self.section.length + self.U[-3], self.U[-2])

    @property
    def tip_rotation(self) -> ca.SX:
        """Rotation of the section at the tip."""
        return self.U[-1] / self.l

    @property
    def middle(self) -> ca.SX:
        """Position of the material middle point."""
        half = self.N // 2
        a = self.U[3 * half : 3 * half + 3]
        if self.N % 2:
            b = self.U[3 * half + 3 : 3 * half + 6]
            a = ca.vertcat((a[0] + b[0]) / 2, (a[1] + b[1]) / 2 + (a[2] - b[2]) / 8)
        return ca.vertcat(self.section.length / 2 + a[0], a[1])

    def tip_motion(self, root: Motion) -> tuple[ca.SX, ca.SX, ca.SX]:
        """Position of the tip in the world, velocity and acceleration in the frame."""
        (r, rd, rdd), w = (self.tip, self.Ud[-3:-1], self.Udd[-3:-1]), root.w
        v = root.v + rd + w * _right_angle(r)
        a = root.a + rdd + root.z * _right_angle(r) - w**2 * r + 2 * w * _right_angle(rd)
        return root.r + _turn(root.angle, r), v, a

    def balances(self, motion: Motion, root: ca.SX, load: ca.SX) -> list[ca.SX]:
        """Balances of nodes, of moment about the root, and of force; `root`, `load`: (f_x, f_y, t) at root and tip."""
        a, z, w = motion.a, motion.z, motion.w
        inertia = self.mu * (
            a[0] * self.s1
            + a[1] * self.s2
            + z * (self.X2 - self.Y1)
            - w**2 * (self.X1 + self.Y2)
            + 2 * w * (self.M12.T @ self.Ud - self.M12 @ self.Ud)
            + self.own @ self.Udd
        )
        nodal = inertia + self.K @ self.U
        nodal[-3:] -= ca.vertcat(load[0], load[1], load[2] / self.l)
        Id = 2 * self.mu * (ca.dot(self.X1, self.Ud) + ca.dot(self.Y2, self.Ud))
        moment = _cross(self.p, a) + self.I * z + w * Id + self.mu * ca.dot(self.X2 - self.Y1, self.Udd)
        moment -= root[2] + load[2] + _cross(self.tip, load)
        force = nodal[:2]
        if not self.free:
            force = self.mu * self.N * a + z * _right_angle(self.p) - w**2 * self.p - load[:2]
        return [nodal[self.free], moment, force - root[:2]]

    def energy(self, v: ca.SX, w: ca.SX) -> ca.SX:
        """Kinetic and elastic energy; velocity v of the root resolved in the frame."""
        pd = self.mu * ca.vertcat(ca.dot(self.s1, self.Ud), ca.dot(self.s2, self.Ud))
        spin = self.mu * ca.dot(self.X2 - self.Y1, self.Ud)
        own = self.mu * ca.dot(self.Ud, self.own @ self.Ud)
        moving = self.mu * self.N * ca.dot(v, v) + 2 * ca.dot(v, w * _right_angle(self.p) + pd)
        return (moving + self.I * w**2 + 2 * w * spin + own + ca.dot(self.U, self.K @ self.U)) / 2


class Joint:
    """Tip of a volume and root of the next: the pin for the first, else one section; the next frame's motion is unknown.

    The unknowns are the motion theta, w, z, a_x, a_y of the next frame and the load f_x, f_y, and t if it is no pin, on
    the next volume, resolved in the next frame.
    """

    def __init__(self, i: int, volume: Volume, motion: Motion) -> None:
        pin = i == 0
        there = [ca.SX.sym(f"{s}{i}") for s in ("theta", "w", "z", "a_x", "a_y", "f_x", "f_y")]
        theta, w, z, a_x, a_y, f_x, f_y = there
        t = ca.SX(0) if pin else ca.SX.sym(f"t{i}")
        turn = theta - motion.angle
        r, v, a = volume.tip_motion(motion)
        self.unknowns = ca.vertcat(*there) if pin else ca.vertcat(*there, t)
        self.motion = Motion(r, theta, _turn(-turn, v), w, ca.vertcat(a_x, a_y), z)
        self.cut = ca.vertcat(f_x, f_y, t)
        self.load = -ca.vertcat(_turn(turn, self.cut[:2]), t)
        section = [U[-1] / volume.l for U in (volume.U, volume.Ud, volume.Udd)]
        turned = [] if pin else [turn - section[0], w - motion.w - section[1], z - motion.z - section[2]]
        self.constraints = ca.vertcat(self.motion.a - _turn(-turn, a), *turned)


def build(
    crank: str = "elastic",
    crank_elements: int = 3,
    rod_elements: int = 8,
    rod_volumes: int = 1,
    slider_mass: float = 0.0,
) -> HandModel:
    """Write down the DAE of the mechanism.

    Parameters
    ----------
    crank : str
        elastic or rigid.
    crank_elements, rod_elements : int
        Finite elements; the rod's in all volumes together.
    rod_volumes : int
        Substructures of the rod.
    slider_mass : float
        In kg.
    """
    t, on, phi, w, z, N = (ca.SX.sym(s) for s in ("t", "on", "phi", "w", "z", "N"))
    part = Section(ROD.length / rod_volumes, ROD.E)
    volumes = [Volume(CRANK, crank_elements if crank == "elastic" else 1, crank == "rigid", "crank")]
    volumes += [Volume(part, rod_elements // rod_volumes, False, f"rod{i}") for i in range(rod_volumes)]
    torque, origin = on * 0.01 * (1 - ca.exp(-t / 0.167)), ca.SX(2, 1)
    motion, root = Motion(origin, phi, origin, w, origin, z), ca.vertcat(0, 0, torque)
    unknowns, balances, constraints, stored = [z], [], [], ca.SX(0)
    for i, volume in enumerate(volumes):
        stored += volume.energy(motion.v, motion.w)
        if i < rod_volumes:
            joint = Joint(i, volume, motion)
            load = joint.load
            unknowns += [volume.qdd, joint.unknowns]
            constraints.append(joint.constraints)
        else:
            r, v, a = volume.tip_motion(motion)
            slider = r, _turn(motion.angle, v), _turn(motion.angle, a)
            load = ca.vertcat(_turn(-motion.angle, ca.vertcat(-slider_mass * slider[2][0], N)), 0)
            unknowns += [volume.qdd, N]
            # it stays on its line, at all levels
            constraints += [level[1] for level in slider]
        nodal, moment, force = volume.balances(motion, root, load)
        balances += [nodal, moment] if i == 0 else [nodal, moment, force]
        motion, root = joint.motion, joint.cut
    q, qd, qdd = (ca.vertcat(*(getattr(b, s) for b in volumes)) for s in ("q", "qd", "qdd"))
    x, y = ca.vertcat(phi, q, w, qd), ca.vertcat(*unknowns)
    dae = {"t": t, "p": on, "x": x, "z": y, "ode": ca.vertcat(w, qd, z, qdd), "quad": torque * w}
    dae["alg"] = ca.vertcat(*balances, *constraints)
    kinds = [kind for volume in volumes for kind in volume.kinds]
    return HandModel(
        dae,
        ca.Function("outputs", [x, y], [ca.vertcat(phi, slider[0][0], *_deflections(volumes))]),
        ca.Function("energy", [x, y], [stored + slider_mass * slider[1][0] ** 2 / 2]),
        ["angle", *kinds, "rate", *("d" + k for k in kinds)],
    )


def _deflections(volumes: list[Volume]) -> list[ca.SX]:
    """Of the rod's end from the tangent at its root, and of its material middle point from the chord."""
    rod, place, angle = volumes[1:], ca.SX(2, 1), ca.SX(0)
    middle = None
    for i, volume in enumerate(rod):
        if len(rod) % 2 and i == len(rod) // 2:
            middle = place + _turn(angle, volume.middle)
        elif i == len(rod) // 2:
            middle = place
        place, angle = place + _turn(angle, volume.tip), angle + volume.tip_rotation
    return [place[1], _cross(place, middle) / ca.norm_2(place)]
