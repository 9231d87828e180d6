# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long a vehicle keeps to the lane that it has changed to, at some time or after an event."""

from __future__ import annotations

from itertools import pairwise
from typing import Literal

import numpy as np

from aurora_core.document import omitted
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.judging.happening import agent_action, never_happened
from aurora_core.judging.quantity import OfEvent, Quantity
from aurora_core.judging.until import existing_until
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities.lane_changes import change_ticks, lanes_beside
from aurora_core.quantities.lanes import (
    NO_LANE,
    LaneArray,
    lane_before,
    lane_change_ticks,
    lane_of,
)
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import AgentAction, Event
from aurora_core.spec.vocabulary import LaneSide


class LaneChange(Quantity):
    """Time for which a lane was kept after the change to it, of the change kept longest, s.

    Attributes:
        side: Changes to this side alone count; None: to any.
    """

    name = QuantityName.LANE_CHANGE
    kind: Literal['lane_change'] = 'lane_change'
    window: Window = Window.RUN
    side: LaneSide | None = omitted(None)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the time; where there is no other lane nothing can be changed."""
        end = existing_until(context, condition)
        if isinstance(end, Missing):
            return end
        view = context.view
        body = view.body(condition.of[0])
        lanes = lane_of(view, body)[:end]
        if not any(lanes_beside(view.world, k, self.side) for k in _visited(lanes)):
            story = f'{body.body_id} was never on a street with {_another(self.side)} to change to'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        changes = lane_change_ticks(view, lanes)
        kept = _kept(changes, lanes, end, whole_ticks(condition.threshold, view.dt_s))
        asked = change_ticks(view, lanes, self.side)
        found = {tick: ticks for tick, ticks in zip(changes, kept, strict=True) if tick in asked}
        if not found:
            story = _stayed(body.body_id, self.side)
            return at_tick(0, 0.0, story, ground_topics(condition), later=Later.RISES)
        tick = max(found, key=lambda k: (found[k], -k))
        kept_s = context.time_s(found[tick])
        story = (
            f'{body.body_id} changed lane at {context.time_s(tick):.2f} s and kept to the new one '
            f'for {kept_s:.2f} s'
        )
        return at_tick(tick, kept_s, story, ground_topics(condition), later=Later.RISES)


class LaneKeptAfter(OfEvent):
    """Time for which a lane was kept after the change to it that an event asks for, s."""

    name = QuantityName.LANE_CHANGE
    kind: Literal['lane_kept_after'] = 'lane_kept_after'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the time from when the vehicle got to the other lane."""
        action = agent_action(context, condition, self.event)
        times = context.events
        due = 0 if self.untold(context) else times.due_tick(self.event)
        if due is None:
            return never_happened(context, condition, f'{self.event} was never due')
        view = context.view
        body = view.body(action.agent)
        lanes = lane_of(view, body)
        topics = ground_topics(condition)
        begins = times.action_tick(self.event, due)
        if begins is None:
            story = _stayed(body.body_id, action.side)
            return at_tick(due, 0.0, story, topics, later=Later.RISES, provisional=True)
        changes = lane_change_ticks(view, lanes)
        tick = next(t for t in change_ticks(view, lanes, action.side) if t >= begins)
        back = next((t for t in changes if t > tick), view.ticks - 1)
        kept_s = context.time_s(back - tick)
        story = (
            f'{body.body_id} got to the other lane at {context.time_s(tick):.2f} s and kept to it '
            f'for {kept_s:.2f} s'
        )
        kept = back < view.ticks - 1
        return at_tick(tick, kept_s, story, topics, later=Later.RISES, provisional=not kept)

    def untold(self, context: Context) -> bool:
        """Tell whether nobody says when the event happens."""
        event = context.events.event(self.event)
        return event is not None and event.trigger is None


def after_event(inputs: Inputs, event: Event, action: AgentAction, source: Source) -> Condition:
    """Return that an agent keeps to the lane that an event makes it change to."""
    hold_s = inputs.tolerances.lane_hold_s
    return condition(
        id=f'{event.id}.lane',
        sentence=f'{action.agent} keeps to {the_lane(action.side)} for {number(hold_s)} s',
        of=(action.agent,),
        target=Target(op='>=', threshold=hold_s, unit='s'),
        arguments=LaneKeptAfter(**inputs.of_event(event.id)),
        source=source,
        every_sample=False,
    )


def the_lane(side: LaneSide | None) -> str:
    """Return the words for the lane that is changed to."""
    return 'the other lane' if side is None else f'the lane on its {side.value}'


def _another(side: LaneSide | None) -> str:
    return 'another lane' if side is None else f'a lane on its {side.value}'


def _stayed(body_id: str, side: LaneSide | None) -> str:
    return f'{body_id} ' + (
        'kept to its lane' if side is None else f'did not go to its {side.value}'
    )


def _kept(changes: list[int], lanes: LaneArray, end: int, least: int) -> list[int]:
    """Return for how many ticks each change lasted; going back before `least` is none."""
    kept: list[int] = []
    for k, (tick, stop) in enumerate(pairwise([*changes, end - 1])):
        back = k > 0 and kept[-1] < least and lanes[tick] == lane_before(lanes, changes[k - 1])
        kept.append(0 if back else stop - tick)
    return kept


def _visited(lanes: LaneArray) -> list[int]:
    found: list[int] = np.unique(lanes[lanes != NO_LANE]).tolist()
    return found
