# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Executors with planted bugs: each does or tells something wrong while it runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from aurora_core.comm.link import MessageLink, Path
from aurora_core.execution.events import EventRunner, Note
from aurora_core.execution.observe import Observation
from aurora_core.execution.scenario_executor import ScenarioExecutor
from aurora_core.execution.step_output import StepOutput, Stepper
from aurora_core.mission.machine import MissionMachine, TargetMotion
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.outcomes.grounded import ReleaseOn
from aurora_core.spec.scenario import DistanceTrigger, Event, EventDoneTrigger
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import UavPhase
from aurora_core.trace.records import LinkEventKind, LinkRecord
from aurora_system_tests.sabotage import (
    Sabotage,
    with_agents,
    with_links,
    with_machines,
    with_runner,
)

FloatArray = npt.NDArray[np.float64]
Machines = Sequence[MissionMachine]

# What the honest executor finds when it is stepped over the states of a run.
BY_RECOMPUTATION = frozenset({'finding:command', 'finding:claim'})

# Runs that end verified when nothing is planted.
PROMPTS = {
    'convoy': (
        'A bus drives ahead of the ego car and an ambulance follows behind it while two '
        'background cars circulate; a drone tracks the bus from 35 meters.'
    ),
    'tailgate': (
        'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the '
        'ego when the van comes within 20 meters.'
    ),
    'hover': 'A drone hovers at 20 meters for 5 seconds.',
    'landmark': 'A drone hovers over City Hall at 50 m for 20 seconds.',
    'circle': 'A drone circles the bus at 40 meters.',
    'loss': (
        'A drone hovers at 30 meters; after 15 seconds the drone sends a message to the ego car '
        'over a link with 60% loss and 200 ms latency.'
    ),
    'two missions': (
        'A drone hovers at 30 meters for 10 seconds, then tracks the ego car for 20 seconds.'
    ),
}

_LATE_TICKS = 20
_EARLY_M = 8.0
_UNSEEN_TICK = 400
_AGAIN_TICKS = 40


class _LateRunner(EventRunner):
    """Every trigger a second late."""

    def _begins(
        self, event: Event, tick: int, dt_s: float, seen: Observation, machines: Machines
    ) -> bool:
        held = self.__dict__.setdefault('_since', {})
        if event.id not in held and super()._begins(event, tick, dt_s, seen, machines):
            held[event.id] = tick
        return event.id in held and tick >= held[event.id] + _LATE_TICKS


class _EarlyRunner(EventRunner):
    """Every distance is taken for a smaller one."""

    def _begins(
        self, event: Event, tick: int, dt_s: float, seen: Observation, machines: Machines
    ) -> bool:
        if isinstance(event.trigger, DistanceTrigger):
            value = event.trigger.value_m
            farther = dict(value) | {'value': value.value + _EARLY_M}
            trigger = dict(event.trigger) | {'value_m': farther}
            event = Event.model_validate(dict(event) | {'trigger': trigger})
        return super()._begins(event, tick, dt_s, seen, machines)


class _TardyRunner(EventRunner):
    """Takes the end of what somebody does for its beginning."""

    def _begins(
        self, event: Event, tick: int, dt_s: float, seen: Observation, machines: Machines
    ) -> bool:
        if isinstance(event.trigger, EventDoneTrigger):
            done = dict(event.trigger) | {'on': 'event_done'}
            event = Event.model_validate(dict(event) | {'trigger': done})
        return super()._begins(event, tick, dt_s, seen, machines)


class _BlindRunner(EventRunner):
    """Reports at some time what it has never seen."""

    def _begins(
        self, event: Event, tick: int, dt_s: float, seen: Observation, machines: Machines
    ) -> bool:
        return tick >= _UNSEEN_TICK

    def _allowed(self, event: Event, seen: Observation, machines: Machines) -> bool:
        return True


class _RepeatingRunner(EventRunner):
    """Does everything again after two seconds."""

    def step(
        self, tick: int, dt_s: float, seen: Observation, machines: Machines, note: Note
    ) -> list[GroundCommand]:
        for state in self._states:
            first = state.triggered_tick
            if state.done and first is not None and tick == first + _AGAIN_TICKS:
                state.done = state.acted = False
        return super().step(tick, dt_s, seen, machines, note)


class _SkippingMachine(MissionMachine):
    """Leaves out its first mission."""

    def _begin(self, phase: int) -> None:
        super()._begin(phase + 1 if phase == UavPhase.MISSION else phase)


class _FloatingMachine(MissionMachine):
    """Calls itself landed while it stands in the air."""

    def _fly_home(self, state: list[float], target: TargetMotion | None) -> None:
        self.landed = True

    def _command(self, state: list[float]) -> FloatArray:
        landed, self.landed = self.landed, False
        row = super()._command(state)
        self.landed = landed
        return row


class _HastyMachine(MissionMachine):
    """Takes every sample for the capture."""

    def _meets(
        self,
        mission: MissionPlan,
        state: list[float],
        goal: tuple[float, float, float],
        target: TargetMotion | None,
    ) -> bool:
        return True


class _ForgingLink(MessageLink):
    """Loses everything and tells of a receipt in the end."""

    def step(
        self, tick: int, path: Callable[[], Path], next_sequence: Callable[[], int]
    ) -> list[LinkRecord]:
        self._loss_at = lambda _tick: 1.0
        return [
            replace(r, kind=LinkEventKind.DELIVERED) if r.kind is LinkEventKind.FAILED else r
            for r in super().step(tick, path, next_sequence)
        ]


class _SilentLink(MessageLink):
    """Never tells of a receipt."""

    def step(
        self, tick: int, path: Callable[[], Path], next_sequence: Callable[[], int]
    ) -> list[LinkRecord]:
        records = super().step(tick, path, next_sequence)
        return [r for r in records if r.kind is not LinkEventKind.DELIVERED]


class _GivingUpLink(MessageLink):
    """Does not send again what was lost."""

    def step(
        self, tick: int, path: Callable[[], Path], next_sequence: Callable[[], int]
    ) -> list[LinkRecord]:
        records = super().step(tick, path, next_sequence)
        if any(r.kind is LinkEventKind.ATTEMPT_LOST for r in records):
            self._messages.clear()
        return records


class _SeeingEverything:
    """Claims to see whatever it looks for."""

    def __init__(self, executor: ScenarioExecutor) -> None:
        self._executor = executor

    def step(self, tick: int, ground: FloatArray, uav: FloatArray) -> StepOutput:
        output = self._executor.step(tick, ground, uav)
        return output._replace(sights=tuple(replace(s, visible=True) for s in output.sights))


def _lower(plan: UavPlan) -> UavPlan:
    """Plan to fly at three fifths of the altitude."""
    document = plan.model_dump()
    for mission in document['missions']:
        mission['altitude_m'] *= 0.6
        if mission['hover_point'] is not None:
            x, y, z = mission['hover_point']
            mission['hover_point'] = (x, y, 0.6 * z)
    return UavPlan.model_validate(document)


def _home_again(plan: UavPlan) -> UavPlan:
    """Plan to hover over the start where the UAV is to stay where it is."""
    missions = tuple(
        m
        if m.is_placed
        else m.model_copy(
            update={
                'hover_point': (plan.home_x_m, plan.home_y_m, m.altitude_m),
                'rest_mps': None,
            }
        )
        for m in plan.missions
    )
    return plan.model_copy(update={'missions': missions})


def _straight(plan: UavPlan) -> UavPlan:
    """Plan to fly straight to what is to be come to from above."""
    missions = tuple(m.model_copy(update={'over_m': None}) for m in plan.missions)
    return plan.model_copy(update={'missions': missions})


def _slanting(plan: UavPlan) -> UavPlan:
    """Plan to climb and sink on the way, and not before it."""
    missions = tuple(m.model_copy(update={'level_way': False}) for m in plan.missions)
    return plan.model_copy(update={'missions': missions})


def _at_full_speed(plan: UavPlan) -> UavPlan:
    """Plan to fly routes 1 m/s faster."""
    missions = tuple(m.model_copy(update={'speed_mps': m.speed_mps + 1.0}) for m in plan.missions)
    return plan.model_copy(update={'missions': missions})


def _never_let_up(executor: ScenarioExecutor) -> Stepper:
    """Let who was as fast as is waited for stay as fast."""
    executor._premises._fast.clear()
    return executor


def _half_the_time(executor: ScenarioExecutor) -> Stepper:
    """Let who is to stand for a time drive on after half of it."""
    agents = tuple(
        a if a.stop_s is None else a.model_copy(update={'stop_s': 0.5 * a.stop_s})
        for a in executor._setup.agents
    )
    other = ScenarioExecutor(replace(executor._setup, agents=agents))
    other._standing._until = {k: tick // 2 for k, tick in other._standing._until.items()}
    return other


def _over_too_soon(executor: ScenarioExecutor) -> Stepper:
    """Take what somebody does for some time for over after half of it."""
    for watch in executor._runner._progress.doing.values():
        watch._need //= 2
    return executor


def _leave_it_behind(executor: ScenarioExecutor) -> Stepper:
    """Let nobody keep to those beside it."""
    executor._follower._following.clear()
    return executor


def _stand_back(executor: ScenarioExecutor) -> Stepper:
    """Let nobody walk up to the kerb before he is told to cross."""
    executor._held |= executor._walking_up.keys()
    executor._walking_up.clear()
    return executor


def _after_the_ambulance(plan: UavPlan) -> UavPlan:
    document = plan.model_dump()
    for mission in document['missions']:
        mission['target'] = 'ambulance1'
    return UavPlan.model_validate(document)


@dataclass(frozen=True, kw_only=True)
class Planted:
    """One planted bug.

    Attributes:
        name: What the executor does wrong.
        prompt: That it runs.
        names: What counts as having found it, see `local_runs.names_of`.
    """

    name: str
    prompt: str
    sabotage: Sabotage
    names: frozenset[str]


_UNSEEN = (
    'A drone tracks the ego car from 30 meters altitude and alerts the ego when it sees a truck.'
)


def _planted(name: str, prompt: str, sabotage: Sabotage, *names: str) -> Planted:
    return Planted(
        name=name, prompt=PROMPTS.get(prompt, prompt), sabotage=sabotage, names=frozenset(names)
    )


PLANTED = (
    _planted('trigger late by 1 s', 'tailgate', with_runner(_LateRunner), 'finding:event'),
    _planted(
        'trigger early',
        'tailgate',
        with_runner(_EarlyRunner),
        'finding:event',
        'condition:e1.not_before',
    ),
    _planted(
        'alert of what was never seen',
        _UNSEEN,
        with_runner(_BlindRunner),
        'finding:event',
        'condition:e1.actor_visible',
    ),
    _planted('event done twice', 'tailgate', with_runner(_RepeatingRunner), 'finding:event'),
    _planted('delivery forged', 'loss', with_links(_ForgingLink), 'finding:message'),
    _planted('delivery never recorded', 'tailgate', with_links(_SilentLink), 'finding:message'),
    _planted(
        'retransmission missing',
        'loss',
        with_links(_GivingUpLink),
        'finding:message',
        'condition:e1.delivered',
    ),
    _planted(
        'message to another receiver',
        'tailgate',
        with_links(MessageLink, receiver='van1'),
        'finding:message',
    ),
    _planted('sight through buildings', 'circle', _SeeingEverything, 'finding:sight'),
    _planted(
        'mission skipped',
        'two missions',
        with_machines(_SkippingMachine),
        'condition:m1.order',
        'condition:m1.completed',
    ),
    _planted(
        'altitude too low',
        'hover',
        with_machines(plan=_lower),
        'condition:m1.order',
        'condition:m1.altitude',
    ),
    _planted('landing skipped', 'hover', with_machines(_FloatingMachine), 'condition:uav1.landed'),
    _planted(
        'another target tracked',
        'convoy',
        with_machines(plan=_after_the_ambulance),
        'condition:m1.tracked',
    ),
    _planted(
        'straight into a stadium',
        'A drone hovers over Eastgate Stadium at 15 m for 20 s.',
        with_machines(plan=_straight),
        'condition:safety.clearance.uav1',
        'condition:safety.collision.uav1',
    ),
    _planted(
        'climbs on its way',
        'A drone hovers over the market at 30 m for 5 s, then flies to City Hall at 80 m.',
        with_machines(plan=_slanting),
        'condition:m2.way_altitude',
    ),
    _planted(
        'elsewhere instead of where it is',
        'A drone tracks the ego car for 20 seconds, then hovers for 10 seconds.',
        with_machines(plan=_home_again),
        'condition:m2.drift',
    ),
    _planted(
        'faster than a stated bound',
        'A UAV flies a 400 by 200 m rectangle at 100 m and 18 m/s. The speed of the UAV stays '
        'below 18 m/s.',
        with_machines(plan=_at_full_speed),
        'condition:c1.holds',
    ),
    _planted(
        'a fast target never lets up',
        'A drone tracks the blue car at 40 m altitude. When the blue car goes faster than 70 '
        'km/h, the drone reports to a police car.',
        _never_let_up,
        'condition:m1.tracked',
    ),
    _planted(
        'stops for too short a time',
        'A truck stops for 12 seconds. A drone tracks the truck.',
        _half_the_time,
        'condition:truck1.stop',
    ),
    _planted(
        'waits for too short a time',
        'A van waits for 14 seconds. A drone hovers at 30 meters for 10 seconds.',
        _half_the_time,
        'condition:van1.wait',
    ),
    _planted(
        'waits for the other kerb',
        'When a pedestrian steps onto the road, the ego car brakes.',
        with_runner(_TardyRunner),
        'condition:e2.within',
    ),
    _planted(
        'held until it is to brake',
        'The drone follows the ego car. When it sees a truck, the ego car brakes hard.',
        with_agents(release=ReleaseOn.CAPTURED, release_uav='uav1', release_mission='m1'),
        'condition:e1.moving',
    ),
    _planted(
        'sets off when he is to step onto the road',
        'A pedestrian crosses the street at 20 seconds. A drone tracks the ego car.',
        _stand_back,
        'condition:e1.within',
        'condition:e1.time',
    ),
    _planted(
        'goes on before the time is over',
        'A car drives at 10 m/s for 20 s and then accelerates to 15 m/s.',
        _over_too_soon,
        'condition:e1.within',
        'condition:car1.drive.time',
    ),
    _planted(
        'beside somebody at the start only',
        'A truck drives at 7 m/s. A motorcycle drives beside the truck.',
        _leave_it_behind,
        'condition:motorcycle1.placed.kept',
    ),
    _planted(
        'capture taken too early',
        'landmark',
        with_machines(_HastyMachine),
        'condition:m1.completed',
        'condition:m1.duration',
    ),
)
