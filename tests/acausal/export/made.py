"""Descriptions made by hand."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from hypothesis import strategies as st

from acausal.export import Description, Variable
from acausal.export.description import (
    GIVEN,
    INITIAL,
    Causality,
    Initial,
    Variability,
    by_reference,
    initial_of,
    initial_unknowns,
    is_solved,
)

TIME = Variable("time", 0, "independent", "continuous", None, "s", None)
EMPTY = Description(
    name="Empty",
    identifier="Empty",
    token="{00000000-0000-0000-0000-000000000001}",
    description="",
    version="1.0",
    variables=(TIME,),
    states=(),
    rates=(),
    outputs=(),
    indicators=(),
    dependencies={},
    initial_unknowns={},
)
# A mass on a spring, driven by a force, which jumps where it meets a stop.
SPRING = replace(
    EMPTY,
    name="Spring & <mass>",
    identifier="Spring_mass",
    description='Says "x < 1" & more,\nin two lines: Ω',
    variables=(
        TIME,
        Variable("spring.s", 1, "local", "continuous", "exact", "m", 0.1, "stretch", nominal=0.05, minimum=-2.0),
        Variable("spring.v", 2, "local", "continuous", "approx", "m/s", 1e-300, "speed", reinit=True),
        Variable("phase", 3, "output", "continuous", "calculated", "rad", None),
        Variable("der(spring.s)", 4, "local", "continuous", "calculated", "m/s", None, derivative_of=1),
        Variable("der(spring.v)", 5, "local", "continuous", None, "m/s2", None, derivative_of=2),
        Variable("der(phase)", 6, "local", "continuous", "calculated", "rad/s", None, derivative_of=3),
        Variable("mass.m", 7, "parameter", "tunable", "exact", "kg", 2, minimum=0.0),
        Variable("spring.c[1,2]", 8, "parameter", "fixed", None, "N/m", 1e5),
        Variable("load.m", 7, "local", "tunable", "calculated", "kg", None, "the same mass"),
        Variable("force", 9, "input", "continuous", None, "N", 0.0),
        Variable("drive.f", 9, "local", "continuous", "calculated", "N", None),
        Variable("switch", 10, "input", "discrete", "exact", "1", -0.0),
        Variable("position", 1, "output", "continuous", "calculated", "m", None, "where the mass is"),
        Variable("mode", 11, "local", "discrete", "exact", "", 1.0),
        Variable("level", 12, "output", "discrete", None, "", None),
        Variable("half", 13, "output", "constant", None, "m^(1/2)", 0.5),
        Variable("half_again", 13, "local", "constant", "exact", "m^(1/2)", 0.5),
        Variable("weight", 14, "local", "tunable", None, "kg.m/s2", None),
        Variable("indicator[1]", 15, "local", "continuous", None, "", None),
        Variable("indicator[2]", 16, "local", "continuous", "calculated", "", None),
    ),
    states=(1, 2, 3),
    rates=(4, 5, 6),
    outputs=(3, 1, 12, 13),
    indicators=(15, 16),
    dependencies={
        1: (1,),
        3: (3,),
        4: (2,),
        5: (1, 2, 9, 10),
        6: (),
        12: (10,),
        13: (),
        15: (1,),
    },
    initial_unknowns={2: (1, 7, 8), 3: (), 4: (1, 7, 8), 5: (1, 7, 8, 9, 10), 6: (), 12: (10,)},
    start_time=0.0,
    stop_time=2.5,
    tolerance=1e-6,
    step_size=0.01,
    sources=("lu.c", "tape.c"),
)
# An output that is solved for has an alias.
ALIASED = replace(
    SPRING,
    variables=(*SPRING.variables, Variable("acceleration", 5, "output", "continuous", None, "m/s2", None)),
    outputs=(3, 1, 5, 12, 13),
)


def altered(name: str, /, **values: Any) -> Description:
    """Return the spring with other values of one variable."""
    variables = tuple(replace(v, **values) if v.name == name else v for v in SPRING.variables)
    return replace(SPRING, variables=variables)


Kind = tuple[Causality, Variability, Initial | None]
KINDS: list[Kind] = [
    (causality, variability, initial)
    for (causality, variability), allowed in INITIAL.items()
    for initial in (None, *allowed)
    if causality != "independent"
]
NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
TEXTS = st.text(max_size=5)


@st.composite
def descriptions(draw: st.DrawFn) -> Description:
    """Any description that FMI allows."""
    variables, states, rates = [TIME], [], []

    def add(kind: Kind, **more: Any) -> int:
        n = len(variables)
        unit = draw(st.sampled_from(["", "1", "m", "rad/s", "N.m/rad", "m^(1/2)"]))
        variable = Variable(f"v{n}[{n}]", 2 * n, *kind, unit, None, draw(TEXTS), **more)
        starts = initial_of(variable) in ("exact", "approx")
        variables.append(replace(variable, start=draw(NUMBERS) if starts else None))
        return variable.reference

    def add_alias(first: Variable) -> None:
        causality, variability = draw(st.sampled_from(["local", "output"])), first.variability
        if first.causality in GIVEN or (causality, variability) not in INITIAL:
            causality = "local"
        start = first.start if variability == "constant" else None
        variables.append(
            Variable(f"v{len(variables)}", first.reference, causality, variability, None, "", start, draw(TEXTS))
        )

    moving = [kind for kind in KINDS if kind[0] in ("local", "output") and kind[1] == "continuous"]
    for reinit in draw(st.lists(st.booleans(), max_size=4)):
        states.append(add(draw(st.sampled_from(moving)), reinit=reinit))
        rates.append(add(draw(st.sampled_from(moving)), derivative_of=states[-1]))
    indicators = [add(draw(st.sampled_from(moving))) for _ in range(draw(st.integers(0, 2)))]
    for kind in draw(st.lists(st.sampled_from(KINDS), max_size=8)):
        add(kind)
    for first in draw(st.lists(st.sampled_from(variables), max_size=4)):
        if first is not TIME:
            add_alias(first)
    made = replace(
        EMPTY,
        name=draw(TEXTS),
        description=draw(TEXTS),
        variables=tuple(draw(st.permutations(variables))),
        states=tuple(states),
        rates=tuple(rates),
        outputs=tuple(draw(st.permutations(sorted({v.reference for v in variables if v.causality == "output"})))),
        indicators=tuple(indicators),
    )
    leading = {reference: alike[0] for reference, alike in by_reference(made).items()}
    inputs = {v.reference for v in variables if v.causality == "input"}
    exact = {reference for reference, v in leading.items() if v.causality != "independent" and not is_solved(v)}

    def some(knowns: set[int]) -> st.SearchStrategy[tuple[int, ...]]:
        return st.sets(st.sampled_from(sorted(knowns) or [0]), max_size=3 if knowns else 0).map(sorted).map(tuple)

    unknowns = (*made.outputs, *rates, *indicators)
    return replace(
        made,
        dependencies={u: draw(some({*states, *inputs})) for u in unknowns if draw(st.booleans())},
        initial_unknowns={u: draw(some(exact)) for u in initial_unknowns(made, leading)},
    )
