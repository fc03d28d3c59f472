"""The switch of a virtual attraction point, as a state machine.

State: the point acts or not, since which step, how often it was switched on, how often it was
reached. Transitions, taken once per step:

* off -> on    the arm is stuck, the rule is ``on_when_stuck`` or ``replaces_goal``, tries are left;
* on -> off    X is within the release distance of X_v (an arrival), or the time is over;
* off -> end   the arm is stuck and no try is left: it is trapped.

``from_start`` begins on, with its only try; ``always`` begins on and stays, so that a stuck arm is
trapped at once.
"""

from __future__ import annotations

from typing import NamedTuple

from ...kernel import kernel
from ...settings import code
from ..settings import Switching

NO_POINT = -1
_FROM_START = code(Switching.FROM_START)
_ALWAYS = code(Switching.ALWAYS)
_REPLACES_GOAL = code(Switching.REPLACES_GOAL)


class SwitchRules(NamedTuple):
    """``rule`` is the code of a :class:`.settings.Switching`, or ``NO_POINT``."""

    rule: int
    release_distance: float
    max_steps: int
    max_activations: int


class Switch(NamedTuple):
    """State; ``since`` is the step of the last change, ``trapped`` ends the plan."""

    active: bool
    since: int
    activations: int
    arrivals: int
    trapped: bool


@kernel
def initial(rules):
    """State before the first step."""
    on = rules.rule == _FROM_START or rules.rule == _ALWAYS
    return Switch(on, 0, 1 if on else 0, 0, False)


@kernel
def switched(state, rules, stuck, distance, step):
    """State after one look at the arm.

    Parameters
    ----------
    stuck : bool
        Whether the arm stands still in the potential of this state.
    distance : float
        |X - X_v| [m].
    """
    if state.active and rules.rule != _ALWAYS:
        if distance <= rules.release_distance:
            return Switch(False, step, state.activations, state.arrivals + 1, False)
        if step - state.since >= rules.max_steps:
            return Switch(False, step, state.activations, state.arrivals, False)
        return state
    if not stuck:
        return state
    again = rules.rule != NO_POINT and rules.rule != _FROM_START and rules.rule != _ALWAYS
    if again and state.activations < rules.max_activations:
        return Switch(True, step, state.activations + 1, state.arrivals, False)
    return Switch(state.active, state.since, state.activations, state.arrivals, True)


@kernel
def may_finish(state, rules):
    """Whether being at the goal counts: not while a point acts that is yet to be switched off.

    An arm that swings through its goal on the way to a virtual point has not arrived.
    """
    return not state.active or rules.rule == _ALWAYS


@kernel
def acting(state, rules):
    """Whether the goal and whether the virtual point attract."""
    return not (state.active and rules.rule == _REPLACES_GOAL), state.active
