"""What accuracy costs in time: run a model in many ways, against a reference."""

from acausal.study.deviation import deviations
from acausal.study.effects import effects
from acausal.study.effects_result import Effects
from acausal.study.formulation import Formulation, formulations_of, with_and_without
from acausal.study.point import Job, Measurement, Point, measure
from acausal.study.pool import cluster, processes, run
from acausal.study.reference import Reference
from acausal.study.rows import Row
from acausal.study.shipping import pack
from acausal.study.study import Study, study

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
