"""The descriptions that are written, read again without the code that wrote them."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from xml.etree.ElementTree import Element, fromstring

import casadi as ca
import pytest
from hypothesis import given

from acausal.errors import ExportError
from acausal.export import Description, Variable, fmi2, fmi3
from tests.acausal.export.made import ALIASED, EMPTY, SPRING, TIME, altered, descriptions
from tests.fuzz.settings import effort

DESCRIBE = {2: fmi2.describe, 3: fmi3.describe}
MADE = [EMPTY, SPRING, ALIASED]
Unknowns = list[tuple[int, set[int] | None]]


@dataclass
class Read:
    """What a description says, by references."""

    names: dict[str, int]
    starts: dict[int, float]
    derivatives: dict[int, int]
    outputs: Unknowns
    rates: Unknowns
    initial: Unknowns


def knowns(unknown: Element, reference: Callable[[str], int]) -> set[int] | None:
    given = unknown.get("dependencies")
    return None if given is None else set(map(reference, given.split()))


def read2(text: bytes) -> Read:
    root = fromstring(text)
    variables = root.findall("ModelVariables/ScalarVariable")
    references = [int(v.get("valueReference", "")) for v in variables]
    values = [v[0] for v in variables]

    def reference(index: str) -> int:
        return references[int(index) - 1]

    def listed(tag: str) -> Unknowns:
        found = root.findall(f"ModelStructure/{tag}/Unknown")
        return [(reference(u.get("index", "")), knowns(u, reference)) for u in found]

    solved = root.findall("ModelStructure/InitialUnknowns/Unknown")
    order = [int(u.get("index", "")) for u in solved]
    rates = [int(u.get("index", "")) for u in root.findall("ModelStructure/Derivatives/Unknown")]
    states = [int(values[rate - 1].get("derivative", "")) for rate in rates]
    outputs = [k for k, v in enumerate(variables, 1) if v.get("causality") == "output"]
    assert order == sorted(
        k for k in {*outputs, *rates, *states} if variables[k - 1].get("initial") in ("approx", "calculated")
    )
    assert sorted(outputs) == sorted(int(u.get("index", "")) for u in root.findall("ModelStructure/Outputs/Unknown"))
    return Read(
        {v.get("name", ""): r for v, r in zip(variables, references, strict=True)},
        {r: float(start) for v, r in zip(values, references, strict=True) if (start := v.get("start"))},
        {r: reference(of) for v, r in zip(values, references, strict=True) if (of := v.get("derivative"))},
        listed("Outputs"),
        listed("Derivatives"),
        listed("InitialUnknowns"),
    )


def read3(text: bytes) -> Read:
    root = fromstring(text)
    variables = root.findall("ModelVariables/Float64")
    references = {v.get("name", ""): int(v.get("valueReference", "")) for v in variables}
    assert len(set(references.values())) == len(variables)

    def listed(tag: str) -> Unknowns:
        return [(int(u.get("valueReference", "")), knowns(u, int)) for u in root.findall(f"ModelStructure/{tag}")]

    aliases = {a.get("name", ""): references[v.get("name", "")] for v in variables for a in v.findall("Alias")}
    assert not aliases.keys() & references.keys()
    return Read(
        references | aliases,
        {references[v.get("name", "")]: float(start) for v in variables if (start := v.get("start"))},
        {references[v.get("name", "")]: int(of) for v in variables if (of := v.get("derivative"))},
        listed("Output"),
        listed("ContinuousStateDerivative"),
        listed("InitialUnknown"),
    )


def says(read: Read, made: Description) -> None:
    """Compare what was read with what was meant; an output of FMI 2 may stand there under several names."""

    def given(references: tuple[int, ...]) -> Unknowns:
        found = [(r, made.dependencies.get(r)) for r in references]
        return [(r, None if d is None else set(d)) for r, d in found]

    assert read.names == {v.name: v.reference for v in made.variables}
    assert read.starts == {v.reference: v.start for v in made.variables if v.start is not None}
    assert read.derivatives == {v.reference: v.derivative_of for v in made.variables if v.derivative_of is not None}
    assert [row for k, row in enumerate(read.outputs) if row not in read.outputs[:k]] == given(made.outputs)
    assert read.rates == given(made.rates)
    solved = {unknown: set(on) for unknown, on in made.initial_unknowns.items()}
    # An alias of an exact start is an initial unknown of FMI 2, and depends on that start.
    assert all(on == solved.get(unknown, {unknown}) for unknown, on in read.initial)
    assert solved.keys() <= {unknown for unknown, _ in read.initial}


@effort(100)
@given(descriptions())
def test_any_description_says_what_is_meant(made):
    says(read2(fmi2.describe(made)), made)
    read = read3(fmi3.describe(made))
    says(read, made)
    assert {unknown for unknown, _ in read.initial} == made.initial_unknowns.keys()


@effort(100)
@given(descriptions())
def test_any_description_keeps_to_the_schema(made):
    etree = pytest.importorskip("lxml.etree")
    for version, schema in schemas(etree).items():
        assert schema.validate(etree.fromstring(DESCRIBE[version](made))), schema.error_log


def schemas(etree):
    fmpy = pytest.importorskip("fmpy")
    folder = f"{fmpy.__path__[0]}/schema"
    return {n: etree.XMLSchema(file=f"{folder}/fmi{n}/fmi{n}ModelDescription.xsd") for n in DESCRIBE}


@pytest.mark.parametrize("made", MADE, ids=["empty", "spring", "aliased"])
@pytest.mark.parametrize("version", DESCRIBE)
def test_fmpy_finds_no_fault(made, version):
    validation = pytest.importorskip("fmpy.validation")
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("modelDescription.xml", DESCRIBE[version](made))
    problems = validation.validate_fmu(file)
    if (made, version) == (ALIASED, 3):
        # It wants aliases of outputs listed again as initial unknowns, where they have no reference of their own.
        assert len(problems) == 1
        assert "Expected {acceleration, der(phase), der(spring.s), der(spring.v)," in problems[0]
    else:
        assert problems == []


@pytest.mark.parametrize("version", DESCRIBE)
def test_casadi_reads_it(version, tmp_path):
    (tmp_path / "modelDescription.xml").write_bytes(DESCRIBE[version](SPRING))
    read = ca.DaeBuilder("spring", str(tmp_path))
    # A state that is an output has the output's name in FMI 3.
    assert read.x() == ["position" if version == 3 else "spring.s", "spring.v", "phase"]
    assert read.u() == ["force"]
    assert read.p() == ["mass.m"]
    assert read.y() == ["phase", "position", "level", "half"]


@pytest.mark.parametrize("version", DESCRIBE)
def test_the_same_description_gives_the_same_bytes(version):
    assert DESCRIBE[version](SPRING) == DESCRIBE[version](replace(SPRING))


def test_an_output_gives_the_name_and_what_is_exact_the_start():
    state = fromstring(fmi3.describe(SPRING)).find("ModelVariables/Float64[@valueReference='1']")
    assert state is not None
    assert (state.get("name"), state.get("causality"), state.get("initial")) == ("position", "output", "exact")
    assert (state.get("start"), state.get("nominal"), state.get("min")) == ("0.1", "0.05", "-2.0")
    assert [alias.get("name") for alias in state] == ["spring.s"]


def test_what_both_kinds_can():
    for version, describe in DESCRIBE.items():
        root = fromstring(describe(SPRING))
        exchange, simulation = root.find("ModelExchange"), root.find("CoSimulation")
        assert exchange is not None
        assert simulation is not None
        state, many = ("FMUstate", "") if version == 2 else ("FMUState", "s")
        for interface in (exchange, simulation):
            assert interface.get("modelIdentifier") == "Spring_mass"
            for flag in (f"canGetAndSet{state}", f"canSerialize{state}", f"providesDirectionalDerivative{many}"):
                assert interface.get(flag) == "true", flag
            assert [f.get("name") for f in interface.findall("SourceFiles/File")] == (
                ["lu.c", "tape.c"] if version == 2 else []
            )
        assert simulation.get("canHandleVariableCommunicationStepSize") == "true"
        assert exchange.get("completedIntegratorStepNotNeeded") == ("true" if version == 2 else None)
        assert root.get("numberOfEventIndicators") == ("2" if version == 2 else None)
        assert [c.get("name") for c in root.findall("LogCategories/Category")] == ["logEvents", "logStatusError"]


def test_texts_survive():
    made = replace(SPRING, name="<a> & 'b'", description='"x" < 1,\n\tα\x00\ud800')
    for describe in DESCRIBE.values():
        root = fromstring(describe(made))
        assert root.get("modelName") == "<a> & 'b'"
        assert root.get("description") == '"x" < 1,\n\tα\ufffd\ufffd'


@pytest.mark.parametrize(
    ("name", "convention"),
    [
        ("beam.node_r_0[1,2]", "structured"),
        ("der(crank.phi)", "structured"),
        ("der(x[3].y,2)", "structured"),
        ("_a1[10].b", "structured"),
        ("crank.φ", "flat"),
        ("a b", "flat"),
        ("der(der(x))", "flat"),
        ("x[1, 2]", "flat"),
        ("1x", "flat"),
    ],
)
def test_names_decide_on_their_convention(name, convention):
    made = replace(EMPTY, variables=(TIME, Variable(name, 1, "local", "continuous", None, "", None)))
    for describe in DESCRIBE.values():
        assert fromstring(describe(made)).get("variableNamingConvention") == convention


def added(variable):
    return replace(SPRING, variables=(*SPRING.variables, variable))


@pytest.mark.parametrize(
    ("made", "why"),
    [
        (altered("mass.m", start=float("nan")), "`mass.m` starts at nan; give it a finite value"),
        (altered("force", start=float("-inf")), "`force` starts at -inf"),
        (altered("spring.s", nominal=0.0), "the nominal value of `spring.s` is 0.0"),
        (altered("spring.s", minimum=float("-inf")), "the minimum of `spring.s` is -inf"),
        (altered("mass.m", reference=-1), "`mass.m` has the reference -1"),
        (altered("mass.m", start=None), "`mass.m` needs a start value"),
        (altered("phase", start=0.0), "`phase` cannot have a start value"),
        (altered("force", start=None), "`force` needs a start value"),
        (altered("time", start=0.0), "`time` cannot have a start value"),
        (altered("mass.m", variability="continuous"), "`mass.m` cannot be parameter and continuous"),
        (altered("mass.m", initial="approx"), r"`mass.m` \(parameter, tunable\) cannot be approx"),
        (altered("load.m", name="mass.m"), "two variables are named `mass.m`"),
        (altered("time", name="t", causality="local"), "exactly one variable must be the independent one"),
        (altered("drive.f", causality="output"), r"`force` \(input, continuous\) and `drive.f` \(output"),
        (altered("drive.f", reference=0), r"`time` \(independent, continuous\) and `drive.f` \(local"),
        (altered("drive.f", causality="input", initial=None, start=0.0), "cannot be one value"),
        (
            added(Variable("w", 14, "output", "discrete", None, "", None)),
            r"`weight` \(local, tunable\) and `w` \(output",
        ),
        (added(Variable("c", 14, "local", "constant", None, "", 1.0)), "cannot be one value"),
        (altered("half_again", start=0.6), "one value with two starts, 0.5 and 0.6"),
        (altered("weight", reinit=True), "`weight` is not a state, but events change it"),
        (altered("der(phase)", derivative_of=2), "states and derivatives are not in pairs"),
        (altered("spring.v", variability="discrete"), "`spring.v` is a state, a derivative or an indicator"),
        (altered("indicator[1]", reference=99), "no variable has the reference 15"),
        (replace(SPRING, identifier="a-b"), "`a-b` is not an identifier in C"),
        (replace(SPRING, stop_time=float("inf")), "stop_time is inf"),
        (replace(SPRING, rates=(4, 5)), "not in pairs"),
        (replace(SPRING, outputs=(3, 1, 12)), "the outputs differ from the listed ones"),
        (replace(SPRING, outputs=(3, 3, 1, 12, 13)), "the outputs differ from the listed ones"),
        (replace(SPRING, dependencies={1: (77,)}), "no variable has the reference 77"),
        (replace(SPRING, initial_unknowns={}), "`spring.v` is an unlisted initial unknown"),
        (replace(SPRING, initial_unknowns={**SPRING.initial_unknowns, 1: ()}), "`spring.s` is not an initial unknown"),
    ],
)
def test_what_fmi_does_not_allow_is_refused(made, why):
    for describe in DESCRIBE.values():
        with pytest.raises(ExportError, match=f"^cannot export Spring & <mass>: .*{why}"):
            describe(made)
