"""Arguments of components whose declarations do not suggest any, for their examples and equations."""

from __future__ import annotations

# By the name in `components`, as source text. Other components take the values of ORDINARY for what they require.
ARGUMENTS = {
    "SphericalSpherical": "rod_length=1",
    "GearConstraint": "ratio=2, n_a=(1, 0, 0), n_b=(1, 0, 0)",
    "LineForceLaw": "force=lambda s, v: 100 * (s - 0.5) + 2 * v",
    "PointOnCurve": "curve=lambda u: (u, u**2, 0)",
    "FlexibleBeam": "length=1, E=2.1e11, rho=7850, A=1e-4, J=8e-10, elements=2",
    "SubstructuredBeam": "length=1, E=2.1e11, rho=7850, A=1e-4, J=8e-10, volumes=2",
    "contact.PointOnProfile": "height=lambda r: 0.1 * ac.sin(r[0]), k=1e5",
    "contact.SphereOnProfile": "height=lambda r: 0.1 * ac.sin(r[0]), radius=0.1, k=1e5",
    "Body": "m=1, r_CM=(0.1, 0, 0), I=((1, 0, 0), (0, 2, 0), (0, 0, 3))",
    "rotational.ElastoBacklash": "c=1, b=0.1",
    "rotational.ElastoBacklash2": "c=1, b=0.1",
    "rotational.BearingFriction": "tau_sliding=0.5",
    "rotational.Friction": "tau_sliding=0.5",
    "rotational.Brake": "tau_max=10",
    "rotational.Clutch": "tau_max=10",
    "rotational.OneWayClutch": "tau_max=10",
    "blocks.CasadiFunction": 'f=ca.Function("f", [u := ca.SX.sym("u")], [u**2])',
    "blocks.CombiTable1D": "data=ac.Table([0, 1, 2], [0, 1, 4])",
    "blocks.CombiTable2D": "data=ac.Table(([0, 1], [0, 1, 2]), [[0, 1, 4], [1, 2, 5]])",
    "blocks.CombiTimeTable": "data=ac.Table([0, 1, 2], [0, 1, 4])",
    "electrical.TableCurrent": "data=ac.Table([0, 1, 2], [0, 1, 0])",
    "electrical.TableVoltage": "data=ac.Table([0, 1, 2], [0, 1, 0])",
    "blocks.DiscreteStateSpace": "A=[[0.9]], B=[[0.1]], C=[[1]], D=[[0]]",
    "fe.FEBody": "reduced=body",
    "blocks.Sampled": "f=lambda time, u: 2 * u, period=0.01",
}
ORDINARY = {(): "1", (3,): "(1, 0, 0)"}
