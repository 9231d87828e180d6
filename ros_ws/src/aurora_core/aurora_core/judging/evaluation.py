# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What an evaluator gives back, and what it works with."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import numpy as np
import numpy.typing as npt

from aurora_core.comm.reach import Reach, reach_of
from aurora_core.errors import VerificationError
from aurora_core.outcomes.condition import ClimbArguments, Condition, MissionArguments, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.ledger import LinkModel, Message, messages
from aurora_core.quantities.phases import (
    FlightPhases,
    MissionPhase,
    flight_phases,
    mission_phase,
    missions_end_tick,
)
from aurora_core.quantities.routes import AlongRoute, along_route
from aurora_core.quantities.sight import SightSeries, sight_series
from aurora_core.quantities.state_triggers import EventRules
from aurora_core.quantities.ticks import first_tick, whole_ticks
from aurora_core.quantities.triggers import EventTimes
from aurora_core.quantities.view import RunView
from aurora_core.spec.scenario import Link, ScenarioSpec
from aurora_core.trace.layout import UavCommandColumn, UavPhase

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
TickArray = npt.NDArray[np.intp]


class Later(StrEnum):
    """What may still happen to a measurement while the run goes on."""

    SAMPLES = 'samples'  # more samples follow, those that are there stay
    RISES = 'rises'  # the value grows or stays
    FALLS = 'falls'  # the value falls or stays
    COUNTS = 'counts'  # a share of samples, of which more follow
    ANY = 'any'  # anything


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured:
    """Samples of a condition's signal.

    Attributes:
        ticks: (n,) tick of each sample, n >= 1.
        values: (n,) finite values, in the condition's unit.
        story: What happened, with numbers; empty: the monitor describes the worst sample.
        worst_tick: Tick that decides, where that is not the tick of the deciding sample.
        label: What a sample is about (the pair that is closest, ...), by tick.
        place_of: Body whose position is the worst place; default: the first one of `of`.
        plot: Ticks and values of the signal behind a share, for pictures.
        evidence: Topics that were used.
        later: How it may change while what it is about goes on.
        provisional: What it is about goes on until the end of the run.
        held: (m,) of a share: at which of the samples in `plot` it held.
    """

    ticks: TickArray
    values: FloatArray
    story: str = ''
    worst_tick: int | None = None
    label: Callable[[int], str] | None = None
    place_of: str | None = None
    plot: tuple[TickArray, FloatArray] | None = None
    evidence: tuple[str, ...] = ()
    later: Later = Later.SAMPLES
    provisional: bool = False
    held: BoolArray | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Missing:
    """There are no samples to judge."""

    reason: Reason
    story: str
    tick: int | None = None


Evaluation = Measured | Missing


def at_tick(
    tick: int,
    value: float,
    story: str = '',
    evidence: tuple[str, ...] = (),
    *,
    later: Later = Later.ANY,
    provisional: bool = False,
) -> Measured:
    """Return the measurement of one number at one tick."""
    return Measured(
        ticks=np.array([tick], dtype=np.intp),
        values=np.array([value], dtype=np.float64),
        story=story,
        evidence=evidence,
        later=later,
        provisional=provisional,
    )


class Context:
    """A run, its specification, and what several conditions ask for, worked out once.

    Args:
        view: The run.
        spec: Its specification.
        conditions: All conditions of the run.
        ended: Judge the run as if it had been finished with its last tick.

    Attributes:
        kept: What was measured last for each condition that was judged, by its id.
    """

    def __init__(
        self,
        view: RunView,
        spec: ScenarioSpec,
        conditions: tuple[Condition, ...],
        *,
        ended: bool = False,
    ) -> None:
        self._ended = ended
        self.kept: dict[str, Evaluation] = {}
        self.view = view
        self.spec = spec
        self.conditions = conditions
        self._flights: dict[tuple[str, float], FlightPhases] = {}
        self._phases: dict[tuple[str, str], MissionPhase] = {}

    def time_s(self, tick: int) -> float:
        """Return the simulated time of a tick."""
        return tick * self.view.dt_s

    def complete(self, condition: Condition) -> bool:
        """Tell whether the run was recorded to its end."""
        return self._ended or self.view.complete(condition.arguments.horizon_s)

    def flight(self, mission: MissionArguments, touchdown_m: float) -> FlightPhases:
        """Return the phases of the flight that a mission belongs to."""
        key = (mission.uav, touchdown_m)
        if key not in self._flights:
            self._flights[key] = flight_phases(
                self.view,
                self.view.body(mission.uav),
                mission.first_altitude_m,
                mission.first_altitude_tolerance_m,
                touchdown_m,
            )
        return self._flights[key]

    def phase(self, mission: MissionArguments, touchdown_m: float) -> MissionPhase:
        """Return the phase of a mission."""
        key = (mission.uav, mission.mission)
        if key not in self._phases:
            self._phases[key] = mission_phase(
                self.view,
                self.view.body(mission.uav),
                mission.index,
                self.flight(mission, touchdown_m),
                mission.capture_rule,
                self.position(mission, grace=False),
            )
        return self._phases[key]

    def position(self, mission: MissionArguments, *, grace: bool = True) -> FloatArray:
        """Return where a UAV is, (T, 3) ENU metres, as its mission counts heights.

        Climbs that an event asks for are taken off: who is where the climb leads is as high as
        the mission asks for.

        Args:
            mission: Whose heights.
            grace: While there is still time for a climb no height is wrong.
        """
        uav = self.view.body(mission.uav)
        point = self.view.reference(uav.body_id)
        begun = self._climbs(mission)
        if not begun:
            return point
        heights = point[:, 2].copy()
        for tick, _, climb in begun:
            # At its first tick it is as high as before: that may be what it has waited for.
            later = tick + 1
            heights[later:] = point[later:, 2] - climb.altitude_m + mission.altitude_m
            settled = tick + whole_ticks(climb.within_s, self.view.dt_s) if grace else later
            heights[later:settled] = mission.altitude_m
        return np.column_stack((point[:, :2], heights))

    def left_early(self, mission: MissionArguments, touchdown_m: float) -> int | None:
        """Return when an event takes a UAV from its altitude that has not captured there before.

        None where none does.
        """
        if mission.level_from is not None:
            return None  # what it keeps is no altitude of its own
        begun = self._climbs(mission)
        if not begun:
            return None
        uav, flight = self.view.body(mission.uav), self.flight(mission, touchdown_m)
        own = mission_phase(self.view, uav, mission.index, flight, mission.capture_rule)
        captured = own.capture_tick is not None and own.capture_tick <= begun[0][0]
        return None if captured else begun[0][0]

    def _climbs(self, mission: MissionArguments) -> list[tuple[int, str, ClimbArguments]]:
        """Return the climbs that begin while a mission is flown, with their ticks, in order."""
        return sorted(
            (tick, climb.event, climb)
            for climb in mission.climbs
            if (tick := self._climb_tick(climb, mission)) is not None
        )

    def _climb_tick(self, climb: ClimbArguments, mission: MissionArguments) -> int | None:
        """Return when a climb begins, None where it does not while this mission is flown.

        What is asked for during the ascent is done with the first mission. Who keeps the altitude
        of a mission before keeps what has been asked for since that.
        """
        due = self.events.due_tick(climb.event)
        tick = None if due is None else self.events.action_tick(climb.event, due)
        if tick is None:
            return None
        phase = self.view.commands(self.view.body(mission.uav))[:, UavCommandColumn.PHASE]
        flown = UavPhase.MISSION + mission.index
        since = flown if mission.level_from is None else UavPhase.MISSION + mission.level_from
        before = {UavPhase.ASCENT: since, UavPhase.HOLDING: since + 1}
        if phase[tick] not in before:
            return tick if since <= phase[tick] <= flown else None
        # It goes into the mission that is flown next.
        then = first_tick(phase != phase[tick], tick)
        counts = then is not None and before[phase[tick]] <= phase[then] <= flown
        return tick if counts else None

    def sight(self, observer: str, target: str) -> SightSeries:
        """Return the sight of a target from a UAV."""
        return sight_series(self.view, observer, target)

    def along(self, follower: str, leader: str) -> AlongRoute:
        """Return progress of a leader over a follower."""
        return along_route(self.view, self.view.body(follower), self.view.body(leader))

    @cached_property
    def links(self) -> tuple[LinkModel, ...]:
        """Links of the specification with the limits in force."""
        limits = self.view.world.limits
        return tuple(_model(link, reach_of(link, limits)) for link in self.spec.links)

    @cached_property
    def messages(self) -> tuple[Message, ...]:
        """Messages of the ledger."""
        return messages(self.view, self.links)

    @cached_property
    def missions_end(self) -> int:
        """Tick at which the last mission ends."""
        return missions_end_tick(self.view)

    @cached_property
    def mission_arguments(self) -> tuple[MissionArguments, ...]:
        """All missions that the conditions know of, by their own conditions."""
        found: dict[str, MissionArguments] = {}
        for condition in self.conditions:
            for mission in (condition.arguments.mission, *condition.arguments.missions):
                if mission is not None:
                    found.setdefault(mission.mission, mission)
        return tuple(found.values())

    @cached_property
    def events(self) -> EventTimes:
        """Recomputed moments of the events."""
        touchdown_m = self.conditions[0].arguments.touchdown_m if self.conditions else 0.0
        flights = {
            mission.uav: self.flight(mission, touchdown_m) for mission in self.mission_arguments
        }
        moments = next(
            (
                c.arguments.event_tolerances
                for c in self.conditions
                if c.arguments.event_tolerances is not None
            ),
            None,
        )
        rules = EventRules(
            brake_mps2=moments.brake_mps2 if moments is not None else 0.0,
            arrival_m=moments.arrival_m if moments is not None else 0.0,
            crosswalk_m=moments.crosswalk_m if moments is not None else None,
            onset_mps2=moments.onset_mps2 if moments is not None else 0.0,
            actions=moments.actions if moments is not None else None,
            flights=flights,
            captured=self._captured,
            links=self.links,
            touchdown_m=touchdown_m,
        )
        return EventTimes(self.view, self.spec, rules)

    def _captured(self, uav: str, mission: str | None) -> int | None:
        """Return when a UAV has captured a mission, None: its first one, at its stated height."""
        touchdown_m = self.conditions[0].arguments.touchdown_m
        own = [m.id for m in self.spec.missions if m.uav == uav]
        index = 0 if mission is None else own.index(mission) if mission in own else -1
        flown = (m for m in self.mission_arguments if (m.uav, m.index) == (uav, index))
        asked = next(flown, None)
        if asked is None:
            return None
        flight, body = self.flight(asked, touchdown_m), self.view.body(uav)
        phase = mission_phase(self.view, body, index, flight, asked.capture_rule)
        return phase.capture_tick

    def window(self, condition: Condition, after_s: float = 0.0) -> TickArray | Missing:
        """Return the ticks that a condition is about, or why there are none.

        Args:
            condition: Whose window.
            after_s: Samples before this time do not count.
        """
        arguments = condition.arguments
        match arguments.window:
            case Window.START:
                return np.zeros(1, dtype=np.intp)
            case Window.RUN:
                ticks = np.arange(self.view.ticks, dtype=np.intp)
                return self._unless_cut(condition, ticks, after_s, decided=False)
            case Window.MISSIONS:
                ticks = np.arange(self.missions_end, dtype=np.intp)
                ended = self.missions_end < self.view.ticks
                return self._unless_cut(condition, ticks, after_s, decided=ended)
            case Window.AIRBORNE:
                mask = np.zeros(self.view.ticks, dtype=np.bool_)
                for name in condition.of:
                    if self.view.has(name) and self.view.body(name).is_uav:
                        uav = self.view.body(name)
                        mask |= motion.airborne(self.view, uav, arguments.touchdown_m)
                return self._unless_cut(condition, np.flatnonzero(mask), after_s, decided=False)
            case Window.TO_THE_END:
                return self._to_the_end(condition)
            case Window.PHASE:
                if arguments.mission is None:
                    raise VerificationError(f'condition {condition.id} names no mission')
                return self._phase_ticks(condition, arguments.mission)
            case Window.ON_MISSION:
                parts = [self._phase_ticks(condition, m) for m in arguments.missions]
                missing = next((part for part in parts if isinstance(part, Missing)), None)
                if missing is not None:
                    return missing
                # Phases of two UAVs overlap: a tick counts once.
                return np.unique(
                    np.concatenate([part for part in parts if not isinstance(part, Missing)])
                )
            case Window.MOMENT:
                raise VerificationError(f'condition {condition.id} has no window of samples')

    def _to_the_end(self, condition: Condition) -> TickArray | Missing:
        """Return the ticks from the first command of a UAV's last mission on."""
        last = max(condition.arguments.missions, key=lambda mission: mission.index)
        begin = self.phase(last, condition.arguments.touchdown_m).command_tick
        ticks = np.arange(self.view.ticks if begin is None else begin, self.view.ticks)
        return self._unless_cut(condition, ticks, 0.0, decided=False)

    def _unless_cut(
        self, condition: Condition, ticks: TickArray, after_s: float, *, decided: bool
    ) -> TickArray | Missing:
        if not decided and not self.complete(condition):
            return self.short(condition)
        ticks = ticks[ticks >= whole_ticks(after_s, self.view.dt_s)]
        if len(ticks) == 0:
            return Missing(reason=Reason.EMPTY_PHASE, story='there is no sample to judge')
        return ticks

    def short(self, condition: Condition) -> Missing:
        """Return that the record ends too early for a condition."""
        end_s = self.time_s(self.view.ticks - 1)
        return Missing(
            reason=Reason.TRACE_SHORT,
            story=f'the record ends at {end_s:.2f} s, before this can be decided',
        )

    def _phase_ticks(self, condition: Condition, mission: MissionArguments) -> TickArray | Missing:
        phase = self.phase(mission, condition.arguments.touchdown_m)
        missing = self.phase_missing(condition, mission)
        if missing is not None:
            return missing
        assert phase.capture_tick is not None  # nothing is missing
        return np.arange(phase.capture_tick, phase.stop_tick, dtype=np.intp)

    def phase_missing(self, condition: Condition, mission: MissionArguments) -> Missing | None:
        """Return why the phase of a mission cannot be judged, None when it can."""
        phase = self.phase(mission, condition.arguments.touchdown_m)
        over = phase.end_tick is not None or self.complete(condition)
        if phase.capture_tick is not None:
            return None if over else self.short(condition)
        if mission.target is not None and self.view.has(mission.target):
            # What happens to it after the phase has not kept the UAV from capturing it.
            absent = np.flatnonzero(~self.view.present(mission.target)[: phase.stop_tick])
            if len(absent):
                gone_s = self.time_s(int(absent[0]))
                return Missing(
                    reason=Reason.TARGET_GONE,
                    story=f'{mission.target} left the simulation at {gone_s:.2f} s, before '
                    f'{mission.uav} had captured it',
                    tick=int(absent[0]),
                )
        if not over:
            return self.short(condition)
        flight = self.flight(mission, condition.arguments.touchdown_m)
        what = 'never took off' if flight.takeoff_tick is None else 'never captured'
        if flight.takeoff_tick is not None and flight.ascent_end_tick is None:
            what = 'never reached its altitude'
        return Missing(
            reason=Reason.EMPTY_PHASE, story=f'{mission.uav} {what} in {mission.mission}'
        )

    def together_until(self, condition: Condition) -> int | Missing:
        """Return the tick before which all bodies of a condition exist, for what happens once.

        What has happened by then stays true when one of them leaves.
        """
        there = np.ones(self.view.ticks, dtype=np.bool_)
        for name in condition.of:
            there &= self.view.present(name)
        end = first_tick(~there)
        if end == 0:
            names = ' and '.join(condition.of)
            story = f'{names}: not in the simulation at t = 0'
            return Missing(reason=Reason.TARGET_GONE, story=story, tick=0)
        return self.view.ticks if end is None else end

    def with_bodies(self, condition: Condition, ticks: TickArray) -> TickArray | Missing:
        """Return the ticks to judge: all of them, with all bodies of the condition there.

        Of what has to hold at some time (a stretch, a deadline) those before one of them leaves.
        """
        if condition.hold_s is None and condition.by_s is None:
            gone = self.gone(condition, ticks)
            return ticks if gone is None else gone
        end = self.together_until(condition)
        if isinstance(end, Missing):
            return end
        before = ticks[ticks < end]
        if len(before):
            return before
        gone = self.gone(condition, ticks)
        assert gone is not None  # no tick is left because somebody is absent
        return gone

    def gone(self, condition: Condition, ticks: TickArray) -> Missing | None:
        """Return that a body of a condition is absent at one of the ticks, None when all exist."""
        for name in condition.of:
            absent = ticks[~self.view.present(name)[ticks]]
            if len(absent):
                gone_s = self.time_s(int(absent[0]))
                return Missing(
                    reason=Reason.TARGET_GONE,
                    story=f'{name} is not in the simulation at {gone_s:.2f} s',
                    tick=int(absent[0]),
                )
        return None


def _model(link: Link, reach: Reach) -> LinkModel:
    return LinkModel(
        link_id=link.id,
        sender=link.sender,
        receiver=link.receiver,
        loss=link.loss.value,
        latency_s=link.latency_s.value,
        retransmissions=int(link.retransmissions.value),
        interval_s=link.retransmission_interval_s.value,
        range_sight_m=reach.sight_m,
        range_blocked_m=reach.blocked_m,
        fades=reach.decade_db > 0.0,
        outage_s=link.outage,
        reports=link.rate_hz is not None,
    )


def ground_topics(condition: Condition) -> tuple[str, ...]:
    """Return the evidence of a condition that rests on the states of its ground agents."""
    return tuple(f'ground/state[{name}]' for name in condition.of)
