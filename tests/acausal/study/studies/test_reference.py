"""The reference: refined until it is known well enough, by formulas in place of runs."""

import numpy as np
import pytest

from acausal.errors import DeclarationError, SimulationError
from acausal.study import Case, Formulation, Measurement
from acausal.study.studies.reference import make, read

T = np.linspace(0, 1, 11)


def form(name, power, limit=0.0):
    return Formulation(name, {"power": power, "limit": limit}, {"n": (4, 8)}, exact=True)


class Lab:
    """Measures 1 + t times errors of elements and tolerance; what is too fine fails."""

    def __init__(self, most=10_000):
        self.most, self.cases = most, []

    def __call__(self, cases):
        return [self.one(case) for case in cases]

    def one(self, case):
        self.cases.append(case)
        s = case.settings
        if s.get("n", 1) > self.most:
            return Measurement(case, error="it was stopped after 60 s")
        error = s.get("n", 1e9) ** -s.get("power", 2) + s.get("limit", 0.0) + 10 * case.tolerance
        return Measurement(case, T, {"x": T * (1 + error)}, method="idas", constraints="none")


def test_refined_until_known():
    lab = Lab()
    found = make(lab, [form("square", 2), form("fourth", 4)], Case(), 1e-6, 3e-5)
    assert found.floor <= 3e-5
    assert found.case is not None
    assert found.case.formulation == "fourth"
    assert found.values["x"][-1] == pytest.approx(1, abs=3e-5)
    assert set(found.agreement) == {"coarser elements", "square", "looser tolerance"}
    assert found.agreement["square"]["x"] == pytest.approx(max(p.settings["n"] for p in lab.cases) ** -2.0, rel=0.1)


def test_the_two_that_converge_fastest_go_on():
    lab = Lab()
    make(lab, [form("square", 2), form("fourth", 4), form("sixth", 6)], Case(), 1e-7, 1e-6)
    most = {name: max(p.settings["n"] for p in lab.cases if p.formulation == name) for name in ("square", "sixth")}
    assert most["square"] == 8 < most["sixth"]


def test_a_tolerance_too_loose_is_tightened():
    lab = Lab()
    found = make(lab, [form("fourth", 4), form("sixth", 6)], Case(), 1e-3, 3e-5)
    assert found.floor <= 3e-5
    assert min(p.tolerance for p in lab.cases) < 1e-5


def test_formulations_of_different_limits_are_told():
    found = make(Lab(), [form("a", 6), form("b", 6, limit=0.02)], Case(), 1e-6, 1e-4)
    assert found.floor == pytest.approx(0.02, rel=0.05)
    assert "1e-04 was requested but not reached" in str(found)


def test_what_cannot_be_refined_is_told():
    found = make(Lab(most=16), [form("square", 2), form("other", 2)], Case(), 1e-6, 1e-6)
    assert found.floor == pytest.approx(8**-2 - 16**-2, rel=0.1)
    assert "32, tolerance 1e-07: it was stopped after 60 s" in str(found)


def test_nothing_to_compare_with():
    with pytest.raises(SimulationError, match=r"there is no reference: a, 4, .* stopped after 60 s"):
        make(Lab(most=1), [form("a", 2)], Case(), 1e-6, 1e-4)


def test_without_elements_the_tolerance_is_refined_and_another_integrator_checks():
    found = make(Lab(), [Formulation("as given")], Case(), 1e-3, 1e-5)
    assert set(found.agreement) == {"looser tolerance", "rosenbrock"}
    assert found.floor <= 1e-5


def table(tmp_path, text):
    (tmp_path / "r.csv").write_text(text)
    return tmp_path / "r.csv"


def test_read(tmp_path):
    found = read(table(tmp_path, "time,y,x\n0,1,2\n1,3,4\n"), ("x",), np.array([0.0, 1.0]))
    assert found.values["x"].tolist() == [2.0, 4.0]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time,y\n0,1\n1,3\n", "has no column `x`; its columns: time, y"),
        ("time,x\n0,1\n0.5,2\n1,3\n", "has 3 times up to 1 s, the study 2 up to 1 s"),
        ("time,x\n0,1\n0.9,2\n", "has 2 times up to 0.9 s, the study 2 up to 1 s"),
        ("time,x\n0,1\n1,\n", "has entries that are not finite numbers"),
        ("", "cannot read the reference"),
    ],
)
def test_wrong_tables(tmp_path, text, message):
    with pytest.raises(DeclarationError, match=message):
        read(table(tmp_path, text), ("x",), np.array([0.0, 1.0]))


def test_no_table(tmp_path):
    with pytest.raises(DeclarationError, match=r"no\.csv: No such file or directory"):
        read(tmp_path / "no.csv", ("x",), np.array([0.0, 1.0]))
