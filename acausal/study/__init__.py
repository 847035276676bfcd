"""What accuracy costs in time: run a model in many ways, against a reference.

`measuring` runs points; `studies` varies formulations and tolerances, `switching` effects, and neither knows the other.
"""

from acausal.study.measuring.deviation import deviations
from acausal.study.measuring.measure import measure
from acausal.study.measuring.point import Job, Measurement, Point
from acausal.study.measuring.pool import cluster, processes, run
from acausal.study.measuring.shipping import pack
from acausal.study.studies.formulation import Formulation, formulations_of, with_and_without
from acausal.study.studies.reference import Reference
from acausal.study.studies.rows import Row
from acausal.study.studies.study import Study, study
from acausal.study.switching.effects import effects
from acausal.study.switching.result import Effects

__all__ = [
    "Effects",
    "Formulation",
    "Job",
    "Measurement",
    "Point",
    "Reference",
    "Row",
    "Study",
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
