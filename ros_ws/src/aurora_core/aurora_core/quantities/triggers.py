# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When events are triggered and carried out, recomputed from states and ledger.

A trigger fires at the first tick at which its predicate holds. "Falls below", "loses sight" and
"gets farther than" ask for a change: their predicate must have been false before. Sight triggers
of UAVs count from the end of their ascent on.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2_array
from aurora_core.knowledge.world import SurfaceKind
from aurora_core.quantities import motion
from aurora_core.quantities.actions import (
    CLIMBED_M,
    CROSSED_M,
    completion_index,
    holds_already,
    rest_s,
    speed_goal,
    takes_time,
)
from aurora_core.quantities.braking import braking_mps2
from aurora_core.quantities.doing import done_tick
from aurora_core.quantities.lane_changes import (
    LANE_CHANGE_S,
    change_begins,
    change_is_over,
)
from aurora_core.quantities.ledger import messages
from aurora_core.quantities.state_triggers import (
    EventRules,
    StateTrigger,
    needs_change,
    trigger_series,
)
from aurora_core.quantities.ticks import first_tick, onset_tick, whole_ticks
from aurora_core.quantities.view import RunView
from aurora_core.spec.flight_order import counts_from_capture, is_next_anyway
from aurora_core.spec.parking import crosses_from_wait
from aurora_core.spec.scenario import (
    AgentAction,
    BehaviorDoneTrigger,
    DistanceTrigger,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    ScenarioSpec,
    SendMessage,
    UavAction,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import UavCommandColumn, UavPhase

BoolArray = npt.NDArray[np.bool_]

# A UAV that climbs this fast ascends (m/s).
CLIMBS_MPS = 0.5


def _is_near_the_sender(event: Event) -> bool:
    """Tell whether a message says that somebody has come near its sender, or into its sight."""
    action, trigger = event.action, event.trigger
    if not isinstance(action, SendMessage):
        return False
    if isinstance(trigger, VisibilityTrigger):
        return trigger.on == 'visible' and action.sender == trigger.observer
    if not isinstance(trigger, DistanceTrigger):
        return False
    return trigger.on == 'distance_below' and action.sender in (trigger.a, trigger.b)


@dataclass(slots=True)
class EventTimes:
    """Recomputed ticks of the events of a run.

    Args:
        view: The run.
        spec: Its specification.
        rules: What the moments are measured with.
    """

    view: RunView
    spec: ScenarioSpec
    rules: EventRules
    _open: set[str] = field(default_factory=set)

    def event(self, event_id: str) -> Event | None:
        """Return an event of the specification."""
        return next((event for event in self.spec.events if event.id == event_id), None)

    def trigger_tick(self, event_id: str) -> int | None:
        """Return the first tick at which the trigger of an event holds, None if it never does."""
        event = self.event(event_id)
        if event is None or event.trigger is None or event_id in self._open:
            return None
        self._open.add(event_id)
        try:
            return self._first(event)
        finally:
            self._open.discard(event_id)

    def due_tick(self, event_id: str) -> int | None:
        """Return the tick at which the action of an event is due: its trigger plus its delay."""
        event, trigger = self.event(event_id), self.trigger_tick(event_id)
        if event is None or trigger is None:
            return None
        return trigger + whole_ticks(event.waits_s, self.view.dt_s)

    def possible_tick(self, event_id: str, start: int) -> int | None:
        """Return the first tick from `start` on at which an action is possible.

        What comes near itself, or into its sight, a UAV reports once it is up, or has captured
        what it tracks: it may be so before. All else is possible anywhere: a street without
        another lane to change to excuses nobody. None where it never is.
        """
        event = self.event(event_id)
        if event is None or not _is_near_the_sender(event):
            return start
        return self.reports_from(event, start)

    def reports_from(self, event: Event, start: int) -> int | None:
        """Return from when on, not before `start`, a UAV sends what an event makes it send.

        That is once it is up, or has captured what it tracks; None if that never comes.
        """
        assert isinstance(event.action, SendMessage)
        sender = event.action.sender
        first = next((m for m in self.spec.missions if m.uav == sender), None)
        flight = self.rules.flights.get(sender)
        if first is None or flight is None:
            return start
        tracks = first.mode is MissionMode.TRACK
        ready = self.rules.captured(sender, None) if tracks else flight.ascent_end_tick
        return None if ready is None else max(start, ready)

    def hidden_s(self, event_id: str) -> float:
        """Return for how long an action may be under way before that is known, in seconds.

        That a vehicle changes lane is known once it is on the other one.
        """
        event = self.event(event_id)
        action = None if event is None else event.action
        changes = isinstance(action, AgentAction) and action.do == 'change_lane'
        return LANE_CHANGE_S if changes else 0.0

    def done_tick(self, event_id: str) -> int | None:
        """Return the tick from which on other events may follow this one: its completion."""
        event, trigger = self.event(event_id), self.trigger_tick(event_id)
        if event is None or (event.trigger is not None and trigger is None):
            return None  # nobody has been told yet what some may do already
        if event.action is None:
            return self.due_tick(event_id)
        if isinstance(event.action, AgentAction):
            return self.completion_tick(event_id)
        if isinstance(event.action, UavAction):
            return self._flown_tick(event.action, self.action_tick(event_id, trigger or 0))
        return self.action_tick(event_id, trigger or 0)

    def _flown_tick(self, action: UavAction, begins: int | None) -> int | None:
        """Return when a UAV has done what it is told to.

        It is up where it climbs to, and has captured the mission that it changes to.
        """
        if begins is not None and action.mission is not None:
            return self.rules.captured(action.uav, action.mission)
        flight = self.rules.flights.get(action.uav)
        if begins is None or action.altitude_m is None or flight is None:
            return begins
        z_m = motion.altitude(self.view, self.view.body(action.uav))
        return first_tick(np.abs(z_m - action.altitude_m.value) <= CLIMBED_M, begins)

    def _on_carriageway(self, agent: str) -> BoolArray:
        points = self.view.reference(agent)[:, :2]
        return self.view.geometry.surfaces(SurfaceKind.DRIVING).contains(points)

    def begun_tick(self, event_id: str) -> int | None:
        """Return the tick at which the action of an event sets in, None when it never does.

        Who crosses has begun with the first step onto the carriageway.
        """
        event, due = self.event(event_id), self.due_tick(event_id)
        if event is None or (event.trigger is not None and due is None):
            return None
        action = event.action
        if isinstance(action, AgentAction) and action.do == 'cross':
            return first_tick(self._steps_on(action.agent), due or 0)
        return self.action_tick(event_id, due or 0)

    def _steps_on(self, person: str) -> BoolArray:
        """Return where a person steps onto the carriageway, (T,)."""
        on = self._on_carriageway(person)
        return np.concatenate(([False], on[1:] & ~on[:-1]))

    def _over_the_street(self, person: str, begins: int) -> int | None:
        """Return when a person has left the carriageway that it stepped onto."""
        on = self._on_carriageway(person)
        entered = first_tick(on, begins)
        if entered is None:
            return None
        points = self.view.reference(person)[:, :2]
        away_m = norm2_array(*(points - points[entered]).T)
        return first_tick(~on & (away_m >= CROSSED_M), entered)

    def completion_tick(self, event_id: str) -> int | None:
        """Return when what a ground agent is to do is complete, None when it never is."""
        event = self.event(event_id)
        due = self.due_tick(event_id)
        if event is None or not isinstance(event.action, AgentAction):
            return None
        begins = self.action_tick(event_id, due or 0)
        action, rules = event.action, self.rules.actions
        if rules is None or begins is None or not takes_time(action):
            return begins
        first = begins if due is None else due  # nobody states a trigger: what shows begins it
        body = self.view.body(action.agent)
        if action.do == 'change_lane':
            return change_is_over(self.view, body, first, action.side)
        if action.do == 'cross':
            return self._over_the_street(action.agent, begins)
        there = first_tick(~self.view.present(action.agent), first)
        speeds = motion.speed(self.view, body)[first:there]
        hold_ticks = whole_ticks(rules.stop_hold_s, self.view.dt_s)
        index = completion_index(action, speeds, hold_ticks, rules)
        return None if index is None else first + index

    def action_tick(
        self, event_id: str, start: int = 0, *, begins_there: bool = False
    ) -> int | None:
        """Return the first tick from `start` on at which the action of an event shows.

        Args:
            event_id: The event.
            start: Nothing before this tick counts.
            begins_there: What has been done since before `start` does not count either.
        """
        event = self.event(event_id)
        if event is None or event.action is None:
            return None
        if isinstance(event.action, SendMessage):
            sent = [
                message.sent_tick
                for message in messages(self.view, self.rules.links)
                if message.event == event_id and message.sent_tick >= start
            ]
            return min(sent, default=None)
        if isinstance(event.action, AgentAction):
            # Without a trigger it has to be seen: who stands all along has not stopped.
            done = event.trigger is not None
            if event.action.do == 'cross':
                return self._crosses(event, event.action, start)
            return self._agent_action(
                event.action, start, begins_there=begins_there, may_hold=done
            )
        return self._uav_action(event.action, start, begins_there=begins_there)

    def _uav_action(self, action: UavAction, start: int, *, begins_there: bool) -> int | None:
        if action.do == 'change_mission':
            own = [m.id for m in self.spec.missions if m.uav == action.uav]
            if action.mission not in own:
                return None
            phase = self.view.commands(self.view.body(action.uav))[:, UavCommandColumn.PHASE]
            wanted = phase == UavPhase.MISSION + own.index(action.mission)
            # A mission begins once: one that is flown already is not changed to.
            begins = first_tick(wanted)
            if begins is not None and begins > 0 and phase[begins - 1] == UavPhase.ASCENT:
                # Who stands on the ground takes off for it; in the ascent its goal is another.
                takeoff = int(np.argmax(phase == UavPhase.ASCENT))
                begins = takeoff if own[0] == action.mission else max(start, takeoff)
            return begins if begins is not None and begins >= start else None
        if action.do == 'ascend':
            uav = self.view.body(action.uav)
            rate = motion.climb_rate(self.view, uav)
            if action.altitude_m is not None and start < self.view.ticks:
                # To a lower altitude it goes down.
                z_m = float(motion.altitude(self.view, uav)[start])
                rate = -rate if action.altitude_m.value < z_m else rate
            return onset_tick(rate >= CLIMBS_MPS, start, begins_there=begins_there)
        flight = self.rules.flights.get(action.uav)
        tick = None if flight is None else flight.landing_tick
        return tick if tick is not None and tick >= start else None

    def _agent_action(
        self, action: AgentAction, start: int, *, begins_there: bool, may_hold: bool
    ) -> int | None:
        body = self.view.body(action.agent)
        speed = motion.speed(self.view, body)
        rules = self.rules.actions
        there = start < self.view.ticks and self.view.present(action.agent)[start]
        if (
            may_hold
            and rules is not None
            and there
            and holds_already(action, float(speed[start]), rules)
        ):
            return start
        if action.do == 'start' and rules is not None:
            return first_tick(speed > rules.start_mps, start)
        if action.do in ('brake', 'stop', 'slow', 'yield'):
            loss = motion.deceleration(self.view, body)
            least = self.rules.onset_mps2
            if action.do == 'brake':
                least = braking_mps2(action.deceleration_mps2, self.rules.brake_mps2, least)
            return onset_tick(loss >= least, start, begins_there=begins_there)
        if action.do in ('start', 'accelerate'):
            gain = -motion.deceleration(self.view, body)
            return onset_tick(gain >= self.rules.onset_mps2, start, begins_there=begins_there)
        return change_begins(self.view, body, start, action.side)

    def _crosses(self, event: Event, action: AgentAction, start: int) -> int | None:
        """Return when a person crosses: with the first step onto the carriageway.

        Whose wait is over does so with the first step towards it, and so did everybody in what
        was recorded before.
        """
        rules = self.rules.actions
        steps = first_tick(self._steps_on(action.agent), start)
        if steps is None or rules is None:
            return steps
        if rules.steps_on and not crosses_from_wait(self.spec, event):
            return steps
        before = max(0, start - 1)
        speed = motion.speed(self.view, self.view.body(action.agent))
        stood = np.flatnonzero(speed[before:steps] < rules.stop_mps)
        return before + int(stood[-1]) + 1 if len(stood) else steps

    def shows(self, action: AgentAction, begin: int) -> BoolArray:
        """Return where an action that takes speed off is seen to be done, (T,).

        Args:
            action: Stop: it stands; slow: as slow as it is to be; brake: it brakes as hard.
            begin: Tick from whose speed on it slows.
        """
        body, rules = self.view.body(action.agent), self.rules.actions
        speed = motion.speed(self.view, body)
        if rules is None or action.do not in ('brake', 'stop', 'slow'):
            return np.zeros(self.view.ticks, dtype=np.bool_)
        if action.do == 'brake':
            asked, usual = action.deceleration_mps2, self.rules.brake_mps2
            least = braking_mps2(asked, usual, self.rules.onset_mps2)
            return motion.deceleration(self.view, body) >= least
        if action.do == 'stop':
            return speed < rules.stop_mps
        goal = speed_goal(action, float(speed[begin]), rules)
        assert goal is not None  # who slows has one
        return speed <= goal.value_mps + goal.tolerance_mps

    def _first(self, event: Event) -> int | None:
        trigger = event.trigger
        view = self.view
        match trigger:
            case EventDoneTrigger():
                begun = trigger.on == 'event_begun'
                done = (self.begun_tick if begun else self.done_tick)(trigger.event)
                if done is None:
                    return None
                after_s = trigger.after_s.value if trigger.after_s is not None else 0.0
                after_s = max(after_s, rest_s(self.spec, event, self.rules.actions))
                tick = done + whole_ticks(after_s, view.dt_s)
                return tick if tick < view.ticks else None
            case BehaviorDoneTrigger():
                return done_tick(view, self.spec, trigger, self.rules.actions)
            case MissionDoneTrigger():
                if is_next_anyway(event):
                    return self.action_tick(event.id)
                flight = self.rules.flights.get(trigger.uav)
                return None if flight is None else flight.over_tick
            case MessageTrigger():
                received = [
                    message.delivered_tick
                    for message in messages(view, self.rules.links)
                    if message.receiver == trigger.by
                    and trigger.sender in (None, message.sender)
                    and message.delivered_tick is not None
                    and message.delivered_tick < view.ticks
                ]
                return min(received, default=None)
            case None:
                return None
            case _:
                mask = trigger_series(view, trigger, self.rules)
                if mask is None:
                    return None
                start = self._counts_from(event)
                if start is None:
                    return None
                if needs_change(trigger):
                    before = first_tick(self._before_change(trigger, mask), start)
                    if before is None:
                        return None
                    start = before
                return first_tick(mask, start)

    def _counts_from(self, event: Event) -> int | None:
        """Return the tick from which on a trigger counts, None where that never comes."""
        action = event.action
        if isinstance(action, UavAction) and counts_from_capture(self.spec, event):
            return self.rules.captured(action.uav, None)
        return 0

    def _before_change(self, trigger: StateTrigger, mask: BoolArray) -> BoolArray:
        """Return where a change can still come: it does not hold, or what is lost was seen."""
        if not isinstance(trigger, VisibilityTrigger):
            return ~mask
        seen = trigger.model_copy(update={'on': 'visible'})
        sight = trigger_series(self.view, seen, self.rules)
        assert sight is not None  # an observer and a target are no places
        return sight
