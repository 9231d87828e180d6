# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What says the same in another form: the list, each with the rule of the contract it rests on.

A requirement that the plain comparison misses is met when one of these finds it wholly said in
another form: the numbers under the same tolerances, nothing in part. `EQUIVALENCES` is the list;
the landing that ends every mission is no requirement at all (`denominator.py`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from aurora_bench.fidelity.fields import Case
from aurora_bench.fidelity.forms_of_conditions import (
    is_at_time,
    is_of_each_member,
    is_whole_share,
    is_within_horizon,
)
from aurora_bench.fidelity.forms_of_events import (
    is_ascent,
    is_chain,
    is_next_mission,
    is_onset,
    is_ordered,
)
from aurora_bench.fidelity.forms_of_scenes import (
    is_above,
    is_placed,
    is_speed_of_motion,
    is_watched,
    oncoming,
    parked,
)


@dataclass(frozen=True, kw_only=True)
class Equivalence:
    """Two forms of one meaning.

    Attributes:
        key: By which scores and tables call it.
        forms: What says the same.
        contract: What makes them the same.
        holds: Whether the requirement is wholly said in the other form.
    """

    key: str
    forms: str
    contract: str
    holds: Callable[[Case], bool]


def in_another_form(case: Case) -> str:
    """Return the key of the equivalence by which a requirement holds; empty when none does."""
    return next((e.key for e in EQUIVALENCES if e.holds(case)), '')


EQUIVALENCES: tuple[Equivalence, ...] = (
    Equivalence(
        key='sequence',
        forms='two missions in sequence = mission_done, then change_mission',
        contract='two missions of one UAV in sequence are `mission_done` -> `change_mission` and '
        'their order; those of one UAV are flown in the order listed',
        holds=is_next_mission,
    ),
    Equivalence(
        key='chain',
        forms='a delay = a chain by event_done.after_s, through milestones and times',
        contract='`delay_s` of an event is a chain by `event_done.after_s`; event times count '
        'from t = 0; a chain counts from the completion of what it waits for, which a milestone '
        'has at once and an action has not',
        holds=partial(is_chain, ascents=False),
    ),
    Equivalence(
        key='milestone',
        forms='a milestone = the trigger of another event',
        contract='an event may lack its action (a milestone); one happens after its trigger, and '
        'a trigger that never comes true is a violation either way',
        holds=is_onset,
    ),
    Equivalence(
        key='ascent',
        forms='the end of an ascent = altitude_reached',
        contract='chains count from completion: an ascent is complete at its altitude',
        holds=is_ascent,
    ),
    Equivalence(
        key='order',
        forms='an order of moments said in another form',
        contract='an order of two missions in sequence, or of a trigger and what follows it, is '
        'the order of what says the same; a deadline after a trigger is `within_s`',
        holds=is_ordered,
    ),
    Equivalence(
        key='event_time',
        forms='event_time == T = an event at the time T',
        contract='`event_time` is in seconds from scenario start, and so is a time trigger',
        holds=is_at_time,
    ),
    Equivalence(
        key='target',
        forms='role target = what a mission watches',
        contract='`target` is the role of whatever a mission watches',
        holds=is_watched,
    ),
    Equivalence(
        key='oncoming',
        forms='oncoming with a distance = oncoming, and near or ahead at that distance',
        contract='`oncoming` with a distance is oncoming and near at that distance',
        holds=partial(is_placed, facts=oncoming),
    ),
    Equivalence(
        key='parked',
        forms='parked at a place = parks, and is at the place',
        contract='a parked body stands from t = 0; a placement is measured at t = 0',
        holds=partial(is_placed, facts=parked),
    ),
    Equivalence(
        key='speed',
        forms='a motion at a speed = the motion, and driving at that speed',
        contract='an explicit speed becomes one condition on the ground speed of the body, '
        'whichever motion carries it',
        holds=is_speed_of_motion,
    ),
    Equivalence(
        key='above',
        forms='hover with standoff 0 = hover over the target',
        contract='a standoff of 0 m is above the target',
        holds=is_above,
    ),
    Equivalence(
        key='horizon',
        forms='landed or completed by T = a scenario of T seconds',
        contract='a stated scenario duration is the horizon; every mission is completed and the '
        'UAV landed within the horizon',
        holds=is_within_horizon,
    ),
    Equivalence(
        key='group',
        forms='a condition of a group = the same condition of each member',
        contract='over a group: all members',
        holds=is_of_each_member,
    ),
    Equivalence(
        key='share',
        forms='a share of at least all = of exactly all',
        contract='a share is at most 1 and at least 0',
        holds=is_whole_share,
    ),
)
