# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is to slow down or stop is on the move right before: who stands has nothing to do.

The event is due at 15 s, tick 300; 2 m/s in the 2 s before are asked for.
"""

from __future__ import annotations

import numpy as np
import pytest
from action_cases import AT_S, TICK, T, changed, never_due, told_car
from kind_rows import Row, gone
from trace_builder import number
from trace_cases import Case, spec

from aurora_core.outcomes.schedule import AgentFacts
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Unit


def _rests_from(tick: int, do: str = 'stop') -> Case:
    """It drives at 8 m/s and stands from a tick on."""
    return told_car(do, np.where(tick > TICK, 8.0, 0.0), AT_S)


def _sets_off(tick: int) -> Case:
    """It stands, and gains 2 m/s^2 from a tick on."""
    speed = np.clip(0.1 * (TICK - tick), 0.0, 10.0).astype(np.float64)
    return told_car('stop', speed, AT_S)


def _to(value_mps: float, before_mps: float) -> Case:
    case = told_car('slow', np.where(TICK < 320, before_mps, value_mps), AT_S)
    (event,) = case.spec.events
    assert event.action is not None
    value = number(value_mps, Unit.METRE_PER_SECOND, explicit=True)
    return changed(case, action={**dict(event.action), 'value_mps': value})


def _after_4_s(tick: int) -> Case:
    delay_s = number(4.0, Unit.SECOND, explicit=True)
    return changed(_rests_from(tick), delay_s=delay_s)


def _creeps(speed_mps: float) -> Case:
    """It is asked to drive at 2 m/s: half of that will do."""
    case = told_car('stop', np.where(TICK < 310, speed_mps, 0.0), AT_S)
    (agent,) = case.spec.agents
    (drives,) = agent.behaviors
    asked = number(2.0, Unit.METRE_PER_SECOND, explicit=True)
    drives = drives.model_copy(update={'speed_mps': asked})
    one = agent.model_copy(update={'behaviors': (drives,)})
    case.spec = spec(**{**dict(case.spec), 'agents': (one,)})
    return case


def _told_at_1_s(gains_mps2: float) -> Case:
    case = told_car('stop', np.clip(gains_mps2 * 0.05 * TICK, 0.0, 1.2), 1.0)
    facts = AgentFacts(agent='car1', acceleration_mps2=1.2, deceleration_mps2=4.0)
    case.facts = case.facts.model_copy(update={'agents': (facts,)})
    return case


ROWS = (
    Row(id='e1.moving', make=lambda: _rests_from(310), margin=6.0),
    Row(id='e1.moving', make=lambda: _rests_from(262), margin=6.0, what='just-now'),
    Row(id='e1.moving', make=lambda: _rests_from(259), margin=-2.0, what='long-ago'),
    Row(id='e1.moving', make=lambda: _sets_off(290), margin=1.0 - 2.0, what='sets-off'),
    Row(id='e1.moving', make=lambda: _sets_off(275), margin=2.5 - 2.0, what='has-set-off'),
    # Who gives way may have come there and waits.
    Row(id='e1.moving', make=lambda: _rests_from(100, 'yield'), margin=6.0, what='yields'),
    Row(id='e1.moving', make=lambda: _rests_from(0, 'yield'), margin=-2.0, what='yields'),
    # Who is slower than he is to be has nothing to do, but is on the move.
    Row(id='e1.moving', make=lambda: _to(4.0, 3.5), margin=1.5, what='to-a-speed'),
    Row(id='e1.moving', make=lambda: _to(4.0, 0.5), margin=-1.5, what='to-a-speed'),
    # A wait is over 4 s after the trigger: it was on the move when that came.
    Row(id='e1.moving', make=lambda: _after_4_s(310), margin=6.0, what='waits'),
    Row(id='e1.moving', make=lambda: _after_4_s(200), margin=-2.0, what='waits'),
    # At 1 s it has half of the 1.2 m/s that it can have gained by then.
    Row(id='e1.moving', make=lambda: _told_at_1_s(1.2), margin=0.6, what='at-once'),
    Row(id='e1.moving', make=lambda: _told_at_1_s(0.0), margin=-0.6, what='at-once'),
    Row(id='e1.moving', make=lambda: _creeps(2.0), margin=1.0, what='creeps'),
    Row(id='e1.moving', make=lambda: _creeps(0.5), margin=-0.5, what='creeps'),
    Row(id='e1.moving', make=lambda: never_due('stop', 0.0), reason=Reason.PREMISE_NEVER),
    Row(
        id='e1.moving',
        make=lambda: gone(_rests_from(310), 0, 280, T),
        reason=Reason.TARGET_GONE,
        what='gone',
    ),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_who_slows_down_was_on_the_move(row: Row) -> None:
    row.check()
