"""Models for other tools: files of the Functional Mock-up Interface, and open DAEs."""

from acausal.export.archive import check_fmu, source_names, write_fmu
from acausal.export.dae.export_dae import export_dae
from acausal.export.dae.load_dae import load_dae
from acausal.export.description import Description, Variable
from acausal.export.export_fmu import export_fmu

__all__ = ["Description", "Variable", "check_fmu", "export_dae", "export_fmu", "load_dae", "source_names", "write_fmu"]
