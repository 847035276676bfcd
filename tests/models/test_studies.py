"""Studies of the scenes reach what other programs found."""

import pytest

import acausal as ac
from acausal.study import formulations_of
from models import SpinUp

# Geometrically exact, from an independent program: smallest tip deflection at omega 4, at 6.75 s.
EXACT, AT = -0.534167, 6.75


def check(study: ac.Study) -> None:
    tip = study.reference.values["tip_deflection"]
    assert tip.min() == pytest.approx(EXACT, rel=1e-4)
    assert study.reference.times[tip.argmin()] == pytest.approx(AT)
    best = study.best[-1].measurement.values["tip_deflection"]
    assert best.min() == pytest.approx(EXACT, rel=1e-3)


@pytest.mark.slow
def test_spin_up_with_few_points() -> None:
    names = ("one frame, stiffened", "volumes, stiffened", "volumes of 2, stiffened")
    known = {form.name: form for form in formulations_of(SpinUp(), {})}
    few = [ac.Formulation(n, known[n].settings, {"volumes": (3, 5)}, known[n].exact) for n in names]
    check(ac.study(SpinUp(omega=4), formulations=few, tolerances=(1e-6, 1e-7), accuracy=5e-4, repeats=1))


@pytest.mark.slow
def test_spin_up_by_default() -> None:
    study = ac.study(SpinUp(omega=4))
    check(study)
    assert study.reference.floor < 1e-4
    assert {row.case.formulation for row in study.rows if row.remark} == {"one frame"}
