# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Makes small, complete facts of runs: a request, a verdict, a recorded flight."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.judging.build import Source, Target, condition
from aurora_core.judging.quantities.visible_fraction import VisibleFraction
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.knowledge.map_types import Building, NoFlyZone
from aurora_core.knowledge.world import (
    CentreLine,
    SignalPost,
    Surface,
    SurfaceKind,
    Wind,
    WorldModel,
)
from aurora_core.outcomes.agsg import Agsg, Stage
from aurora_core.outcomes.condition import Condition, MissionArguments, Window, conditions_to_json
from aurora_core.outcomes.grounded import AnchorScore, GroundedScenario, RealisedValue
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.verdict import ConditionResult, Reason, Verdict, VerdictStatus
from aurora_core.report.facts import ExecutionFacts, RunFacts
from aurora_core.report.run_check import JudgedBag
from aurora_core.report.run_report import ClauseReport
from aurora_core.spec.parameter import Parameter, Provenance, Span, Unit
from aurora_core.spec.scenario import Clause, GroundAgent, ScenarioSpec, Uav, UavMission
from aurora_core.spec.vocabulary import AgentType, ClauseStatus, MissionMode
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.hashing import TraceHashes
from aurora_core.trace.layout import (
    GROUND_WIDTH,
    UAV_COMMAND_WIDTH,
    UAV_WIDTH,
    GroundColumn,
    UavColumn,
    UavCommandColumn,
    UavPhase,
)
from aurora_core.trace.records import EventRecord, ScenarioEventKind
from aurora_core.trace.roster import Roster, RosterEntry
from aurora_core.trace.trace import Integrity, Trace

PROMPT = 'A drone follows a motorcycle at 40 meters.'
RUN_ID = '20260131T120000Z-0a1b2c'
DT_S = 0.05


def _parameter(value: float, unit: Unit, span: Span | None = None) -> Parameter:
    return Parameter(
        value=value,
        unit=unit,
        low=0.0,
        high=1000.0,
        provenance=Provenance.EXPLICIT if span is not None else Provenance.DEFAULT,
        span=span,
    )


def make_spec(**changes: Any) -> ScenarioSpec:
    """A drone that tracks a motorcycle."""
    values: dict[str, Any] = {
        'prompt': PROMPT,
        'agents': (GroundAgent(id='motorcycle1', type=AgentType.MOTORCYCLE),),
        'uavs': (Uav(id='uav1'),),
        'missions': (
            UavMission(
                id='m1',
                uav='uav1',
                mode=MissionMode.TRACK,
                target='motorcycle1',
                altitude_m=_parameter(40.0, Unit.METRE, Span(start=31, end=41)),
                standoff_m=_parameter(0.0, Unit.METRE),
                duration_s=_parameter(30.0, Unit.SECOND),
            ),
        ),
        'clauses': (
            Clause(
                text='A drone follows a motorcycle',
                span=Span(start=0, end=28),
                status=ClauseStatus.ENCODED,
                ids=('m1', 'motorcycle1'),
            ),
            Clause(
                text='at 40 meters',
                span=Span(start=29, end=41),
                status=ClauseStatus.ENCODED,
                ids=('m1',),
            ),
        ),
    }
    return ScenarioSpec.model_validate({**values, **changes})


_MISSION = MissionArguments(
    mission='m1',
    uav='uav1',
    index=0,
    mode=MissionMode.TRACK,
    target='motorcycle1',
    altitude_m=40.0,
    altitude_tolerance_m=1.0,
    capture_altitude_m=5.0,
    capture_horizontal_m=5.0,
    first_altitude_m=40.0,
    first_altitude_tolerance_m=1.0,
)


def make_condition(name: str = 'm1.visible', **source: Any) -> Condition:
    """A condition over a share of samples."""
    return condition(
        id=name,
        sentence=f'uav1 keeps {name}',
        of=('uav1', 'motorcycle1'),
        target=Target(op='>=', threshold=0.7, unit='1'),
        arguments=VisibleFraction(
            horizon_s=60.0, window=Window.RUN, touchdown_m=0.3, mission=_MISSION
        ),
        source=Source(**{'ids': ('m1',), **source}),
        every_sample=False,
    )


def make_result(
    name: str = 'm1.visible', margin: float | None = 0.2, **changes: Any
) -> ConditionResult:
    """What the monitor says about that condition."""
    values: dict[str, Any] = {
        'id': name,
        'sentence': f'uav1 keeps {name}',
        'explanation': 'seen in 90 % of the samples',
        'formula': 'visible_fraction(uav1,motorcycle1) >= 0.7 1',
        'spec_ids': ('m1',),
        'op': '>=',
        'threshold': 0.7,
        'margin': margin,
        'reason': None if margin is not None else Reason.EMPTY_PHASE,
        'unit': '1',
        'normalised': None if margin is None else margin / 0.07,
        'satisfied': margin is not None and margin >= 0.0,
        'exercised': margin is not None,
        'worst_time_s': 12.5,
        'worst_place_m': (10.0, 20.0, 40.0),
        'provenance': Provenance.DEFAULT,
    }
    return ConditionResult.model_validate({**values, **changes})


def make_verdict(*results: ConditionResult, **changes: Any) -> Verdict:
    """A verdict whose status follows from its results."""
    rows = results or (make_result(),)
    status = VerdictStatus.VERIFIED
    if not all(row.satisfied for row in rows):
        status = VerdictStatus.VIOLATED
    values: dict[str, Any] = {
        'status': status,
        'results': rows,
        'integrity': Integrity.INTACT,
    }
    return Verdict.model_validate({**values, **changes})


def make_grounding() -> GroundedScenario:
    """A grounding of which only the realised altitude is of interest."""
    return GroundedScenario(
        map_name='downtown',
        map_digest='d' * 64,
        anchor_lane='a_0',
        anchor_position_m=0.0,
        score=AnchorScore(road=1.0, air=1.0, sense=1.0, comm=1.0, joint=1.0),
        candidates=1,
        agents=(),
        uavs=(),
        realised=(
            RealisedValue(
                path='missions/m1/altitude_m',
                requested=40.0,
                realised=40.0,
                provenance=Provenance.EXPLICIT,
            ),
        ),
        weather='clear',
        time_of_day='noon',
    )


def make_graph(*conditions: Condition, spec: ScenarioSpec | None = None) -> Agsg:
    """The graph that was executed."""
    return build_agsg(
        spec if spec is not None else make_spec(),
        map_digest='d' * 64,
        stage=Stage.GROUNDED,
        grounding=make_grounding(),
        conditions=conditions or (make_condition(),),
    )


def make_judged(verdict: Verdict, *clauses: ClauseReport) -> JudgedBag:
    """A bag as it was judged by itself; with one encoded clause unless others are given."""
    text = ClauseReport(
        text='at 40 meters', span=Span(start=29, end=41), status=ClauseStatus.ENCODED
    )
    return JudgedBag(
        content=BagContent(trace=make_trace(30), world=make_world(), agsg_message=None),
        agsg=make_graph(),
        hashes=TraceHashes(trace_sha256='a' * 64, motion_sha256='b' * 64),
        verdict=verdict,
        clauses=clauses or (text,),
        facts=make_facts(verdict=verdict),
    )


def make_facts(**changes: Any) -> RunFacts:
    """A run that went all the way and is verified."""
    values: dict[str, Any] = {
        'run_id': RUN_ID,
        'prompt': PROMPT,
        'parse': ParseOutcome(spec=make_spec(), clauses=make_spec().clauses),
        'grounding': GroundingOutcome(agsg=make_graph()),
        'execution': ExecutionFacts(
            bag='bag.0', ticks=1201, dt_s=DT_S, trace_sha256='a' * 64, motion_sha256='b' * 64
        ),
        'verdict': make_verdict(),
        'timing': {'parse': 0.01, 'execute': 1.5},
        'iterations': 1,
    }
    return RunFacts(**{**values, **changes})


def make_trace(ticks: int = 400, events: tuple[EventRecord, ...] | None = None) -> Trace:
    """A drone goes up, follows a motorcycle eastwards and comes down again."""
    time_s = np.arange(ticks) * DT_S
    third = ticks // 3
    ground = np.zeros((ticks, 1, GROUND_WIDTH))
    ground[:, 0, GroundColumn.X] = np.maximum(0.0, time_s - third * DT_S) * 10.0
    ground[:, 0, GroundColumn.HEADING_X] = 1.0
    ground[:, 0, GroundColumn.PRESENT] = 1.0
    uav = np.zeros((ticks, 1, UAV_WIDTH))
    uav[:, 0, UavColumn.X] = ground[:, 0, GroundColumn.X]
    uav[:, 0, UavColumn.Y] = 5.0
    up = np.minimum(time_s * 6.0, 40.0)
    down = np.maximum(0.0, (ticks - 30) * DT_S - time_s) * 8.0
    uav[:, 0, UavColumn.Z] = np.minimum(up, down)
    uav[:, 0, UavColumn.LANDED] = (uav[:, 0, UavColumn.Z] <= 0.0).astype(float)
    commands = np.zeros((ticks, 1, UAV_COMMAND_WIDTH))
    commands[1:third, 0, UavCommandColumn.PHASE] = UavPhase.ASCENT
    commands[third : 2 * third, 0, UavCommandColumn.PHASE] = UavPhase.MISSION
    commands[2 * third :, 0, UavCommandColumn.PHASE] = UavPhase.LANDING
    told = events if events is not None else default_events(third)
    return Trace(
        roster=Roster(
            dt_s=DT_S,
            agents=(
                RosterEntry(
                    body_id='motorcycle1',
                    type_name='motorcycle',
                    is_person=False,
                    system_id=0,
                    length_m=2.2,
                    width_m=0.9,
                    height_m=1.5,
                ),
            ),
            uavs=(
                RosterEntry(
                    body_id='uav1',
                    type_name='uav',
                    is_person=False,
                    system_id=1,
                    length_m=0.6,
                    width_m=0.6,
                    height_m=0.3,
                ),
            ),
        ),
        ground=ground,
        uav=uav,
        uav_commands=commands,
        ground_commands=((),) * ticks,
        events=told,
    )


def default_events(third: int) -> tuple[EventRecord, ...]:
    """Take-off, mission, release, landing."""
    told = (
        (0, ScenarioEventKind.PHASE, 'uav1', 'ascent'),
        (third, ScenarioEventKind.PHASE, 'uav1', 'm1'),
        (third, ScenarioEventKind.RELEASED, 'motorcycle1', ''),
        (2 * third, ScenarioEventKind.PHASE, 'uav1', 'landing'),
    )
    return tuple(
        EventRecord(tick=tick, sequence=k, kind=kind, subject=subject, detail=detail)
        for k, (tick, kind, subject, detail) in enumerate(told)
    )


def make_world(*conditions: Condition) -> WorldModel:
    """A street with two houses, a crossing, a signal and a no-fly zone."""

    def box(x: float, y: float, w: float, h: float) -> Any:
        return ((x, y), (x + w, y), (x + w, y + h), (x, y + h))

    def house(name: str, x: float, height_m: float) -> Building:
        return Building(
            id=name,
            ring=box(x, 20.0, 20.0, 15.0),
            holes=(),
            height_m=height_m,
            height_source='design',
            kind='house',
            name='',
        )

    return WorldModel(
        map_name='street',
        map_digest='d' * 64,
        origin_lat_deg=47.0,
        origin_lon_deg=8.0,
        weather='clear',
        time_of_day='noon',
        wind=Wind(),
        buildings=(house('low', 0.0, 8.0), house('high', 40.0, 70.0)),
        no_fly_zones=(
            NoFlyZone(
                id='z', name='tower', ring=box(70.0, 20.0, 20.0, 20.0), floor_m=0.0, ceiling_m=90.0
            ),
        ),
        surfaces=(
            Surface(
                surface_id='road',
                kind=SurfaceKind.DRIVING,
                ring=np.array(box(-100.0, -8.0, 400.0, 16.0)),
            ),
            Surface(
                surface_id='zebra',
                kind=SurfaceKind.CROSSING,
                ring=np.array(box(20.0, -8.0, 3.0, 16.0)),
            ),
        ),
        lanes=(
            CentreLine(
                lane_id='lane',
                street_name='Assembly Street',
                points=np.array([[-100.0, -4.0], [300.0, -4.0]]),
                width_m=3.3,
                speed_limit_mps=13.9,
            ),
        ),
        signals=(SignalPost(junction_id='j', x_m=30.0, y_m=0.0),),
        limits=load_limits(config_path('limits.json')),
        conditions_json=conditions_to_json(conditions),
    )


@pytest.fixture(scope='session')
def make() -> SimpleNamespace:
    """The makers of this file."""
    makers: dict[str, Callable[..., Any]] = {
        'spec': make_spec,
        'condition': make_condition,
        'result': make_result,
        'verdict': make_verdict,
        'graph': make_graph,
        'facts': make_facts,
        'judged': make_judged,
        'trace': make_trace,
        'world': make_world,
    }
    return SimpleNamespace(run_id=RUN_ID, prompt=PROMPT, dt_s=DT_S, **makers)
