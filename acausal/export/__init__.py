"""Models for other tools: files of the Functional Mock-up Interface."""

from acausal.export.archive import check_fmu, source_names, write_fmu
from acausal.export.description import Description, Variable
from acausal.export.export_fmu import export_fmu

__all__ = ["Description", "Variable", "check_fmu", "export_fmu", "source_names", "write_fmu"]
