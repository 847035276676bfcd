"""Bodies from mass and stiffness matrices of any finite-element program."""

from typing import TYPE_CHECKING, Any

from components.fe.body.fe_body import FEBody
from components.fe.elements import assemble, box
from components.fe.formats import read_npz
from components.fe.nodes import Nodes, rows_of
from components.fe.reduction.interface import Interface
from components.fe.reduction.nodal_field import NodalField
from components.fe.reduction.reduce import reduce_body
from components.fe.reduction.reduced_body import ReducedBody
from components.fe.reduction.spiders import average, frame_at, rigid

__all__ = [
    "FEBody",
    "FrameLoad",
    "FrameMotion",
    "Interface",
    "NodalField",
    "NodalResult",
    "Nodes",
    "Readings",
    "ReducedBody",
    "as_result",
    "assemble",
    "average",
    "box",
    "by_steps",
    "frame_at",
    "read_abaqus",
    "read_ansys",
    "read_calculix",
    "read_matrix_market",
    "read_mesh",
    "read_nastran",
    "read_npz",
    "read_sid",
    "reduce_body",
    "rigid",
    "rows_of",
    "run_reconfigured",
    "simulate_reconfigured",
    "write_sid",
]

if TYPE_CHECKING:
    from components.fe.body.recovery import NodalResult
    from components.fe.formats.abaqus import read_abaqus
    from components.fe.formats.ansys import read_ansys
    from components.fe.formats.calculix import read_calculix
    from components.fe.formats.matrix_market import read_matrix_market
    from components.fe.formats.mesh import read_mesh
    from components.fe.formats.nastran import read_nastran
    from components.fe.formats.sid import read_sid, write_sid
    from components.fe.reconfigured.load import FrameLoad
    from components.fe.reconfigured.motion import FrameMotion
    from components.fe.reconfigured.result import as_result
    from components.fe.reconfigured.scene_run import by_steps, run_reconfigured
    from components.fe.reconfigured.simulate import simulate_reconfigured
    from components.fe.reconfigured.steps import Readings

# Names that models rarely use, imported on first access: some of their modules load scipy.sparse.
_LATER = {
    "FrameLoad": "reconfigured.load",
    "FrameMotion": "reconfigured.motion",
    "NodalResult": "body.recovery",
    "Readings": "reconfigured.steps",
    "as_result": "reconfigured.result",
    "by_steps": "reconfigured.scene_run",
    "read_abaqus": "formats.abaqus",
    "read_ansys": "formats.ansys",
    "read_calculix": "formats.calculix",
    "read_matrix_market": "formats.matrix_market",
    "read_mesh": "formats.mesh",
    "read_nastran": "formats.nastran",
    "read_sid": "formats.sid",
    "run_reconfigured": "reconfigured.scene_run",
    "simulate_reconfigured": "reconfigured.simulate",
    "write_sid": "formats.sid",
}


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_LATER[name]}"), name)
