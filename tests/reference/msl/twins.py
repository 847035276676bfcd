"""`python -m tests.reference.msl.twins`: print the twins of the classes of Modelica's mechanics and write docs/from/twins.md.

The twin of a class has its name, in the package that PLACES tells. NAMES lists twins of other names; REASONS says why there is
none, for a class or a package. A line with TO_COME is ignored as soon as the twin exists.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from pkgutil import resolve_name

from tests.reference.msl.classes import NAMES as CLASSES
from tests.reference.msl.classes import TAG

PAGE = Path(__file__).parents[3] / "docs/from/twins.md"
TO_COME = "to come"
GRAPHICS = "graphics only: components draw themselves in `shapes()`"
MATRICES = "matrices are arrays: write the operation"
QUATERNIONS = "quaternions are states of frames that move freely; equations are written with matrices"
BASE = "interface base class"

PLACES: dict[str, tuple[str, ...]] = {
    "MultiBody.Frames": ("", "orientation"),
    "MultiBody.Interfaces": ("",),
    "MultiBody.Joints.Assemblies": ("assemblies",),
    "MultiBody.Joints.Constraints": ("constraints",),
    "MultiBody.Sensors": ("sensors",),
    **dict.fromkeys(("MultiBody", "MultiBody.Forces", "MultiBody.Joints", "MultiBody.Parts"), ("",)),
    **{f"Rotational.{name}": ("rotational",) for name in ("Components", "Interfaces", "Sensors", "Sources")},
    **{f"Translational.{name}": ("translational",) for name in ("Components", "Interfaces", "Sensors", "Sources")},
}

NAMES = {
    "MultiBody.Frames.Quaternions.from_T": "orientation.quaternion_of",
    "MultiBody.Frames.Quaternions.to_T": "from_quaternion",
    "MultiBody.Frames.TransformationMatrices.to_Q": "orientation.quaternion_of",
    "MultiBody.Frames.axesRotationsAngles": "sensors.axes_angles",
    "MultiBody.Frames.from_Q": "from_quaternion",
    "MultiBody.Frames.from_T": "RelativeOrientation",
    "MultiBody.Frames.from_nxy": "orientation.two_axes_rotation",
    "MultiBody.Frames.smallRotation": "orientation.rodrigues_rotation",
    "MultiBody.Frames.to_Q": "orientation.quaternion_of",
    "MultiBody.Interfaces.Frame_a": "Frame",
    "MultiBody.Interfaces.Frame_b": "Frame",
    "MultiBody.Interfaces.Frame_resolve": "Frame",
    "MultiBody.Interfaces.LineForceBase": "LineForce",
    "MultiBody.Interfaces.PartialAbsoluteSensor": "sensors.OneFrameSensor",
    "MultiBody.Interfaces.PartialElementaryJoint": "TwoFrames",
    "MultiBody.Interfaces.PartialForce": "FrameLoad",
    "MultiBody.Interfaces.PartialLineForce": "LineForce",
    "MultiBody.Interfaces.PartialRelativeSensor": "sensors.TwoFrameSensor",
    "MultiBody.Interfaces.PartialTwoFrames": "TwoFrames",
    "MultiBody.Interfaces.PartialTwoFramesDoubleSize": "TwoFrames",
    "Rotational.Interfaces.Flange_a": "rotational.Flange",
    "Rotational.Interfaces.Flange_b": "rotational.Flange",
    "Rotational.Interfaces.PartialAbsoluteSensor": "rotational.AbsoluteSensor",
    "Rotational.Interfaces.PartialCompliant": "rotational.Compliant",
    "Rotational.Interfaces.PartialCompliantWithRelativeStates": "rotational.Compliant",
    "Rotational.Interfaces.PartialElementaryOneFlangeAndSupport2": "rotational.OneFlange",
    "Rotational.Interfaces.PartialElementaryRotationalToTranslational": "translational.RotationalToTranslational",
    "Rotational.Interfaces.PartialElementaryTwoFlangesAndSupport2": "rotational.TwoFlangesAndSupport",
    "Rotational.Interfaces.PartialFriction": "rotational.Slipping",
    "Translational.Interfaces.PartialFriction": "translational.RodFriction",
    "MultiBody.Joints.RollingWheel": "RollingWheelJoint",
    "MultiBody.Joints.RollingWheelSet": "RollingWheelSetJoint",
    "Rotational.Interfaces.PartialOneFlangeAndSupport": "rotational.OneFlange",
    "Rotational.Interfaces.PartialRelativeSensor": "rotational.RelativeSensor",
    "Rotational.Interfaces.PartialTorque": "rotational.LoadingTorque",
    "Rotational.Interfaces.PartialTwoFlanges": "rotational.TwoFlanges",
    "Rotational.Interfaces.PartialTwoFlangesAndSupport": "rotational.TwoFlangesAndSupport",
    "Rotational.Interfaces.Support": "rotational.Flange",
    "Translational.Interfaces.Flange": "translational.TranslationalFlange",
    "Translational.Interfaces.Flange_a": "translational.TranslationalFlange",
    "Translational.Interfaces.Flange_b": "translational.TranslationalFlange",
    "Translational.Interfaces.PartialAbsoluteSensor": "translational.AbsoluteSensor",
    "Translational.Interfaces.PartialCompliant": "translational.Compliant",
    "Translational.Interfaces.PartialCompliantWithRelativeStates": "translational.Compliant",
    "Translational.Interfaces.PartialElementaryOneFlangeAndSupport2": "translational.OneFlange",
    "Translational.Interfaces.PartialElementaryRotationalToTranslational": "translational.RotationalToTranslational",
    "Translational.Interfaces.PartialForce": "translational.LoadingForce",
    "Translational.Interfaces.PartialOneFlangeAndSupport": "translational.OneFlange",
    "Translational.Interfaces.PartialRelativeSensor": "translational.RelativeSensor",
    "Translational.Interfaces.PartialRigid": "translational.Rigid",
    "Translational.Interfaces.PartialTwoFlanges": "translational.TwoFlanges",
    "Translational.Interfaces.Support": "translational.TranslationalFlange",
}

REASONS = {
    "MultiBody.Frames.Quaternions": QUATERNIONS,
    "MultiBody.Frames.TransformationMatrices": MATRICES,
    "MultiBody.Frames.angularVelocity1": "`resolve1(R, R.w)`",
    "MultiBody.Frames.angularVelocity2": "`R.w`",
    "MultiBody.Frames.axis": "a row of the unit matrix",
    "MultiBody.Frames.from_T2": "`R.w` is given, not differentiated from the matrix",
    "MultiBody.Frames.from_T_inv": "`RelativeOrientation(T.T, w)`",
    "MultiBody.Frames.from_nxz": '`FixedRotation(rotation_type="two_axes")` takes the x and y axes',
    "MultiBody.Frames.orientationConstraint": "`Frame.residual` closes loops",
    "MultiBody.Frames.planarRotationAngle": "the angle of a joint is a variable",
    "MultiBody.Frames.relativeRotation": "`absolute_rotation(inverse_rotation(R1), R2)`",
    "MultiBody.Frames.resolveDyade1": "`R.T.T @ D @ R.T`",
    "MultiBody.Frames.resolveDyade2": "`R.T @ D @ R.T.T`",
    "MultiBody.Frames.resolveRelative": "`resolve2(R2, resolve1(R1, v))`",
    "MultiBody.Frames.to_T": "`R.T`",
    "MultiBody.Frames.to_T_inv": "`R.T.T`",
    "MultiBody.Frames.to_exy": "rows of `R.T`",
    "MultiBody.Frames.to_vector": "`R.T` is an array",
    "MultiBody.Interfaces.FlangeWithBearing": "flange and bearing are two ports, connected one by one",
    "MultiBody.Interfaces.FlangeWithBearingAdaptor": "flange and bearing are two ports, connected one by one",
    "MultiBody.Interfaces.PartialOneFrame_a": f"{BASE}: a field `frame_a = port(Frame)`",
    "MultiBody.Interfaces.PartialOneFrame_b": f"{BASE}: a field `frame_b = port(Frame)`",
    "MultiBody.Interfaces.PartialVisualizer": GRAPHICS,
    "MultiBody.Interfaces.ZeroPosition": "stands in for a `frame_resolve` that is not there",
    "MultiBody.Interfaces.partialColorMap": GRAPHICS,
    "MultiBody.Interfaces.partialGravityAcceleration": "`World(gravity=...)` takes any function of the position",
    "MultiBody.Interfaces.partialSurfaceCharacteristic": GRAPHICS,
    "MultiBody.Sensors.TransformAbsoluteVector": "a block: write `resolve1`, `resolve2` in an equation",
    "MultiBody.Sensors.TransformRelativeVector": "a block: write `resolve1`, `resolve2` in an equation",
    "MultiBody.Visualizers": GRAPHICS,
    "Rotational.Interfaces.InternalSupport": "`support` is a port that exists or not",
    "Translational.Interfaces.InternalSupport": "`support` is a port that exists or not",
    "Translational.Interfaces.PartialElementaryTwoFlangesAndSupport2": f"{BASE}: no part here needs it",
    "Translational.Interfaces.PartialTwoFlangesAndSupport": f"{BASE}: no part here needs it",
}


def classes() -> list[str]:
    """Return the names of the classes in Modelica.Mechanics."""
    return CLASSES.read_text().split()


def exists(path: str) -> bool:
    """True if `components` has something of this name, such as "sensors.Distance"."""
    try:
        resolve_name(f"components.{path}")
    except (AttributeError, ImportError):
        return False
    return True


def twin(name: str) -> str:
    """Return the twin of a class of Modelica by its name in `components`, "" if there is none."""
    if name in NAMES:
        return NAMES[name]
    package, _, own = name.rpartition(".")
    ours = own if own[0].isupper() else re.sub(r"(?<=[a-z])(?=[A-Z])", "_", own).lower()
    paths = [f"{place}.{ours}".lstrip(".") for place in PLACES.get(package, ())]
    return next(filter(exists, paths), "")


def reason(name: str) -> str:
    """Return why a class has no twin, as said of it or of a package that it is in."""
    parts = name.split(".")
    above = (".".join(parts[:k]) for k in range(len(parts), 0, -1))
    return next((REASONS[place] for place in above if place in REASONS), "")


def missing() -> list[str]:
    """Return the classes whose twin is to come."""
    return [name for name in classes() if not twin(name) and reason(name) == TO_COME]


def page() -> Iterator[str]:
    """Yield the lines of the page."""
    names = classes()
    twins = sum(bool(twin(name)) for name in names)
    yield "# Twins of Modelica's classes\n"
    yield "The classes of Modelica.Mechanics.MultiBody, Rotational and Translational in the Modelica Standard Library"
    yield f"({TAG}), and their counterparts in `components`, without examples, icons, guides, types and internal classes."
    yield "Written by `python -m tests.reference.msl.twins`; [From Modelica](modelica.md#what-differs)"
    yield "lists the differences.\n"
    left = len(missing())
    yield f"{len(names)} classes: {twins} have a twin, {left} are to come, {len(names) - twins - left} need none."
    for package, inside in groupby(names, key=lambda name: name.rpartition(".")[0]):
        yield f"\n## {package}\n"
        yield "| class | twin, or why there is none |\n| --- | --- |"
        for name in inside:
            yield f"| {name.rpartition('.')[2]} | {f'`{ours}`' if (ours := twin(name)) else reason(name)} |"


if __name__ == "__main__":
    text = "\n".join(page()) + "\n"
    PAGE.write_text(text)
    print(text)
    print(f"To come: {', '.join(missing()) or 'nothing'}")
