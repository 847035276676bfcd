"""Runs through the faces of FMI: x' = u - x falls from 1 to a half in ln 2, and jumps back to 1."""

from __future__ import annotations

from ctypes import byref, c_bool, c_char, c_double, c_int, c_size_t, c_void_p
from math import exp, log

import pytest

from tests.acausal.core.faces import (
    DISCARD,
    END,
    ERROR,
    EXCHANGE,
    LOSE,
    OK,
    RATE,
    RETRY,
    SIMULATION,
    SLOPE,
    STOP,
    TIME,
    TROUBLE,
    EventInfo,
    Toy,
    Toy2,
    Toy3,
    U,
    X,
    doubles,
    references,
)

FALLS = log(2)


def test_model_exchange_of_version_2(toy, folder):
    one = Toy2(toy, folder, EXCHANGE)
    assert one.set(RATE, 2.0) == OK
    one.start(start=1.0, stop=3.0, tolerance=1e-4)
    info = one.happened()
    assert (info.again, info.ends, info.nominals, info.states, info.planned) == (0, 0, 0, 0, 0)
    one.right("EnterContinuousTimeMode")
    assert [one.array(f"Get{name}") for name in ("ContinuousStates", "Derivatives", "EventIndicators")] == [
        1.0,
        -2.0,
        0.5,
    ]
    assert one.array("GetNominalsOfContinuousStates") == 2.0
    one.right("SetTime", c_double(1.5))
    one.right("SetContinuousStates", doubles(0.4), c_size_t(1))
    event, ends = c_int(7), c_int(7)
    one.right("CompletedIntegratorStep", 1, byref(event), byref(ends))
    assert (event.value, ends.value) == (0, 0)
    assert one.get(TIME, X, SLOPE) == (1.5, 0.4, -0.8)
    one.right("EnterEventMode")
    assert one.happened().states == 1
    one.right("EnterContinuousTimeMode")
    assert one.array("GetContinuousStates") == 1.0
    one.right("Terminate")
    assert one.get(X) == (1.0,)
    one.right("Reset")
    assert one.get(RATE) == (1.0,)
    one.free()


def test_model_exchange_of_version_3(toy, folder):
    one = Toy3(toy, folder, EXCHANGE)
    count = c_size_t()
    for name in ("ContinuousStates", "EventIndicators"):
        one.right(f"GetNumberOf{name}", byref(count))
        assert count.value == 1
    one.right("EnterConfigurationMode")
    assert one.set(RATE, 2.0) == ERROR
    one.right("ExitConfigurationMode")
    assert one.set(RATE, 2.0) == OK
    one.start(start=1.0)
    one.right("EvaluateDiscreteStates")
    assert one.happened() == (False,) * 5
    assert one.call("EnterStepMode") == ERROR
    assert one.told() == "fmi3EnterStepMode: this must not be called in Model Exchange"
    one.right("EnterContinuousTimeMode")
    assert one.array("GetContinuousStateDerivatives") == -2.0
    one.right("SetContinuousStates", doubles(0.4), c_size_t(1))
    event, ends = c_bool(True), c_bool(True)
    one.right("CompletedIntegratorStep", c_bool(True), byref(event), byref(ends))
    assert not event.value
    assert not ends.value
    one.right("EnterEventMode")
    assert one.happened() == (False, False, False, True, False)
    one.right("EnterContinuousTimeMode")
    assert one.get(X) == (1.0,)
    one.right("Terminate")
    one.free()


def test_what_is_discarded_can_be_tried_elsewhere(toy, folder):
    for one, name in (
        (Toy2(toy, folder, EXCHANGE), "GetDerivatives"),
        (Toy3(toy, folder, EXCHANGE), "GetContinuousStateDerivatives"),
    ):
        one.start()
        one.right("EnterContinuousTimeMode")
        assert one.set(TROUBLE, RETRY) == OK
        assert one.call(name, doubles(0), c_size_t(1)) == DISCARD
        assert one.set(TROUBLE, 0) == OK
        one.right("SetContinuousStates", doubles(0.8), c_size_t(1))
        assert one.array(name) == -0.8
        one.free()


def test_an_initialisation_that_fails(toy, folder):
    for trouble, after in ((RETRY, OK), (LOSE, ERROR)):
        for one in (Toy2(toy, folder, EXCHANGE), Toy3(toy, folder, EXCHANGE)):
            assert one.set(TROUBLE, trouble) == one.enter() == OK
            assert one.call("ExitInitializationMode") == ERROR
            assert one.set(TROUBLE, 0) == after
            assert one.call("ExitInitializationMode") == after
            one.right("Reset")
            one.start()
            one.free()


def test_steps_of_version_2_handle_events(toy, folder):
    one = Toy2(toy, folder, SIMULATION)
    one.start(stop=1.0)
    for k in range(10):
        assert one.step(k / 10, 0.1) == OK
    assert one.get(TIME, X) == (1.0, pytest.approx(exp(FALLS - 1), abs=1e-15))
    reached, ends = c_double(), c_int(7)
    one.right("GetRealStatus", 2, byref(reached))
    one.right("GetBooleanStatus", 3, byref(ends))
    assert (reached.value, ends.value) == (1.0, 0)
    assert one.step(1.0, 0.1) == ERROR
    assert one.told() == "fmi2DoStep: the step ends at 1.1000000000000001, after the stop time 1"
    for name, kind in (("GetStatus", 0), ("GetIntegerStatus", 0), ("GetStringStatus", 1), ("GetRealStatus", 3)):
        assert one.call(name, kind, None) == DISCARD
    one.right("Terminate")
    assert one.step(1.0, 0.1) == ERROR
    assert one.told() == "fmi2DoStep: this must not be called in the state Terminated"
    one.free()


def test_steps_that_are_none_are_refused(toy, folder):
    two, three = Toy2(toy, folder, SIMULATION), Toy3(toy, folder, SIMULATION, True, True)
    two.start()
    three.start()
    three.right("EnterStepMode")
    for start, size, message in (
        (0.0, 0.0, "from 0 by 0 is no step"),
        (0.0, -1.0, "from 0 by -1 is no step"),
        (0.0, float("nan"), "from 0 by nan is no step"),
        (0.0, float("inf"), "from 0 by inf is no step"),
        (0.5, 0.1, "the step begins at 0.5, the last ended at 0"),
    ):
        assert two.step(start, size) == ERROR
        assert three.step(start, size)[0] == ERROR
        assert two.told() == f"fmi2DoStep: {message}"
        assert three.told() == f"fmi3DoStep: {message}"
    # Importers add times in their own way.
    assert two.step(1e-16, 0.1) == two.step(0.1 - 1e-16, 0.1) == OK
    two.free()
    three.free()


def test_a_last_step_ends_at_the_stop_time(toy, folder):
    one = Toy2(toy, folder, SIMULATION)
    one.start(stop=0.3)
    for k in range(3):
        assert one.step(0.1 * k, 0.1) == OK
    assert one.get(TIME) == (0.3,)
    one.free()


def test_a_simulation_that_ends_itself(toy, folder):
    two, three = Toy2(toy, folder, SIMULATION), Toy3(toy, folder, SIMULATION)
    for trouble, reached in ((STOP, 0.5), (END, FALLS)):
        two.start()
        three.start()
        assert two.set(TROUBLE, trouble) == three.set(TROUBLE, trouble) == OK
        for again in (0.0, reached):
            assert two.step(again, 1.0) == DISCARD
            assert three.step(again, 1.0) == (OK, (False, True, False), reached)
        value, ends = c_double(), c_int()
        two.right("GetRealStatus", 2, byref(value))
        two.right("GetBooleanStatus", 3, byref(ends))
        assert (value.value, ends.value) == (reached, 1)
        two.right("Reset")
        three.right("Reset")
    two.free()
    three.free()


def test_a_step_that_fails(toy, folder):
    two, three = Toy2(toy, folder, SIMULATION), Toy3(toy, folder, SIMULATION)
    two.start()
    three.start()
    assert two.step(0.0, 0.1) == three.step(0.0, 0.1)[0] == OK
    assert two.set(TROUBLE, RETRY) == three.set(TROUBLE, RETRY) == OK
    assert two.step(0.1, 0.1) == DISCARD
    assert three.step(0.1, 0.1) == (DISCARD, (False, False, False), 0.1)
    ends = c_int(7)
    two.right("GetBooleanStatus", 3, byref(ends))
    assert ends.value == 0
    assert two.set(TROUBLE, LOSE) == three.set(TROUBLE, LOSE) == OK
    assert two.step(0.1, 0.1) == three.step(0.1, 0.1)[0] == ERROR
    assert two.step(0.1, 0.1) == three.step(0.1, 0.1)[0] == ERROR
    assert three.told() == "fmi3DoStep: this must not be called in the state after an error from which it cannot go on"
    two.free()
    three.free()


def test_steps_of_version_3_without_events(toy, folder):
    one = Toy3(toy, folder, SIMULATION, False, True)
    one.start(stop=1.0)
    assert one.step(0.0, 1.0) == (OK, (False, False, False), 1.0)
    assert one.get(X) == (pytest.approx(exp(FALLS - 1), abs=1e-15),)
    assert one.call("EnterEventMode") == ERROR
    assert one.told() == "fmi3EnterEventMode: events of this instance are handled in its steps"
    one.free()


def test_steps_of_version_3_end_at_events(toy, folder):
    one = Toy3(toy, folder, SIMULATION, True, True)
    one.start()
    assert one.step(0.0, 1.0)[0] == ERROR
    assert one.told() == "fmi3DoStep: this must not be called in Event Mode"
    assert one.call("EnterContinuousTimeMode") == ERROR
    one.right("EnterStepMode")
    assert one.step(0.0, 1.0) == (OK, (True, False, True), FALLS)
    assert one.get(X) == (0.5,)
    assert one.step(FALLS, 0.1)[0] == ERROR
    assert one.told() == f"fmi3DoStep: the event at {FALLS:.17g} has to be handled first"
    one.right("EnterEventMode")
    assert one.happened() == (False, False, False, True, False)
    one.right("EnterStepMode")
    assert one.step(FALLS, 1 - FALLS) == (OK, (False, False, False), 1.0)
    # Importers handle events of their own whenever they like.
    one.right("EnterEventMode")
    assert one.set(U, 1.0) == OK
    assert one.happened() == (False,) * 5
    one.right("EnterStepMode")
    one.free()


def test_events_in_steps_that_do_not_end_early(toy, folder):
    one = Toy3(toy, folder, SIMULATION, True, False)
    one.start()
    one.right("EnterStepMode")
    assert one.step(0.0, 1.0) == (OK, (False, False, False), 1.0)
    one.free()


def test_an_event_that_ends_the_simulation(toy, folder):
    one = Toy3(toy, folder, SIMULATION, True, True)
    one.start()
    one.right("EnterStepMode")
    assert one.set(TROUBLE, END) == OK
    assert one.step(0.0, 1.0) == (OK, (True, False, True), FALLS)
    one.right("EnterEventMode")
    assert one.happened() == (False, True, False, True, False)
    one.free()


def test_slopes_of_inputs(toy, folder):
    one = Toy2(toy, folder, SIMULATION)
    one.start()
    orders = (c_int * 1)(1)
    one.right("SetRealInputDerivatives", references(U), c_size_t(1), orders, doubles(3.0))
    assert one.step(0.0, 0.5) == OK
    assert one.get(U) == (1.5,)
    assert one.call("SetRealInputDerivatives", references(U), c_size_t(1), (c_int * 1)(2), doubles(3.0)) == ERROR
    assert one.told() == "fmi2SetRealInputDerivatives: derivatives of order 2 are not taken"
    assert one.call("SetRealInputDerivatives", references(X), c_size_t(1), orders, doubles(3.0)) == ERROR
    one.free()


def test_derivatives_along_seeds(toy, folder):
    two, three = Toy2(toy, folder, EXCHANGE), Toy3(toy, folder, EXCHANGE)
    counts = c_size_t(1), c_size_t(2)
    rows, columns = (references(SLOPE), counts[0]), (references(X, U), counts[1])
    assert two.call("GetDirectionalDerivative", *rows, *columns, doubles(1, 1), doubles(0)) == ERROR
    for one in (two, three):
        one.start()
        found = doubles(0)
        if one.version == 2:
            one.right("GetDirectionalDerivative", *rows, *columns, doubles(2, 5), found)
        else:
            one.right("GetDirectionalDerivative", *rows, *columns, doubles(2, 5), counts[1], found, counts[0])
        assert found[0] == 3.0
    both = doubles(0, 0)
    three.right("GetAdjointDerivative", *rows, *columns, doubles(4), counts[0], both, counts[1])
    assert tuple(both) == (-4.0, 4.0)
    assert three.call("GetAdjointDerivative", *rows, *columns, doubles(4), counts[1], both, counts[1]) == ERROR
    two.free()
    three.free()


def names(one: Toy) -> dict[str, str]:
    """Names of the functions of states, which the versions spell in their own ways."""
    word, de = ("FMUstate", "DeSerialize") if one.version == 2 else ("FMUState", "Deserialize")
    found = {way: f"{way}{word}" for way in ("Get", "Set", "Free", "Serialize")}
    return found | {"Size": f"Serialized{word}Size", "Read": f"{de}{word}"}


def simulated(toy, folder, version: int) -> Toy2 | Toy3:
    one = Toy2(toy, folder, SIMULATION) if version == 2 else Toy3(toy, folder, SIMULATION)
    one.start(stop=2.0)
    assert one.step(0.0, 0.5) in (OK, (OK, (False, False, False), 0.5))
    return one


@pytest.mark.parametrize("version", [2, 3])
def test_a_state_is_gone_back_to(toy, folder, version):
    one, state = simulated(toy, folder, version), c_void_p()
    call = names(one)
    one.right(call["Get"], byref(state))
    one.step(0.5, 1.0)
    after = one.get(TIME, X)
    one.right(call["Set"], state)
    assert one.get(TIME, X) == (0.5, pytest.approx(exp(-0.5)))
    one.step(0.5, 1.0)
    assert one.get(TIME, X) == after
    one.right(call["Get"], byref(state))  # in place of the other
    one.right("Reset")
    one.right(call["Set"], state)
    assert one.get(TIME, X) == after
    one.right(call["Free"], byref(state))
    assert not state.value
    one.right(call["Free"], byref(state))
    assert one.call(call["Set"], state) == one.call(call["Size"], state, byref(c_size_t())) == ERROR
    one.free()


@pytest.mark.parametrize("version", [2, 3])
def test_a_state_as_bytes_goes_on_elsewhere(toy, folder, version):
    one, state, size = simulated(toy, folder, version), c_void_p(), c_size_t()
    call = names(one)
    one.right(call["Get"], byref(state))
    one.right(call["Size"], state, byref(size))
    content = (c_char * size.value)()
    assert one.call(call["Serialize"], state, content, c_size_t(size.value - 1)) == ERROR
    one.right(call["Serialize"], state, content, size)
    one.right(call["Free"], byref(state))
    one.step(0.5, 1.0)
    other = Toy2(toy, folder, SIMULATION) if version == 2 else Toy3(toy, folder, SIMULATION)
    other.right(call["Read"], content, size, byref(state))
    other.right(call["Set"], state)
    other.step(0.5, 1.0)
    assert other.get(TIME, X) == one.get(TIME, X)
    # An instance of another kind has other states.
    exchanging = Toy2(toy, folder, EXCHANGE) if version == 2 else Toy3(toy, folder, EXCHANGE)
    assert exchanging.call(call["Set"], state) == ERROR
    one.right(call["Free"], byref(state))
    for each in (one, other, exchanging):
        each.free()


def test_damaged_states_are_refused(toy, folder):
    one, state, size = simulated(toy, folder, 3), c_void_p(), c_size_t()
    one.right("GetFMUState", byref(state))
    one.right("SerializedFMUStateSize", state, byref(size))
    content = (c_char * size.value)()
    one.right("SerializeFMUState", state, content, size)
    one.right("FreeFMUState", byref(state))
    for k in range(size.value):
        changed = type(content).from_buffer_copy(content)
        changed[k] = bytes([changed[k][0] ^ 0x55])
        assert one.call("DeserializeFMUState", changed, size, byref(state)) == ERROR
        assert one.call("DeserializeFMUState", content, c_size_t(k), byref(state)) == ERROR
    assert not state.value
    one.free()


def test_calls_out_of_order_change_nothing(toy, folder):
    one = Toy2(toy, folder, EXCHANGE)
    for name in ("ExitInitializationMode", "EnterEventMode", "EnterContinuousTimeMode", "Terminate"):
        assert one.call(name) == ERROR
        assert one.told() == f"fmi2{name}: this must not be called in the state Instantiated"
    assert one.call("NewDiscreteStates", byref(EventInfo())) == ERROR
    assert one.call("GetDerivatives", doubles(0), c_size_t(1)) == ERROR
    assert one.step(0.0, 1.0) == ERROR
    one.start()
    assert one.call("EnterEventMode") == one.times() == one.call("ExitInitializationMode") == ERROR
    assert one.call("SetContinuousStates", doubles(0), c_size_t(1)) == ERROR
    one.right("EnterContinuousTimeMode")
    assert one.call("EnterContinuousTimeMode") == ERROR
    assert one.set(RATE, 3.0) == ERROR
    assert one.told() == "fmi2SetReal: this variable is not set now"
    assert one.array("GetDerivatives") == -1.0
    one.free()
    one = Toy2(toy, folder, SIMULATION)
    one.start()
    assert one.call("GetDerivatives", doubles(0), c_size_t(1)) == ERROR
    assert one.told() == "fmi2GetDerivatives: this must not be called in Co-Simulation"
    one.free()
