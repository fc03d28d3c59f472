"""The switch of the virtual point: every transition of the state machine."""

import pytest

from dualarm_repro.planning import Switching
from dualarm_repro.planning.descent.virtual_point import (
    NO_POINT,
    SwitchRules,
    acting,
    initial,
    may_finish,
    switched,
)
from dualarm_repro.settings import code

FAR, NEAR = 1.0, 0.05
STUCK = [Switching.ON_WHEN_STUCK, Switching.REPLACES_GOAL]


def rules(switching, tries=2):
    number = NO_POINT if switching is None else code(switching)
    return SwitchRules(number, 0.1, 30, tries)


def after(state, chosen, events):
    """State after events (stuck, distance, step)."""
    for event in events:
        state = switched(state, chosen, *event)
    return state


@pytest.mark.parametrize("switching", STUCK)
def test_a_trap_switches_it_on_and_coming_close_switches_it_off(switching):
    chosen = rules(switching)
    state = initial(chosen)
    assert not state.active
    state = after(state, chosen, [(False, FAR, 3), (True, FAR, 10)])
    assert (state.active, state.since, state.activations) == (True, 10, 1)
    state = after(state, chosen, [(False, FAR, 11), (True, FAR, 12)])
    assert state.active
    assert not state.trapped
    state = after(state, chosen, [(False, NEAR, 13)])
    assert (state.active, state.since, state.arrivals, state.activations) == (False, 13, 1, 1)


@pytest.mark.parametrize("switching", STUCK)
def test_after_its_time_it_is_switched_off_without_arrival(switching):
    chosen = rules(switching)
    on = after(initial(chosen), chosen, [(True, FAR, 10)])
    assert switched(on, chosen, False, FAR, 39).active
    off = switched(on, chosen, False, FAR, 40)
    assert (off.active, off.arrivals, off.since) == (False, 0, 40)


@pytest.mark.parametrize("switching", STUCK)
def test_when_no_try_is_left_the_arm_is_trapped(switching):
    chosen = rules(switching, tries=1)
    state = after(initial(chosen), chosen, [(True, FAR, 1), (False, NEAR, 5), (True, FAR, 20)])
    assert state.trapped
    assert state.activations == 1


def test_without_a_point_the_first_trap_is_the_end():
    chosen = rules(None)
    assert switched(initial(chosen), chosen, True, FAR, 50).trapped


def test_from_the_start_there_is_one_try():
    chosen = rules(Switching.FROM_START)
    state = initial(chosen)
    assert state.active
    assert state.activations == 1
    assert not may_finish(state, chosen)
    state = switched(state, chosen, True, NEAR, 8)
    assert not state.active
    assert state.arrivals == 1
    assert may_finish(state, chosen)
    assert switched(state, chosen, True, FAR, 60).trapped


def test_always_is_never_switched_off():
    chosen = rules(Switching.ALWAYS)
    state = after(initial(chosen), chosen, [(False, NEAR, 1), (False, FAR, 999)])
    assert state.active
    assert not state.trapped
    assert may_finish(state, chosen)
    assert switched(state, chosen, True, FAR, 1000).trapped


def test_who_attracts():
    for switching in [*Switching, None]:
        chosen = rules(switching)
        off = initial(rules(Switching.ON_WHEN_STUCK))
        assert acting(off, chosen) == (True, False)
        on = off._replace(active=True)
        assert acting(on, chosen) == (switching is not Switching.REPLACES_GOAL, True)
