# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of event, alert and link conditions: satisfied, violated, not judged.

In `tailgate_case` the van is within 20 m of the ego at 32.25 s and the alert is sent at once; one
attempt takes two ticks (0.1 s), attempts are four ticks (0.2 s) apart.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from kind_rows import Row, cut
from trace_builder import number, world
from trace_cases import Case, facts_of, message, mission, spec, tailgate_case

from aurora_core.knowledge.world import NamedPlace
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Unit
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import UavColumn

TRIGGER_S = 32.25
TRIGGER = 645
END_S = 1401 * 0.05  # the first tick after the record


def _sent(ticks: int) -> Case:
    """The alert is sent this many ticks after its trigger."""
    case = tailgate_case()
    case.run.links[:] = [replace(r, tick=r.tick + ticks) for r in case.run.links]
    return case


def _never() -> Case:
    return tailgate_case(keeps_away=True)


def _event(case: Case, **values: object) -> Case:
    (event,) = case.spec.events
    case.spec = spec(**{**dict(case.spec), 'events': (dict(event) | values,)})
    return case


def _at(asked_s: float, *, alert: bool = True) -> Case:
    at = {'on': 'time', 'at_s': number(asked_s, Unit.SECOND, explicit=True)}
    return _event(tailgate_case(alert=alert), trigger=at)


def _milestone(altitude_m: float, horizon_s: float = 70.0) -> Case:
    """An event without an action: the drone reaches an altitude, with 0.2 m per tick."""
    reached = {'on': 'altitude_reached', 'uav': 'uav1', 'value_m': number(altitude_m)}
    case = _event(tailgate_case(), trigger=reached, action=None)
    case.facts = case.facts.model_validate(dict(case.facts) | {'horizon_s': horizon_s})
    return case


def _link(case: Case, **values: object) -> Case:
    (link,) = case.spec.links
    case.spec = spec(**{**dict(case.spec), 'links': (dict(link) | values,)})
    return case


def _latency(ticks: int, lost: int = 0) -> Case:
    """0.1 s are stated, and this many ticks are recorded."""
    case = tailgate_case()
    case.run.links.clear()
    message(case, TRIGGER, lost=lost, latency_ticks=ticks)
    return _link(case, latency_s=number(0.1, Unit.SECOND, explicit=True))


def _hovering(sent: int = 0, *, alert: bool = True) -> Case:
    """The drone that reports hovers, so that the end of its ascent counts."""
    case = _sent(sent) if alert else _never()
    hover = mission('m1', MissionMode.HOVER, target='van1')
    case.spec = spec(**{**dict(case.spec), 'missions': (hover,)})
    case.facts = facts_of(
        MissionFacts(
            mission='m1',
            uav='uav1',
            mode=MissionMode.HOVER,
            altitude_m=30.0,
            hover_point=(0.0, 20.0, 30.0),
            duration_s=30.0,
        ),
        horizon_s=70.0,
    )
    return case


def _fog(metres: float) -> Case:
    """Sight ends at 75 m; the drone flies beside the van."""
    case = tailgate_case()
    case.world = world(weather='fog')
    case.run.flights[0].states[400:1050, 1] += metres
    return case


def _ordered(first: str, then: str, within_s: float | None = None, **alert: bool) -> Case:
    """The alert e1 at 32.25 s and the milestone e2: 29 m are reached at 7.05 s."""
    case = tailgate_case(**alert)
    reached = {'on': 'altitude_reached', 'uav': 'uav1', 'value_m': number(29.0)}
    order: dict[str, object] = {'id': 'o1', 'first': first, 'then': then}
    if within_s is not None:
        order['within_s'] = number(within_s, Unit.SECOND, explicit=True)
    events = (*case.spec.events, {'id': 'e2', 'trigger': reached})
    case.spec = spec(**{**dict(case.spec), 'events': events, 'orders': (order,)})
    return case


def _flown_for(seconds: float) -> float:
    """Return when the UAV of `tailgate_case` has been in the air for more than so long (s)."""
    rows = tailgate_case().run.trace().uav[:, 0]
    flies = (rows[:, UavColumn.LANDED] < 0.5) | (rows[:, UavColumn.Z] > 0.3)
    return float(np.flatnonzero(np.cumsum(flies) * 0.05 > seconds + 1e-9)[0]) * 0.05


def _late_after(**trigger: object) -> Case:
    """The alert, at 32.25 s, comes long after this trigger."""
    case = _event(tailgate_case(), trigger=trigger)
    spot = NamedPlace(name='intersection', x_m=-45.0, y_m=0.0)
    case.world = replace(case.world, places=(spot,))
    return case


def _never_answered() -> Case:
    """The ego does not slow down when it receives the alert."""
    case = tailgate_case()
    answer = {
        'id': 'e2',
        'trigger': {'on': 'message_received', 'by': 'ego', 'sender': 'uav1'},
        'action': {'do': 'slow', 'agent': 'ego'},
    }
    case.spec = spec(**{**dict(case.spec), 'events': (*case.spec.events, answer)})
    return case


NEVER, SHORT = Reason.PREMISE_NEVER, Reason.TRACE_SHORT
# 49.24 m to the waiting van in steps of 0.75 m, from tick 141 or 142 on: the 53rd is within 10 m.
CAPTURED_S = 194 * 0.05
ROWS = (
    # 1 s is allowed.
    Row(id='e1.within', make=tailgate_case, margin=1.0),
    Row(id='e1.within', make=lambda: _sent(30), margin=1.0 - 1.5),
    Row(id='e1.within', make=lambda: _sent(20), margin=0.0, what='threshold'),
    Row(id='e1.within', make=_never, reason=NEVER),
    Row(id='e1.within', make=lambda: cut(tailgate_case(), 640), reason=SHORT),
    # The ego drives 2 m/s from 21 s on, the ascent ends at 7 s, the drone lands from 52.5 s on.
    Row(
        id='e1.within',
        make=lambda: _late_after(
            on='speed_above', who='ego', value_mps=number(2.0, Unit.METRE_PER_SECOND)
        ),
        margin=1.0 - 11.25,
        within=0.06,
        what='speed',
    ),
    # Seen on its way up: who tracks reports from its capture on.
    Row(
        id='e1.within',
        make=lambda: _late_after(on='visible', observer='uav1', target='van1'),
        margin=1.0 - 22.55,
        within=0.06,
        what='visible',
    ),
    # It is as near when the drone takes off: the time counts from the capture on.
    Row(
        id='e1.within',
        make=lambda: _late_after(
            on='distance_below', a='van1', b='uav1', value_m=number(900.0, explicit=True)
        ),
        margin=1.0 - (TRIGGER_S - CAPTURED_S),
        within=0.06,
        what='near the sender',
    ),
    # 15 s in the air of 1500 s.
    Row(
        id='e1.within',
        make=lambda: _late_after(on='battery_below', uav='uav1', value=number(0.99, Unit.ONE)),
        margin=1.0 - (32.25 - _flown_for(15.0)),
        within=0.06,
        what='battery',
    ),
    Row(
        id='e1.within',
        make=lambda: _late_after(on='arrives', who='van1', place='intersection'),
        margin=1.0 - 32.25,
        what='arrives',
    ),
    Row(
        id='e1.within',
        make=lambda: _late_after(on='mission_done', uav='uav1'),
        margin=1.0 - (END_S - 52.5),
        within=0.06,
        what='mission_done',
    ),
    Row(
        id='e2.within',
        make=_never_answered,
        margin=1.0 - (END_S - TRIGGER_S - 0.1),
        within=0.06,
        what='answer',
    ),
    Row(id='e1.not_before', make=tailgate_case, margin=0.0),
    Row(id='e1.not_before', make=lambda: _sent(-30), margin=-1.5),
    Row(id='e1.not_before', make=_never, reason=NEVER),
    # 2 % are allowed.
    Row(id='e1.time', make=lambda: _at(32.0), margin=0.64 - 0.25),
    Row(id='e1.time', make=lambda: _at(30.0), margin=0.6 - 2.25),
    Row(id='e1.time', make=lambda: _at(32.0, alert=False), reason=NEVER),
    # 29 m are reached with the 145th tick (by rounding perhaps with the next one).
    Row(id='e1.happens', make=lambda: _milestone(29.0), margin=70.0 - 7.05, within=0.06),
    Row(id='e1.happens', make=lambda: _milestone(29.0, 5.0), margin=5.0 - 7.05, within=0.06),
    Row(id='e1.happens', make=lambda: _milestone(99.0), reason=NEVER),
    Row(id='e1.after_capture', make=tailgate_case, margin=TRIGGER_S - CAPTURED_S, within=0.06),
    Row(
        id='e1.after_capture',
        make=lambda: _sent(150 - TRIGGER),
        margin=7.5 - CAPTURED_S,
        within=0.06,
    ),
    Row(id='e1.after_capture', make=_never, reason=NEVER),
    # The ascent ends at 7 s.
    Row(id='e1.after_ascent', make=_hovering, margin=TRIGGER_S - 7.0, within=0.06),
    Row(
        id='e1.after_ascent',
        make=lambda: _hovering(100 - TRIGGER),
        margin=5.0 - 7.0,
        within=0.06,
    ),
    Row(id='e1.after_ascent', make=lambda: _hovering(alert=False), reason=NEVER),
    # Straight above the van, whose sight point is at half its height of 2.2 m.
    Row(id='e1.actor_visible', make=lambda: _fog(0.0), margin=75.0 - (30.0 - 1.1)),
    Row(id='e1.actor_visible', make=lambda: _fog(80.0), margin=75.0 - math.hypot(80.0, 28.9)),
    Row(id='e1.actor_visible', make=_never, reason=NEVER),
    # 2 s are allowed.
    Row(id='e1.delivered', make=tailgate_case, margin=2.0 - 0.1),
    Row(
        id='e1.delivered',
        make=lambda: tailgate_case(lost=3),
        margin=2.0 - (3 * 0.2 + 0.1),
        what='retransmitted',
    ),
    # Given up: at the earliest after the end of the record.
    Row(id='e1.delivered', make=lambda: tailgate_case(lost=9), margin=2.0 - (END_S - TRIGGER_S)),
    Row(id='e1.delivered', make=_never, reason=NEVER),
    Row(id='e1.delivered', make=lambda: cut(tailgate_case(), TRIGGER + 2), reason=SHORT),
    # Two ticks are asked, two may be added.
    Row(id='e1.latency', make=lambda: _latency(2), margin=2.0),
    Row(id='e1.latency', make=lambda: _latency(5), margin=2.0 - 3.0),
    Row(id='e1.latency', make=lambda: _latency(2, lost=9), reason=NEVER),
    # From 7.05 s to 32.25 s.
    Row(id='o1.holds', make=lambda: _ordered('e2', 'e1'), margin=25.2, within=0.06),
    Row(id='o1.holds', make=lambda: _ordered('e1', 'e2'), margin=-25.2, within=0.06),
    Row(id='o1.holds', make=lambda: _ordered('e2', 'e1', alert=False), reason=NEVER),
    Row(id='o1.holds', make=lambda: cut(_ordered('e2', 'e1'), 640), reason=SHORT),
    Row(id='o1.within', make=lambda: _ordered('e2', 'e1', 26.0), margin=0.8, within=0.06),
    Row(id='o1.within', make=lambda: _ordered('e2', 'e1', 20.0), margin=-5.2, within=0.06),
    Row(id='o1.within', make=lambda: _ordered('e2', 'e1', 26.0, alert=False), reason=NEVER),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_event_kinds(row: Row) -> None:
    row.check()
