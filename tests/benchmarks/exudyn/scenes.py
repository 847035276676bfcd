"""What is compared: the scenes with the settings of both programs, and how the references are made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from acausal import Result
from models import FlexiblePendulum, RightAngleFrame, SliderCrank, SpinUp
from tests.benchmarks.exudyn import pendulum, right_angle_frame, slider_crank, spin_up
from tests.benchmarks.exudyn.cable import Machine, Outputs, Setting

INTERVALS = 400
STIFFENED = {"geometric_stiffness": True}


@dataclass(frozen=True)
class Curve:
    """One of our models at several tolerances.

    Attributes
    ----------
    name : str
        For tables and picture.
    options : dict
        Structural parameters of the scene.
    parameters : dict
        Effects, by path.
    tolerances : tuple of float
        Of the runs.
    method : str
        Of `simulate`.
    """

    name: str
    options: dict[str, Any]
    tolerances: tuple[float, ...]
    parameters: dict[str, Any] = field(default_factory=dict)
    method: str = "auto"


@dataclass(frozen=True)
class Scene:
    """A scene for both programs.

    Attributes
    ----------
    name : str
        For tables, picture and file of the reference.
    model : callable
        Our scene, from structural parameters.
    outputs : tuple of str
        What is compared.
    curves : tuple of Curve
        Our settings.
    build : callable
        The system of Exudyn from a setting, with the elements that are compared.
    settings : tuple of Setting
        Of Exudyn.
    exact : (callable, Setting)
        Exudyn's reference: many elements, short steps.
    fine : Curve
        Our own reference: many volumes, the first tolerance.
    goal : float
        How many times less solve time we want at equal error.
    paths : dict of str to str
        Where our results hold outputs that have other names there.
    """

    name: str
    model: Callable[..., Any]
    outputs: tuple[str, ...]
    curves: tuple[Curve, ...]
    build: Callable[[Setting], Machine]
    settings: tuple[Setting, ...]
    exact: tuple[Callable[[Setting], Machine], Setting]
    fine: Curve
    goal: float
    paths: dict[str, str] = field(default_factory=dict)

    def of(self, result: Result) -> Outputs:
        """Outputs of one of our results."""
        return {name: result[self.paths.get(name, name)] for name in self.outputs}


def _grid(steps: tuple[float, ...], radii: tuple[float, ...], modified: bool) -> tuple[Setting, ...]:
    return tuple(Setting(step, radius, modified) for radius in radii for step in steps)


def _spin_up(omega: float, volumes: int) -> Scene:
    """Beam that turns faster and faster."""
    tolerances = (3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7, 1e-8)

    def fem(name: str, elements: int, method: str, **effects: Any) -> Curve:
        parameters = {f"beam.{key}": value for key, value in (STIFFENED | effects).items()}
        options = {"formulation": "fem", "volumes": elements, "omega": omega}
        return Curve(name, options, tolerances[:-1], parameters, method)

    def substructured(number: int, method: str, name: str = "", **effects: Any) -> Curve:
        parameters = {f"beam.{key}": value for key, value in effects.items()}
        options = {"volumes": number, "omega": omega}
        return Curve(f"{number} volumes{name}", options, tolerances, parameters, method)

    n = volumes
    return Scene(
        f"spin-up {omega:g} rad/s",
        SpinUp,
        ("tip_deflection", "tip_extension"),
        (
            substructured(n, "auto"),
            substructured(4 * n, "auto"),
            fem("one frame, stiffened", n, "auto"),
            fem("one frame, stiffened, quasi-static stretch", n, "auto", axial="quasi_static"),
            fem("one frame, stiffened, quasi-static stretch, one-step", n, "rosenbrock", axial="quasi_static"),
            substructured(n, "auto", ", stiffened", **STIFFENED),
            substructured(n, "rosenbrock", ", stiffened, one-step", **STIFFENED),
            substructured(2 * n, "rosenbrock", ", stiffened, one-step", **STIFFENED),
        ),
        partial(spin_up.build, elements=n, omega=omega),
        _grid((0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125), (0.6, 0.8), modified=False),
        (partial(spin_up.build, elements=40, omega=omega), Setting(1.25e-3, 0.9, quadrature=0)),
        Curve(
            "20 volumes, stiffened",
            {"volumes": 20, "omega": omega},
            (1e-9,),
            {"beam.geometric_stiffness": True},
            "rosenbrock",
        ),
        10.0,
    )


def _pendulum() -> Scene:
    """Beam that swings after its release."""
    tolerances = (3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7)
    stiff = {f"beam.{key}": value for key, value in STIFFENED.items()}
    frame, stretchless = {"elements": 10}, stiff | {"beam.axial": "none"}
    volumes = {"formulation": "substructured", "volumes": 5, "elements_per_volume": 2}
    # Ten elements end at 1e-3 for the middle's deflection.
    finer = {"formulation": "substructured", "volumes": 4, "elements_per_volume": 3}
    fine = {"formulation": "substructured", "volumes": 20, "elements_per_volume": 1}
    return Scene(
        "pendulum",
        FlexiblePendulum,
        ("tip_x", "mid_deflection"),
        (
            Curve("5 volumes of 2 elements", volumes, tolerances),
            Curve("5 volumes of 2 elements, one-step", volumes, tolerances, {}, "rosenbrock"),
            Curve("5 volumes of 2 elements, stiffened, one-step", volumes, tolerances, stiff, "rosenbrock"),
            Curve("4 volumes of 3 elements, stiffened, one-step", finer, (1e-5, 3e-6, 1e-6), stiff, "rosenbrock"),
            Curve("one frame", frame, tolerances),
            Curve("one frame, stiffened", frame, tolerances, stiff),
            Curve("one frame, stiffened, no stretch", frame, tolerances, stretchless),
            Curve("one frame, stiffened, no stretch, one-step", frame, tolerances, stretchless, "rosenbrock"),
        ),
        partial(pendulum.build, elements=10),
        _grid((5e-3, 2.5e-3, 1.25e-3, 6.25e-4, 2.5e-4, 1.25e-4, 5e-5), (0.6, 0.9), modified=True),
        (partial(pendulum.build, elements=20), Setting(1e-5, 0.95, modified=True, quadrature=0)),
        Curve("20 volumes, stiffened", fine, (1e-8,), stiff, "rosenbrock"),
        5.0,
    )


def _slider_crank() -> Scene:
    """Closed loop that rings when the torque stops."""
    tolerances = (3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6)
    stiff = {f"rod_bar.{key}": value for key, value in STIFFENED.items()}
    quick = stiff | {"rod_bar.axial": "quasi_static"}
    rigid = {"crank": "rigid"}
    fine = {"crank_elements": 6, "rod_elements": 16, "rod_volumes": 4}
    return Scene(
        "slider-crank",
        SliderCrank,
        ("slider_position", "rod_mid_deflection"),
        (
            Curve("one frame", {}, tolerances),
            Curve("rod of 4 volumes of 2 elements", {"rod_volumes": 4}, tolerances),
            Curve("one frame, stiffened", {}, tolerances, stiff),
            Curve("one frame, stiffened, one-step", {}, tolerances, stiff, "rosenbrock"),
            Curve("rigid crank, stiffened", rigid, tolerances, stiff),
            Curve("rigid crank, stiffened, one-step", rigid, tolerances, stiff, "rosenbrock"),
            Curve("rigid crank, stiffened, quasi-static stretch, one-step", rigid, tolerances, quick, "rosenbrock"),
        ),
        partial(slider_crank.build, crank_elements=3, rod_elements=8),
        _grid((4e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4), (0.6, 0.8), modified=True),
        (partial(slider_crank.build, crank_elements=12, rod_elements=32), Setting(2e-5, modified=True, quadrature=0)),
        Curve("6 elements, 4 volumes of 4, stiffened", fine, (1e-6,), stiff, "rosenbrock"),
        5.0,
    )


def _right_angle_frame() -> Scene:
    """Two legs in space; each program has as many elements as the error needs."""
    tolerances = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5)
    # Shear changes the motion of our frame by 5e-5 of the range.
    stretchless = {"first.axial": "none", "second.axial": "none"}
    grid = {0.2: (5, 6, 7, 8), 0.125: (6, 7, 8, 10), 0.1: (8, 10, 12, 16), 0.0625: (12, 16, 20, 24), 0.05: (20, 24, 32)}
    newton = {"modified": True, "each_step": True, "sparse": True, "absolute": 1e-4, "relative": 1e-4}
    fine = {"modified": True, "sparse": True, "elements": 160}
    return Scene(
        "right-angle frame",
        RightAngleFrame,
        ("elbow", "tip"),
        (
            *(Curve(f"{n} volumes a leg", {"volumes": n}, tolerances) for n in (4, 8)),
            *(
                Curve(f"{n} volumes a leg, no stretch, one-step", {"volumes": n}, tolerances, stretchless, "rosenbrock")
                for n in (3, 4, 6, 8, 12)
            ),
        ),
        right_angle_frame.build,
        tuple(Setting(step, 0.9, elements=n, **newton) for step, elements in grid.items() for n in elements),
        (right_angle_frame.build, Setting(6.25e-3, 0.95, **fine)),
        Curve("24 volumes a leg", {"volumes": 24}, (1e-6,), {}, "rosenbrock"),
        5.0,
        {"elbow": "first.frame_b.r_0", "tip": "second.frame_b.r_0"},
    )


SLIDER_CRANK = _slider_crank()
SCENES = (_spin_up(2.0, 5), _spin_up(4.0, 5), _spin_up(10.0, 10), _pendulum(), SLIDER_CRANK, _right_angle_frame())
