# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Requests with their plans and synthetic runs: the situations of the paper's prompts."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass, replace
from functools import cache, wraps
from itertools import pairwise
from typing import ParamSpec

import numpy as np
from trace_builder import (
    DT_S,
    LIMITS,
    TOLERANCES,
    FloatArray,
    Run,
    driver,
    flight,
    number,
    world,
)

from aurora_core.conditions.derive import derive_conditions
from aurora_core.knowledge.world import WorldModel
from aurora_core.monitor.verify import verify
from aurora_core.outcomes.schedule import MissionFacts, PlanFacts
from aurora_core.outcomes.verdict import ConditionResult, Verdict
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import (
    Behavior,
    DistanceTrigger,
    Event,
    GroundAgent,
    Link,
    Placement,
    ScenarioSpec,
    SendMessage,
    Uav,
    UavMission,
)
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode, Pattern, Relation
from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason, ScenarioEventKind


@dataclass
class Case:
    """A request, its plan, a world and a run."""

    spec: ScenarioSpec
    facts: PlanFacts
    world: WorldModel
    run: Run


_Given = ParamSpec('_Given')


def _flown_once(make: Callable[_Given, Case]) -> Callable[_Given, Case]:
    """Fly a case once in a process; whoever asks gets a run of his own, to alter it."""
    flown: Callable[..., Case] = cache(make)

    @wraps(make)
    def made(*args: _Given.args, **kwargs: _Given.kwargs) -> Case:
        try:
            case = flown(*args, **kwargs)
        except TypeError:  # of an array, or another value that is no key
            return make(*args, **kwargs)
        return replace(case, run=deepcopy(case.run))

    return made


def mission(id: str, mode: MissionMode, **values: object) -> UavMission:
    """A mission of uav1 with the contract's defaults."""
    base: dict[str, object] = {'id': id, 'uav': 'uav1', 'mode': mode, 'altitude_m': number(30.0)}
    if mode is MissionMode.TRACK:
        base['standoff_m'] = number(0.0)
    if mode is MissionMode.NAVIGATE:
        base |= {'speed_mps': number(8.0, Unit.METRE_PER_SECOND), 'pattern': Pattern.RECTANGLE}
    else:
        base['duration_s'] = number(30.0, Unit.SECOND)
    return UavMission.model_validate(base | values)


def agent(id: str, type: str, **values: object) -> GroundAgent:
    """A ground agent."""
    return GroundAgent.model_validate({'id': id, 'type': type} | values)


def spec(**values: object) -> ScenarioSpec:
    """A specification; its prompt is long enough for the spans of the tests."""
    return ScenarioSpec.model_validate({'prompt': 'test ' * 20} | values)


def ramp(ticks: int, start: int, top: float, acceleration: float = 2.0) -> FloatArray:
    """Speed that is 0 up to tick `start` and then rises to `top`."""
    after = np.maximum(np.arange(ticks) - start, 0) * DT_S * acceleration
    return np.minimum(after, top)


def alert_link() -> Link:
    """uav1 to ego with the contract's defaults."""
    return Link(
        id='l1',
        sender='uav1',
        receiver='ego',
        loss=number(0.0, Unit.ONE),
        latency_s=number(0.1, Unit.SECOND),
        retransmissions=number(3.0, Unit.ONE),
        retransmission_interval_s=number(0.2, Unit.SECOND),
    )


def message(
    case: Case,
    tick: int,
    *,
    lost: int = 0,
    latency_ticks: int = 2,
    spacing: int = 4,
    retries: int = 3,
) -> None:
    """Write the ledger of one message of event e1 on link l1, with honest distances."""
    trace = case.run.trace()
    row = trace.roster.agent_index('ego')
    assert row is not None

    def entry(at: int, kind: LinkEventKind, attempt: int, reason: LossReason) -> None:
        if at >= case.run.ticks:
            return
        uav = trace.uav[at, 0]
        ego = trace.ground[at, row]
        case.run.links.append(
            LinkRecord(
                tick=at,
                sequence=len(case.run.links),
                message=1,
                link='l1',
                event='e1',
                sender='uav1',
                receiver='ego',
                kind=kind,
                attempt=attempt,
                reason=reason,
                distance_m=float(
                    np.sqrt(
                        (uav[0] - ego[0]) * (uav[0] - ego[0])
                        + (uav[1] - ego[1]) * (uav[1] - ego[1])
                        + uav[2] * uav[2]
                    )
                ),
                line_of_sight=True,
            )
        )

    entry(tick, LinkEventKind.SENT, 0, LossReason.NONE)
    for attempt in range(min(lost, retries + 1)):
        entry(tick + attempt * spacing, LinkEventKind.ATTEMPT_LOST, attempt, LossReason.RANDOM)
    if lost > retries:
        entry(tick + retries * spacing, LinkEventKind.FAILED, retries, LossReason.NONE)
        return
    passed = tick + lost * spacing
    entry(passed, LinkEventKind.ATTEMPT_PASSED, lost, LossReason.NONE)
    entry(passed + latency_ticks, LinkEventKind.DELIVERED, lost, LossReason.NONE)


@_flown_once
def tailgate_case(*, keeps_away: bool = False, alert: bool = True, lost: int = 0) -> Case:
    """A van closes in on the ego from 45 m; a tracking drone alerts the ego at 20 m."""
    ticks = 1401
    ego_speed = ramp(ticks, 400, 10.0)
    van_speed = ramp(ticks, 400, 10.0 if keeps_away else 14.0)
    ego = driver('ego', 'car', 0.0, ego_speed, role='ego')
    van = driver('van1', 'van', -45.0, van_speed)
    # The van closes in and then keeps 7 m from bumper to bumper behind the ego: 12 m centres.
    close = np.flatnonzero(ego.x - van.x <= 12.0)
    if len(close):
        k = int(close[0])
        van.x[k:] = ego.x[k:] - (ego.x[k] - van.x[k])
        van.speed[k:] = ego.speed[k:]
    one = flight(
        ticks, (0.0, 20.0), 30.0, lambda k: (float(van.x[k]), float(van.y[k]), 30.0), landing=1050
    )
    request = spec(
        agents=(
            agent('ego', 'car', role='ego'),
            agent(
                'van1',
                'van',
                placements=(
                    Placement(
                        relation=Relation.BEHIND, of='ego', distance_m=number(45.0, explicit=True)
                    ),
                ),
                behaviors=(
                    Behavior(
                        kind=BehaviorKind.TAILGATE,
                        target='ego',
                        closing_from_m=number(45.0, explicit=True),
                    ),
                ),
            ),
        ),
        uavs=(Uav(id='uav1'),),
        missions=(mission('m1', MissionMode.TRACK, target='van1'),),
        links=(alert_link(),),
        events=(
            Event(
                id='e1',
                trigger=DistanceTrigger(
                    on='distance_below', a='van1', b='ego', value_m=number(20.0, explicit=True)
                ),
                action=SendMessage(do='send_message', sender='uav1', receiver='ego'),
            ),
        ),
    )
    facts = PlanFacts(
        horizon_s=70.0,
        missions=(
            MissionFacts(
                mission='m1',
                uav='uav1',
                mode=MissionMode.TRACK,
                altitude_m=30.0,
                standoff_m=0.0,
                duration_s=30.0,
                transit_m=60.0,
            ),
        ),
    )
    case = Case(
        spec=request,
        facts=facts,
        world=world(),
        run=Run(ticks=ticks, agents=[ego, van], flights=[one]),
    )
    near = np.flatnonzero(ego.x - van.x <= 20.0)
    if len(near) and alert:
        tick = int(near[0])
        case.run.claim(tick, ScenarioEventKind.TRIGGERED, 'e1')
        case.run.claim(tick, ScenarioEventKind.ACTION, 'e1')
        message(case, tick, lost=lost)
    return case


def judge(case: Case) -> Verdict:
    """Derive the conditions of a case and verify its run."""
    derivation = derive_conditions(case.spec, case.facts, LIMITS, TOLERANCES)
    return verify(case.run.trace(), case.world, derivation.conditions, case.spec)


def result(verdict: Verdict, id: str) -> ConditionResult:
    """The result of one condition."""
    return next(r for r in verdict.results if r.id == id)


def facts_of(*missions: MissionFacts, horizon_s: float) -> PlanFacts:
    """Facts of a plan."""
    return PlanFacts(horizon_s=horizon_s, missions=missions)


@_flown_once
def hover_case(
    *,
    drift: float = 0.0,
    landing: int | None = 900,
    weather: str = 'clear',
    altitude_error: float = 0.0,
    explicit_s: float | None = None,
    ego_y: float = -15.0,
) -> Case:
    """A drone hovers 30 m above (100, 0) up to tick `landing`; the ego stands beside it."""
    ticks = 1401
    ego = driver('ego', 'car', 100.0, np.zeros(ticks), y=ego_y, role='ego')

    def path(k: int) -> tuple[float, float, float]:
        late = k > 600
        return 100.0 + (drift if late else 0.0), 0.0, 30.0 + (altitude_error if late else 0.0)

    # 20.2 m of way in steps of 0.75 m: captured at 1.45 m (2 m allowed) or 2.95 m (3 m).
    one = flight(ticks, (100.0, 20.2), 30.0, path, landing=landing)
    duration = number(30.0, Unit.SECOND)
    if explicit_s is not None:
        duration = number(explicit_s, Unit.SECOND, explicit=True)
    request = spec(
        world={'weather': weather},
        agents=(agent('ego', 'car', role='ego'),),
        uavs=(Uav(id='uav1'),),
        missions=(
            mission(
                'm1',
                MissionMode.HOVER,
                target='ego',
                altitude_m=number(30.0, explicit=True),
                duration_s=duration,
            ),
        ),
    )
    facts = facts_of(
        MissionFacts(
            mission='m1',
            uav='uav1',
            mode=MissionMode.HOVER,
            altitude_m=30.0,
            hover_point=(100.0, 0.0, 30.0),
            duration_s=30.0 if explicit_s is None else explicit_s,
            transit_m=20.0,
        ),
        horizon_s=70.0,
    )
    run = Run(ticks=ticks, agents=[ego], flights=[one])
    return Case(spec=request, facts=facts, world=world(weather=weather), run=run)


RECTANGLE = (
    (0.0, 0.0, 30.0),
    (100.0, 0.0, 30.0),
    (100.0, 60.0, 30.0),
    (0.0, 60.0, 30.0),
    (0.0, 0.0, 30.0),
)


@_flown_once
def survey_case(
    *,
    skip: int | None = None,
    shift: float = 0.0,
    speed: float = 8.0,
    ego_x: float = 50.0,
    stop_after: int | None = None,
    **values: object,
) -> Case:
    """A drone flies the rectangle at 8 m/s; its first leg lies over the street y = 0.

    Args:
        skip: Waypoint that is cut short by flying straight on to the next one.
        shift: The flown route lies this much to the north of the planned one.
        speed: Flown speed.
        stop_after: The UAV stays where it is from this tick on and never lands.
    """
    ticks = 1801
    points = [p for k, p in enumerate(RECTANGLE) if k != skip]
    marks = [0.0]
    for a, b in pairwise(points):
        marks.append(marks[-1] + float(np.hypot(b[0] - a[0], b[1] - a[1])))

    def path(k: int) -> tuple[float, float, float]:
        if stop_after is not None:
            k = min(k, stop_after)
        s = max(0, k - 200) * DT_S * speed
        x = float(np.interp(s, marks, [p[0] for p in points]))
        y = float(np.interp(s, marks, [p[1] for p in points]))
        return x, y + shift, 30.0

    done = 200 + int(marks[-1] / speed / DT_S)
    landing = None if stop_after is not None else done + 21
    one = flight(ticks, (0.0, 10.0), 30.0, path, landing=landing)
    ego = driver('ego', 'car', ego_x, np.zeros(ticks), y=30.0, role='ego')
    request = spec(
        agents=(agent('ego', 'car', role='ego'),),
        uavs=(Uav(id='uav1'),),
        missions=(mission('m1', MissionMode.NAVIGATE, target='ego', over_streets=True, **values),),
    )
    facts = facts_of(
        MissionFacts(
            mission='m1',
            uav='uav1',
            mode=MissionMode.NAVIGATE,
            altitude_m=30.0,
            waypoints=RECTANGLE,
            transit_m=10.0,
        ),
        horizon_s=90.0,
    )
    run = Run(ticks=ticks, agents=[ego], flights=[one])
    return Case(spec=request, facts=facts, world=world(), run=run)


@_flown_once
def convoy_case(**speeds: FloatArray) -> Case:
    """Bus ahead of the ego, ambulance behind it, 20 m between centres; a drone tracks the bus."""
    ticks = 1401
    base = ramp(ticks, 0, 10.0)
    ego = driver('ego', 'car', 0.0, speeds.get('ego', base), role='ego')
    bus = driver('bus1', 'bus', 20.0, speeds.get('bus1', base))
    ambulance = driver('ambulance1', 'ambulance', -20.0, speeds.get('ambulance1', base))
    extra = driver('car1', 'car', 0.0, speeds.get('car1', base), y=50.0)
    one = flight(
        ticks,
        (20.0, 35.0),
        30.0,
        lambda k: (float(bus.x[k]), 35.0, 30.0),
        landing=1050,
    )
    request = spec(
        agents=(
            agent('ego', 'car', role='ego'),
            agent(
                'bus1',
                'bus',
                placements=(
                    Placement(
                        relation=Relation.AHEAD,
                        of='ego',
                        distance_m=number(20.0, explicit=True),
                        kept_in_motion=True,
                    ),
                ),
                behaviors=(Behavior(kind=BehaviorKind.DRIVE),),
            ),
            agent(
                'ambulance1',
                'ambulance',
                placements=(Placement(relation=Relation.BEHIND, of='ego', kept_in_motion=True),),
                behaviors=(Behavior(kind=BehaviorKind.FOLLOW, target='ego'),),
            ),
            agent(
                'car1',
                'car',
                role='background',
                behaviors=(Behavior(kind=BehaviorKind.CIRCULATE),),
            ),
        ),
        uavs=(Uav(id='uav1'),),
        missions=(
            mission(
                'm1', MissionMode.TRACK, target='bus1', standoff_m=number(35.0, explicit=True)
            ),
        ),
    )
    facts = facts_of(
        MissionFacts(
            mission='m1',
            uav='uav1',
            mode=MissionMode.TRACK,
            altitude_m=30.0,
            standoff_m=35.0,
            duration_s=30.0,
            transit_m=60.0,
        ),
        horizon_s=70.0,
    )
    run = Run(ticks=ticks, agents=[ego, bus, ambulance, extra], flights=[one])
    return Case(spec=request, facts=facts, world=world(), run=run)


def ground_case(behavior: Behavior, speed: FloatArray, **others: tuple[float, FloatArray]) -> Case:
    """A car with one behaviour among others (name: start, speeds); no UAV, 20 s long."""
    agents = [driver('car1', 'car', 0.0, speed)]
    agents += [driver(name, 'car', x, v) for name, (x, v) in others.items()]
    request = spec(
        agents=(
            agent('car1', 'car', behaviors=(behavior,)),
            *(agent(name, 'car') for name in others),
        )
    )
    run = Run(ticks=len(speed), agents=agents)
    return Case(spec=request, facts=facts_of(horizon_s=20.0), world=world(), run=run)
