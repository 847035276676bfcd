"""Studies of accuracy against time: run a model in many ways and compare with a reference.

`measuring` runs cases; `studies` varies formulations and tolerances; `effects` varies effects. The last two are independent.
"""

from acausal.study.effects.effects import effects
from acausal.study.effects.effects_result import Effects
from acausal.study.measuring.case import Case, Job, Measurement
from acausal.study.measuring.deviation import deviations
from acausal.study.measuring.measure import measure
from acausal.study.measuring.model_pickling import pack
from acausal.study.measuring.pool import cluster, processes, run
from acausal.study.studies.formulation import Formulation, formulations_of, with_and_without
from acausal.study.studies.reference import Reference
from acausal.study.studies.study import Study, study
from acausal.study.studies.study_rows import StudyRow

__all__ = [
    "Case",
    "Effects",
    "Formulation",
    "Job",
    "Measurement",
    "Reference",
    "Study",
    "StudyRow",
    "cluster",
    "deviations",
    "effects",
    "formulations_of",
    "measure",
    "pack",
    "processes",
    "run",
    "study",
    "with_and_without",
]
