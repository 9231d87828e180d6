# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Commands and claims that the executor does not give from the recorded states are found."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from aurora_core.execution.faults import Fault
from aurora_core.execution.plan import EXECUTOR_VERSION, Execution
from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.verdict import Finding, VerdictStatus
from aurora_core.pipeline.functions import execution_stage, ground_stage, parse_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.recompute import recomputed
from aurora_core.pipeline.verification import verify_content
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import (
    GROUND_WIDTH,
    UAV_WIDTH,
    GroundColumn,
    GroundCommandKind,
    UavColumn,
    UavCommandColumn,
    UavMode,
)
from aurora_core.trace.records import (
    EventRecord,
    LinkEventKind,
    LinkRecord,
    ScenarioEventKind,
    SightRecord,
)
from aurora_core.trace.trace import Integrity, Trace

_KNOWN = installed_knowledge()

PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'over a link with 60% loss when the van comes within 20 meters.'
)
TICKS = 900


@cache
def _graph() -> Agsg:
    parsed = parse_stage(_KNOWN, PROMPT, 'downtown', 1).agsg
    assert parsed is not None
    agsg = ground_stage(_KNOWN, parsed, 1).agsg
    assert agsg is not None
    return agsg


@cache
def recorded(*faults: Fault) -> tuple[Trace, WorldModel]:
    """A run in which every UAV is where it is told to be and the van closes in on the ego car."""
    execution: Execution = execution_stage(_KNOWN, _graph(), 1, faults)
    roster = execution.roster
    ground = np.zeros((TICKS, len(roster.agents), GROUND_WIDTH))
    ground[:, :, GroundColumn.PRESENT] = 1.0
    ground[:, :, GroundColumn.HEADING_Y] = -1.0
    for row, agent in enumerate(roster.agents):
        ground[:, row, GroundColumn.X], ground[:, row, GroundColumn.Y] = agent.route_xy_m[0]
    van, ego = roster.agent_index('van1'), roster.agent_index('ego')
    assert van is not None
    assert ego is not None
    ground[:, van, : GroundColumn.Y + 1] = ground[:, ego, : GroundColumn.Y + 1]
    ground[:, van, GroundColumn.Y] += np.linspace(80.0, 5.0, TICKS)
    ground[:, van, GroundColumn.SPEED] = 75.0 / (TICKS * roster.dt_s)
    uav = np.zeros((TICKS, len(roster.uavs), UAV_WIDTH))
    uav[:, :, UavColumn.QW] = 1.0
    flown = [np.zeros((len(roster.uavs), len(UavCommandColumn)))]
    driven: list[tuple[GroundCommand, ...]] = [()]
    links: list[LinkRecord] = []
    sights: list[SightRecord] = []
    events: list[EventRecord] = []
    for tick in range(TICKS):
        command = flown[-1]
        uav[tick, :, : UavColumn.Z + 1] = command[:, UavCommandColumn.X : UavCommandColumn.Z + 1]
        climbs = command[:, UavCommandColumn.MODE] == UavMode.TAKEOFF
        uav[tick, climbs, UavColumn.Z] = command[climbs, UavCommandColumn.TAKEOFF_ALTITUDE]
        uav[tick, :, UavColumn.ARMED] = command[:, UavCommandColumn.MODE] != UavMode.IDLE
        output = execution.stepper.step(tick, ground[tick], uav[tick])
        assert not output.finished
        flown.append(output.uav_commands)
        driven.append(output.ground_commands)
        links += output.links
        sights += output.sights
        events += output.events
    trace = Trace(
        roster=roster,
        ground=ground,
        uav=uav,
        uav_commands=np.array(flown[:-1]),
        ground_commands=tuple(driven[:-1]),
        links=tuple(links),
        sights=tuple(sights),
        events=tuple(events),
    )
    return trace, execution.world


def found(trace: Trace, world: WorldModel, agsg: Agsg | None = None) -> tuple[Finding, ...]:
    known = _KNOWN
    return recomputed(
        trace,
        world,
        _graph() if agsg is None else agsg,
        tolerances=known.tolerances,
        settings=known.settings,
        parts=known.parts_of(world),
    )


def altered_graph(**fields: object) -> Agsg:
    grounding = GroundedScenario.model_validate({**dict(_grounding()), **fields})
    return _graph().model_copy(update={'grounding': grounding})


def _grounding() -> GroundedScenario:
    grounding = _graph().grounding
    assert grounding is not None
    return grounding


def _flown(column: UavCommandColumn, change: Callable[[float], float]) -> Callable[[Trace], Trace]:
    def alter(trace: Trace) -> Trace:
        rows = trace.uav_commands.copy()
        rows[600, 0, column] = change(rows[600, 0, column])
        return replace(trace, uav_commands=rows)

    return alter


def _driven(tick: int, change: Callable[..., tuple[GroundCommand, ...]]) -> Callable[..., Trace]:
    def alter(trace: Trace) -> Trace:
        rows = list(trace.ground_commands)
        rows[tick] = change(rows[tick])
        return replace(trace, ground_commands=tuple(rows))

    return alter


def _more(_commands: tuple[GroundCommand, ...]) -> tuple[GroundCommand, ...]:
    return (GroundCommand(agent=1, kind=GroundCommandKind.SET_SPEED, value=30.0),)


def _faster(commands: tuple[GroundCommand, ...]) -> tuple[GroundCommand, ...]:
    return tuple(replace(c, value=math.nextafter(c.value, 99.0)) for c in commands)


def _ledger_shortened(trace: Trace) -> Trace:
    return replace(trace, links=trace.links[:-1])


def _luckier(trace: Trace) -> Trace:
    """The first attempt that was lost passes, all else as it was."""
    lost = next(k for k, r in enumerate(trace.links) if r.kind is LinkEventKind.ATTEMPT_LOST)
    better = replace(trace.links[lost], kind=LinkEventKind.ATTEMPT_PASSED)
    return replace(trace, links=(*trace.links[:lost], better, *trace.links[lost + 1 :]))


def _nearer(trace: Trace) -> Trace:
    first = trace.links[0]
    near = replace(first, distance_m=math.nextafter(first.distance_m, 0.0))
    return replace(trace, links=(near, *trace.links[1:]))


def _blind(trace: Trace) -> Trace:
    last = trace.sights[-1]
    return replace(trace, sights=(*trace.sights[:-1], replace(last, visible=not last.visible)))


def _earlier(trace: Trace) -> Trace:
    events = list(trace.events)
    k = next(k for k, e in enumerate(events) if e.kind is ScenarioEventKind.TRIGGERED)
    events[k] = replace(events[k], tick=events[k].tick - 1)
    return replace(trace, events=tuple(events))


def _swapped(trace: Trace) -> Trace:
    """Two claims of one tick change their running numbers."""
    events = list(trace.events)
    k = next(k for k in range(len(events) - 1) if events[k].tick == events[k + 1].tick)
    a, b = events[k], events[k + 1]
    events[k], events[k + 1] = replace(b, sequence=a.sequence), replace(a, sequence=b.sequence)
    return replace(trace, events=tuple(events))


def test_the_states_of_a_run_give_its_commands_and_claims_again() -> None:
    trace, world = recorded()
    kinds = {r.kind for r in trace.links}
    assert {LinkEventKind.ATTEMPT_LOST, LinkEventKind.DELIVERED} <= kinds, 'luck has its part'
    assert found(trace, world) == ()


@pytest.mark.parametrize(
    ('alter', 'kind', 'subject', 'tick'),
    [
        (_flown(UavCommandColumn.X, lambda x: x + 5.0), 'command', 'uav1', 600),
        (_flown(UavCommandColumn.Z, lambda z: math.nextafter(z, 0.0)), 'command', 'uav1', 600),
        (_flown(UavCommandColumn.MODE, lambda _: UavMode.LAND), 'command', 'uav1', 600),
        (_flown(UavCommandColumn.TAKEOFF_ALTITUDE, lambda _: -0.0), 'command', 'uav1', 600),
        (_driven(500, _more), 'command', None, 500),
        (_driven(1, lambda _: ()), 'command', None, 1),
        (_driven(1, _faster), 'command', None, 1),
        (_driven(1, lambda c: tuple(reversed(c))), 'command', 'ground commands', 1),
        (_ledger_shortened, 'claim', 'the message ledger', None),
        (_luckier, 'claim', 'the message ledger', None),
        (_nearer, 'claim', 'the message ledger', None),
        (_blind, 'claim', 'sight', None),
        (_earlier, 'claim', 'events', None),
        (_swapped, 'claim', 'events', None),
    ],
)
def test_what_is_altered_is_named(
    alter: Callable[[Trace], Trace], kind: str, subject: str | None, tick: int | None
) -> None:
    trace, world = recorded()
    forged = alter(trace)
    findings = found(forged, world)
    assert findings
    assert {f.kind for f in findings} == {kind}
    if subject is not None:
        assert {f.subject for f in findings} == {subject}
    if tick is not None:
        assert {f.tick for f in findings} == {tick}
        assert findings[0].time_s == trace.time_s(tick)


def test_recorded_and_recomputed_are_both_told() -> None:
    trace, world = recorded()
    (finding,) = found(_flown(UavCommandColumn.Z, lambda _: 11.25)(trace), world)
    ours = float(trace.uav_commands[600, 0, UavCommandColumn.Z])
    assert finding.text == f'commanded z 11.25, the executor gives {ours!r}'


def test_the_first_differences_are_told_and_the_rest_counted() -> None:
    trace, world = recorded()
    rows = trace.uav_commands.copy()
    rows[400:500, 0, UavCommandColumn.Y] += 1.0
    findings = found(replace(trace, uav_commands=rows), world)
    assert [f.tick for f in findings] == [400, 401, 402, 403]
    assert findings[-1].text == '… and 97 more, the last at tick 499'


FAULTS = [
    (Fault(kind='link_loss', subject='*', at_s=3.0, value=0.9),),
    (Fault(kind='target_removed', subject='van1', at_s=20.0),),
    (Fault(kind='route_blocked', subject='uav1', at_s=15.013),),
    (Fault(kind='keep_away', subject='van1', value=2.5),),
    (
        # Given in another order than that in which they act.
        Fault(kind='link_loss', subject='*', at_s=30.0, value=0.0),
        Fault(kind='link_loss', subject='*', at_s=0.0),
        Fault(kind='route_blocked', subject='uav1', at_s=1e4),
    ),
]


@pytest.mark.parametrize('faults', FAULTS, ids=lambda faults: faults[0].kind)
def test_recorded_faults_are_injected_again(faults: tuple[Fault, ...]) -> None:
    trace, world = recorded(*faults)
    assert any(e.fault_kind for e in trace.events)
    assert found(trace, world) == ()


@pytest.mark.parametrize('faults', FAULTS[:-1], ids=lambda faults: faults[0].kind)
def test_a_fault_that_is_struck_out_of_the_record_is_found(faults: tuple[Fault, ...]) -> None:
    trace, world = recorded(*faults)
    kept = [e for e in trace.events if not e.fault_kind]
    numbered = tuple(replace(e, sequence=k) for k, e in enumerate(kept))
    assert found(replace(trace, events=numbered), world)


@pytest.mark.parametrize(
    'detail',
    [
        'link_loss',
        'link_loss {"at_s":3.0,"value":2.0}',
        'link_loss {"at_s":-1,"value":null}',
        'link_loss ' + '[' * 5000,
        'link_loss {"at_s":3.0,"value":0.9,"more":1}',
        'no_such_fault {"at_s":3.0,"value":0.9}',
        'target_removed {"at_s":3.0,"value":null}',
    ],
)
def test_a_record_of_no_possible_fault_is_a_finding(detail: str) -> None:
    trace, world = recorded(*FAULTS[0])
    events = tuple(replace(e, detail=detail) if e.fault_kind else e for e in trace.events)
    (finding,) = found(replace(trace, events=events), world)
    assert finding.subject == 'executor'
    assert 'cannot be built' in finding.text


def test_a_ledger_without_the_injected_loss_is_found() -> None:
    """Luck alone says nothing of a link with an injected loss; the executor does."""
    honest, world = recorded()
    trace, _ = recorded(*FAULTS[0])
    assert trace.links != honest.links
    assert {f.subject for f in found(replace(trace, links=honest.links), world)} == {
        'the message ledger'
    }


def test_the_version_of_the_executor_is_in_the_graph() -> None:
    assert _grounding().executor_version == EXECUTOR_VERSION
    trace, world = recorded()
    (finding,) = found(trace, world, altered_graph(executor_version=EXECUTOR_VERSION + 1))
    assert 'version' in finding.text


def test_another_executor_makes_another_configuration() -> None:
    trace, world = recorded()
    content = BagContent(trace=_luckier(trace), world=world, agsg_message=None)
    foreign = altered_graph(configuration='f' * 64, executor_version=EXECUTOR_VERSION + 1)
    verdict = verify_content(_KNOWN, content, foreign)
    told = [f.text for f in verdict.cross_check if f.kind in ('command', 'claim')]
    assert len(told) == 1
    assert 'version' in told[0]
    assert 'configuration' in {f.kind for f in verdict.cross_check}


def test_nothing_that_differs_is_ever_verified() -> None:
    trace, world = recorded()
    forged = _flown(UavCommandColumn.VX, lambda v: v + 1e-9)(trace)
    content = BagContent(trace=forged, world=world, agsg_message=None)
    verdict = verify_content(_KNOWN, content, _graph())
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    assert 'command' in {f.kind for f in verdict.cross_check}
    without = verify_content(_KNOWN, content, _graph(), recompute=False)
    assert 'command' not in {f.kind for f in without.cross_check}


def test_injected_faults_are_told_beside_the_verdict() -> None:
    trace, world = recorded(*FAULTS[0])
    content = BagContent(trace=trace, world=world, agsg_message=None)
    assert 'faults were injected: link_loss (*)' in verify_content(_KNOWN, content, _graph()).notes


def test_up_to_a_gap_the_commands_are_compared() -> None:
    trace, world = recorded()
    gone = trace.uav.copy()
    gone[700:] = np.nan
    cut = replace(
        trace,
        uav=gone,
        missing_ticks=tuple(range(700, TICKS)),
        integrity=Integrity.TRUNCATED,
        events=(),
    )
    assert found(cut, world) == (), 'that claims are lost is said elsewhere'
    findings = found(_flown(UavCommandColumn.X, lambda x: x + 5.0)(cut), world)
    assert [f.tick for f in findings] == [600]


@pytest.mark.parametrize('value', [1e12, -1e12, 1e-300])
def test_states_that_no_run_has_are_no_crash(value: float) -> None:
    trace, world = recorded()
    wild = trace.uav.copy()
    wild[300:, 0] = value
    assert found(replace(trace, uav=wild), world)


def test_states_of_fewer_bodies_than_the_graph_has_are_a_finding() -> None:
    trace, world = recorded()
    roster = replace(trace.roster, uavs=())
    fewer = replace(
        trace, roster=roster, uav=trace.uav[:, :0], uav_commands=trace.uav_commands[:, :0]
    )
    assert 'executor' in {f.subject for f in found(fewer, world)}
