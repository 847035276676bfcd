"""Motion of a body in reconfigured inertial frames: embedded rigid motion, modal coordinates, points."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from acausal import DeclarationError, March
from components.fe.arrays import Array
from components.fe.reconfigured.free_modes import FreeModes
from components.fe.reduction.interface import Interface

RULES = ("modal", "moving")


@dataclass(frozen=True, eq=False)
class FrameMotion:
    """Result of `simulate_reconfigured`.

    Parameters
    ----------
    modes : FreeModes
        Modes and damping of the body.
    time : array, shape (times,)
        In s.
    states, outputs : array
        States and outputs of the steps.
    variant : str
        "corrected" or "paper".
    march : March
        The compiled steps with their counts and times.
    steps : int
        Number of steps from the start to the last time.
    tolerance : float
        Tolerance of the step size control, 0 for fixed steps.
    rejected : int
        Steps that were rejected, including those computed after a rejected pair in the same block.
    breaks : tuple of float
        Break times of loads in s, at which steps end.
    """

    modes: FreeModes
    time: Array
    states: Array
    outputs: Array
    variant: str
    march: March
    steps: int
    tolerance: float = 0.0
    rejected: int = 0
    breaks: tuple[float, ...] = ()

    @property
    def r_0(self) -> Array:
        """Position of the undeformed centre of mass in m, resolved in the world, shape (times, 3)."""
        return self.states[:, :3]

    @property
    def T(self) -> Array:
        """Rotation matrices from world to body components, shape (times, 3, 3)."""
        return self.states[:, 3:12].reshape(-1, 3, 3)

    @property
    def amplitudes(self) -> Array:
        """Amplitudes of all modes, the rigid ones first, shape (times, 6 + n)."""
        return self.states[:, 15 : 15 + self.modes.size]

    @property
    def q(self) -> Array:
        """Amplitudes of the flexible modes in m, shape (times, n)."""
        return self.amplitudes[:, 6:]

    @property
    def rates(self) -> Array:
        """Rates of all modes in the inertial frame, resolved in the body, shape (times, 6 + n)."""
        return self.states[:, 15 + self.modes.size :]

    @property
    def w(self) -> Array:
        """Angular velocity in rad/s, resolved in the body, shape (times, 3)."""
        return self.rates[:, 3:6]

    @property
    def al(self) -> Array:
        """Angular acceleration in rad/s2, resolved in the body, shape (times, 3); for variant "paper" that of (37)."""
        return self.outputs[:, 3:6] if self.variant == "corrected" else self.outputs[:, self.modes.size :]

    @cached_property
    def qd(self) -> Array:
        """Rates of the flexible modes relative to the moving frame in m/s, shape (times, n)."""
        return self.rates[:, 6:] - self._crossed(self.w, self.amplitudes)[:, 6:]

    @cached_property
    def qdd(self) -> Array:
        """Derivatives of `qd` in m/s2, shape (times, n)."""
        none = np.zeros((len(self.time), 6))
        v, al = self._body_rates()[:, 6:], self._body_rates()[:, 3:6]
        turned = self._crossed(al, self.amplitudes) + self._crossed(self.w, np.hstack([none, self.qd]))
        return v - turned[:, 6:]

    def place(self, frame: str) -> Array:
        """Return the position of a frame in m, resolved in the world, shape (times, 3)."""
        interface = self._interface(frame)
        local = interface.place + self._displaced(interface, self.amplitudes)
        return self.r_0 + _resolve1(self.T, local)

    def velocity(self, frame: str) -> Array:
        """Return the velocity of a frame in m/s, resolved in the world, shape (times, 3).

        Variant "corrected": the derivative of its position; variant "paper": Psi v.
        """
        interface = self._interface(frame)
        if self.variant == "paper":
            return _resolve1(self.T, self._displaced(interface, self.rates))
        local = interface.place + self.q @ interface.displacement.T
        moved = self.rates[:, :3] + np.cross(self.w, local) + self.qd @ interface.displacement.T
        return _resolve1(self.T, moved)

    def acceleration(self, frame: str, rule: str | None = None, *, embedded: bool = False) -> Array:
        """Return the acceleration of a frame in m/s2, resolved in the world, shape (times, 3).

        Parameters
        ----------
        frame : str
            Name of the frame.
        rule : str, optional
            "modal": Psi v', which lacks the terms outside the span of the modes; "moving": with w x (w x (X + u)) and 2
            w x u', the derivative of the velocity of the corrected variant. By default "moving" for the corrected
            variant and for embedded motion, else "modal" as in the paper.
        embedded : bool
            Whether to return the acceleration of the embedded rigid motion, without deformation.

        Raises
        ------
        DeclarationError
            If the frame or the rule is unknown.
        """
        interface = self._interface(frame)
        rule = rule or ("moving" if self.variant == "corrected" or embedded else "modal")
        if rule not in RULES:
            raise DeclarationError(f"rule must be one of {', '.join(map(repr, RULES))}, not {rule!r}")
        w, X = self.w, interface.place
        Phi = 0 * interface.displacement if embedded else interface.displacement
        carried = self._crossed(w, self.rates)
        inertial = self._body_rates() + carried
        if rule == "modal":
            return _resolve1(self.T, inertial[:, :3] + np.cross(inertial[:, 3:6], X) + inertial[:, 6:] @ Phi.T)
        local, al = X + self.q @ Phi.T, (inertial - carried)[:, 3:6]
        if embedded:  # Euler's equation of the rigid body
            J = self.modes.inertia
            al = inertial[:, 3:6] - np.linalg.solve(J, np.cross(w, w @ J).T).T
        relative = self.qdd @ Phi.T + 2 * np.cross(w, self.qd @ Phi.T)
        found = inertial[:, :3] + np.cross(al, local) + np.cross(w, np.cross(w, local)) + relative
        return _resolve1(self.T, found)

    @property
    def a(self) -> Array:
        """Acceleration of the origin in m/s2, resolved in the body, shape (times, 3)."""
        return self._body_rates()[:, :3] + np.cross(self.w, self.rates[:, :3])

    def _body_rates(self) -> Array:
        """Derivatives of all modal rates relative to the moving axes, shape (times, 6 + n)."""
        found = self.outputs[:, : self.modes.size]
        return found if self.variant == "corrected" else found - self._crossed(self.w, self.rates)

    def _crossed(self, w: Array, z: Array) -> Array:
        return np.einsum("tk,kab,tb->ta", w, self.modes.turning, z, optimize=True)

    def _displaced(self, interface: Interface, z: Array) -> Array:
        """Return the displacement of a frame by all modes."""
        return z[:, :3] + np.cross(z[:, 3:6], interface.place) + z[:, 6:] @ interface.displacement.T

    def _interface(self, frame: str) -> Interface:
        frames = {interface.name: interface for interface in self.modes.body.interfaces}
        if frame not in frames:
            raise DeclarationError(f"the body has no frame `{frame}`; it has {', '.join(frames) or 'none'}")
        return frames[frame]


def _resolve1(A: Array, local: Array) -> Array:
    return np.einsum("tij,ti->tj", A, local)
