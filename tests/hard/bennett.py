"""Loops whose constraints follow from one another in turns: Bennett's linkage, and two equal cranks."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from acausal import Model, chain, connect, discrete, fixed, guess, part, parts, reinit, sin, structural, when
from components import BodyShape, Fixed, FixedTranslation, Revolute, World

# Lengths and twists of the links, a / sin(alpha) = b / sin(beta); where the first joint begins, and how fast.
LENGTH, TWIST = np.array([1.0, 1.5]), np.array([0.6, np.arcsin(1.5 * np.sin(0.6))])
RATIO = np.sin((TWIST[1] + TWIST[0]) / 2) / np.sin((TWIST[1] - TWIST[0]) / 2)
GRAVITY, MASS, INERTIA, SPEED = 9.81, 1.0, 0.1, 3.0
ASKEW = Rotation.from_rotvec(2.1 * np.array([0.3, -1.0, 0.2]) / np.linalg.norm([0.3, -1.0, 0.2])).as_matrix()


def second(angle):
    """Angle of the second joint where the first has one: tan(theta_1 / 2) tan(theta_2 / 2) is constant (Bennett 1903)."""
    return 2 * np.arctan2(RATIO * np.cos(angle / 2), np.sin(angle / 2))


def joints(angle: float) -> tuple[np.ndarray, np.ndarray]:
    """Positions and axes of the four joints, shape (4, 3), by the parameters of Denavit and Hartenberg."""
    angles = [angle, second(angle), -angle, -second(angle)]
    at, turned, places, axes = np.zeros(3), np.eye(3), [], []
    for theta, a, alpha in zip(angles, [*LENGTH, *LENGTH], [*TWIST, *TWIST], strict=True):
        places.append(at)
        axes.append(turned[:, 2])
        turned = turned @ Rotation.from_rotvec([0, 0, theta]).as_matrix()
        at = at + turned @ [a, 0, 0]
        turned = turned @ Rotation.from_rotvec([alpha, 0, 0]).as_matrix()
    assert np.abs(at).max() < 1e-12
    assert np.abs(turned - np.eye(3)).max() < 1e-12
    return np.array(places), np.array(axes)


def energies(angle: float, down: np.ndarray) -> tuple[float, float]:
    """Kinetic energy of a unit speed of the first joint, and potential energy."""
    step = 1e-5
    (back, _), (here, axes), (ahead, _) = (joints(angle + s) for s in (-step, 0.0, step))
    speeds = 1.0, (second(angle + step) - second(angle - step)) / (2 * step)
    kinetic, potential, turning = 0.0, 0.0, np.zeros(3)
    for k, speed in enumerate((*speeds, -speeds[0])):
        turning = turning + speed * axes[k]
        centre = (ahead[k] + ahead[k + 1] - back[k] - back[k + 1]) / (4 * step)
        kinetic += 0.5 * MASS * centre @ centre + 0.5 * INERTIA * turning @ turning
        potential -= MASS * GRAVITY * down @ (here[k] + here[k + 1]) / 2
    return kinetic, potential


class Bennett(Model):
    """Four bars with skewed axes that move all the same: one freedom, where six constraints meet four joints."""

    begins: float = structural("angle of the first joint at the start, rad", default=0.8)
    turned: np.ndarray = structural("how all of it is turned against gravity", default=np.eye(3), shape=(3, 3))
    crossings = discrete("how often the first joint came to its angle")
    world = World(g=GRAVITY)

    @part
    def end(self):
        """Where the last joint is held."""
        return Fixed(r=tuple(self.turned @ joints(self.begins)[0][3]))

    @parts
    def joint(self):
        """The joints; the first one begins to turn."""
        axes = [tuple(self.turned @ axis) for axis in joints(self.begins)[1]]
        return [Revolute(n=axes[0], phi=fixed(0), w=fixed(SPEED)), *(Revolute(n=axis) for axis in axes[1:])]

    @parts
    def link(self):
        """The moving links, whose centres lie midway."""
        ways = np.diff(joints(self.begins)[0], axis=0) @ self.turned.T
        return [BodyShape(r=tuple(way), r_CM=tuple(way / 2), m=MASS, I=INERTIA * np.eye(3)) for way in ways]

    def connections(self):
        links = [one for pair in zip(self.joint, self.link, strict=False) for one in pair]
        yield chain(self.world, *links, self.joint[3], self.end.frame_b)

    def equations(self):
        yield when(sin(self.joint[0].phi) > 0.3, reinit(self.crossings, self.crossings + 1))


class OneCrank(Model):
    """A four-bar in a plane across a skewed axis, with the mass of a second crank on the first."""

    axis = tuple(ASKEW @ [0, 0, 1])
    world = World(g=GRAVITY, n=tuple(ASKEW @ [0, -1, 0]))
    bearing = Revolute(n=axis, phi=fixed(0.9), w=fixed(1.0))
    pin, knee = Revolute(n=axis, phi=guess(-0.9)), Revolute(n=axis, phi=guess(-0.9))
    pivot = Revolute(n=axis, phi=guess(0.9))
    crank = BodyShape(r=tuple(ASKEW @ [0.4, 0, 0]), r_CM=tuple(ASKEW @ [0.2, 0, 0]), m=1, I=0.01 * np.eye(3))
    coupler = BodyShape(r=tuple(ASKEW @ [0.1, 1.1, 0]), r_CM=tuple(ASKEW @ [0.05, 0.5, 0]), m=1, I=0.02 * np.eye(3))
    rocker = BodyShape(r=tuple(ASKEW @ [0.65, 0.1, 0]), r_CM=tuple(ASKEW @ [0.3, 0, 0]), m=1, I=0.03 * np.eye(3))
    ground = FixedTranslation(r=tuple(ASKEW @ [-0.15, 1, 0]))
    second = BodyShape(r=tuple(ASKEW @ [0.4, 0, 0]), r_CM=tuple(ASKEW @ [0.2, 0, 0]), m=1, I=0.01 * np.eye(3))

    def connections(self):
        yield chain(self.world, self.bearing, self.crank, self.pin, self.coupler, self.knee, self.rocker.frame_b)
        yield chain(self.world, self.ground, self.pivot, self.rocker)
        yield from self.carried()

    def carried(self):
        """How the second crank moves."""
        yield chain(self.bearing.frame_b, self.second)


class TwoCranks(OneCrank):
    """The second crank has joints of its own, on the axes of the first: it holds what the first one holds."""

    out, back = FixedTranslation(r=tuple(ASKEW @ [0, 0, 0.5])), FixedTranslation(r=tuple(ASKEW @ [0, 0, 0.5]))
    foot, head = Revolute(n=OneCrank.axis, phi=guess(0.9)), Revolute(n=OneCrank.axis, phi=guess(-0.9))

    def carried(self):
        yield chain(self.world, self.out, self.foot, self.second, self.head, self.back.frame_b)
        yield connect(self.back.frame_a, self.coupler.frame_a)


def askew(*way: float) -> tuple[float, ...]:
    """Turn a direction out of all planes."""
    return tuple(ASKEW @ way)


class Row(Model):
    """N four-bars in a row, coupled, in a plane across a skewed axis: three constraints of each are redundant."""

    N: int = structural("number of couplers", default=34)
    world = World(g=GRAVITY, n=askew(0, -1, 0))

    @parts
    def ground(self):
        """Where uprights stand, 1 m apart."""
        return [FixedTranslation(r=askew(i, 0, 0)) for i in range(self.N + 1)]

    @parts
    def foot(self):
        """Joints of the uprights; the first one holds the start."""
        hinge = Revolute(n=askew(0, 0, 1), phi=fixed(0.3), w=fixed(-1))
        return [hinge, *(Revolute(n=askew(0, 0, 1), phi=guess(0.3)) for _ in range(self.N))]

    @parts
    def upright(self):
        """Uprights, each longer than the one before, so that none lies flat with the next."""
        ends = [askew(0, 1 + 0.02 * i, 0) for i in range(self.N + 1)]
        return [BodyShape(r=end, r_CM=askew(0, 0.5, 0), m=1, I=0.1 * np.eye(3)) for end in ends]

    @parts
    def pin(self):
        """Joints of the couplers."""
        return [Revolute(n=askew(0, 0, 1), phi=guess(-0.3 if i % 2 == 0 else 0.3)) for i in range(2 * self.N)]

    @parts
    def coupler(self):
        """Couplers."""
        way, centre = askew(1, 0.02, 0), askew(0.5, 0, 0)
        return [BodyShape(r=way, r_CM=centre, m=1, I=0.1 * np.eye(3)) for _ in range(self.N)]

    def connections(self):
        for one in zip(self.ground, self.foot, self.upright, strict=True):
            yield chain(self.world, *one)
        for i, coupler in enumerate(self.coupler):
            left, right = self.pin[2 * i : 2 * i + 2]
            yield chain(self.upright[i], left, coupler, right, self.upright[i + 1].frame_b)
