"""SubstructuredBeam: chain of flexible beams, for large deflections."""

from __future__ import annotations

from typing import Any

from acausal import as_expr, chain, connect, observed, parts, structural
from components.beams.beam import Beam
from components.beams.beam_motion import BeamMotion
from components.beams.flexible_beam import FlexibleBeam
from components.beams.load import Load
from components.rotation_vector import rotation_vector


class SubstructuredBeam(Beam):
    """Geometrically non-linear beam of several volumes, each a FlexibleBeam with its own floating frame.

    Notes
    -----
    Schiavo, Vigano, Ferretti 2006, section 3.4; the connections of the volumes are the compatibility conditions.
    """

    volumes: int = structural("number of volumes", default=5, minimum=1, refine=lambda s: s.adaptive)
    elements_per_volume: int = structural("number of finite elements of a volume", default=1, minimum=1)

    @parts
    def volume(self):
        """The volumes, from frame_a to frame_b."""
        return [
            FlexibleBeam(
                length=self.length / self._volumes,
                section=self._section_of(k),
                E=self.E,
                nu=self.nu,
                G=self.G,
                rho=self.rho,
                A=self.A,
                J=self.J,
                J_y=self.J_y,
                J_t=self.J_t,
                torsional_inertia=self.torsional_inertia / self._volumes,
                elements=self.elements_per_volume,
                reference=self.reference,
                alpha=self.alpha,
                beta=self.beta,
                initial=self.initial,
                nominal_rate=self.nominal_rate,
                axial=self.axial,
                bending=self.bending,
                torsion=self.torsion,
                shear=self.shear,
                rotary_inertia=self.rotary_inertia,
                centrifugal=self.centrifugal,
                coriolis=self.coriolis,
                geometric_stiffness=self.geometric_stiffness,
                damping=self.damping,
                weight=self.weight,
                distributed=self._loads_on(k),
                frames_at=[x for _, x in self._inner_of(k)],
                check_range=False,
            )
            for k in range(self._volumes)
        ]

    def _section_of(self, k: int) -> Any:
        """Section of volume k."""
        whole, n = self.section, self._volumes
        return (lambda s: whole((k + s) / n)) if callable(whole) else whole

    def _loads_on(self, k: int) -> tuple[Load, ...]:
        """Distributed loads on volume k."""
        found = (load.part(k, self._volumes) for load in self.loads)
        return tuple(load for load in found if load is not None)

    @property
    def _volumes(self) -> int:
        """Number of volumes, with nodes at inner frames."""
        return self._with_nodes(self.volumes, self.elements_per_volume)

    def _node_at(self, x: float) -> tuple[int, int]:
        """Return the volume with a node at x / length, and the number of the node in it."""
        return divmod(round(x * self._volumes * self.elements_per_volume), self.elements_per_volume)

    def _inner_of(self, k: int) -> list[tuple[int, float]]:
        """Numbers of the inner frames within volume k, and their places x / length in it."""
        n, found = self.elements_per_volume, []
        for number, x in enumerate(self.frames_at):
            volume, rest = self._node_at(x)
            if volume == k and rest:
                found.append((number, rest / n))
        return found

    @property
    def frames(self) -> list[Any]:
        """The volumes."""
        return self.volume

    def connections(self):
        yield connect(self.frame_a, self.volume[0].frame_a)
        if self._volumes > 1:
            yield chain(*self.volume)
        yield connect(self.volume[-1].frame_b, self.frame_b)
        for x, frame in zip(self.frames_at, self.frames_inner, strict=True):
            volume, rest = self._node_at(x)
            if not rest:
                yield connect(self.volume[volume].frame_a, frame)
        for k, volume in enumerate(self.volume):
            for (number, _), frame in zip(self._inner_of(k), volume.frames_inner, strict=True):
                yield connect(frame, self.frames_inner[number])

    @observed
    def node_r_0(self):
        """Position of every node, shape (nodes, 3), resolved in the world, in m."""
        return self._nodes("node_r_0")

    @observed
    def node_deflection(self):
        """Displacement (u, v, w) and rotation vector of every node, shape (nodes, 6), resolved in frame_a."""
        a, nodes = self.frame_a, self._nodes("node_r_0")
        n = nodes.shape[0]
        local = (nodes - as_expr([[a.r_0[i] for i in range(3)]] * n)) @ a.R.T.T
        turned = []
        for k, volume in enumerate(self.volume):
            motion, T = BeamMotion(volume), volume.ref.R.T @ a.R.T.T
            own = [motion.rotation(i).matrix() @ T for i in range(0 if k == 0 else 1, volume._elements + 1)]
            turned += [rotation_vector(R) for R in own]
        return as_expr(
            [[local[k, 0] - k * self.length / (n - 1), local[k, 1], local[k, 2], *turned[k]] for k in range(n)]
        )

    @observed
    def middle_r_0(self):
        """Position of the material midpoint, resolved in the world, in m."""
        half = self._volumes // 2
        return self.volume[half].middle_r_0 if self._volumes % 2 else self.volume[half].frame_a.r_0

    @observed
    def node_force(self):
        """Section force on the frame_a side of each node, resolved in the frame of its volume, shape (nodes, 3), in N."""
        return self._nodes("node_force")

    @observed
    def node_moment(self):
        """Section moment on the side of frame_a at every node, shape (nodes, 3), in the frame of its volume, in N.m."""
        return self._nodes("node_moment")

    def _nodes(self, name: str) -> Any:
        """Rows of all volumes; a shared node belongs to the preceding volume."""
        rows = []
        for k, volume in enumerate(self.volume):
            own = getattr(volume, name)
            rows += [[own[i, j] for j in range(3)] for i in range(0 if k == 0 else 1, own.shape[0])]
        return as_expr(rows)
