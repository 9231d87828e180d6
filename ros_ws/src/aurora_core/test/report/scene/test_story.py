# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import pytest

from aurora_core.report.scene.caption import Failure
from aurora_core.report.scene.story import Moment, Tone, moments_of
from aurora_core.report.scene.tracks import tracks_of
from aurora_core.spec.parameter import Parameter, Provenance, Span, Unit
from aurora_core.spec.scenario import (
    AgentAction,
    DistanceTrigger,
    Event,
    EventDoneTrigger,
    ScenarioSpec,
    SendMessage,
    UavAction,
)
from aurora_core.trace.records import (
    EventRecord,
    LinkEventKind,
    LinkRecord,
    LossReason,
    ScenarioEventKind,
)
from aurora_core.trace.trace import Trace


def _told(
    trace: Trace, spec: ScenarioSpec | None, failures: tuple[Failure, ...] = ()
) -> tuple[Moment, ...]:
    return moments_of(trace, tracks_of(trace), spec, failures, {})


def _event(tick: int, kind: ScenarioEventKind, subject: str, detail: str = '') -> EventRecord:
    return EventRecord(tick=tick, sequence=tick, kind=kind, subject=subject, detail=detail)


def _link(tick: int, kind: LinkEventKind, attempt: int = 0) -> LinkRecord:
    return LinkRecord(
        tick=tick,
        sequence=tick,
        message=0,
        link='l1',
        event='e1',
        sender='uav1',
        receiver='motorcycle1',
        kind=kind,
        attempt=attempt,
        reason=LossReason.NONE,
        distance_m=30.0,
        line_of_sight=True,
    )


@pytest.fixture
def with_event(make: SimpleNamespace) -> ScenarioSpec:
    value = Parameter(
        value=20.0,
        unit=Unit.METRE,
        low=0.0,
        high=1e4,
        provenance=Provenance.EXPLICIT,
        span=Span(start=0, end=1),
    )
    trigger = DistanceTrigger(on='distance_below', a='motorcycle1', b='uav1', value_m=value)
    action = SendMessage(do='send_message', sender='uav1', receiver='motorcycle1')
    spec: ScenarioSpec = make.spec(events=(Event(id='e1', trigger=trigger, action=action),))
    return spec


def test_a_flight_is_told_from_take_off_to_landing(make: SimpleNamespace) -> None:
    trace = make.trace()
    texts = [moment.text for moment in _told(trace, make.spec())]
    assert texts == [
        'uav1 takes off',
        'motorcycle1 starts to move',
        'uav1 at 40 m, tracks motorcycle1',
        'uav1 mission done, goes to land',
        'uav1 has landed',
    ]


def test_an_event_that_waits_for_another_has_one_moment_in_words(
    make: SimpleNamespace, with_event: ScenarioSpec
) -> None:
    """Nobody knows what e1 and e2 are who did not write the specification."""
    trace = make.trace()
    stop = Event(id='e1', trigger=None, action=AgentAction(do='stop', agent='motorcycle1'))
    then = Event(
        id='e2',
        trigger=EventDoneTrigger(on='event_done', event='e1'),
        action=UavAction(do='change_mission', uav='uav1', mission=with_event.missions[0].id),
    )
    spec = with_event.model_copy(update={'events': (stop, then)})
    kinds = (ScenarioEventKind.TRIGGERED, ScenarioEventKind.ACTION)
    records = tuple(_event(50, kind, event) for event in ('e1', 'e2') for kind in kinds)
    texts = [moment.text for moment in _told(replace(trace, events=records), spec)]
    assert texts[:2] == ['motorcycle1: stop', 'uav1 goes over: tracks motorcycle1']
    assert not any('triggered' in text for text in texts)


def test_a_mission_is_told_with_the_altitude_that_it_was_grounded_to(
    make: SimpleNamespace,
) -> None:
    trace = make.trace()
    told = moments_of(trace, tracks_of(trace), make.spec(), (), {'m1': 55.0})
    assert 'uav1 at 55 m, tracks motorcycle1' in [moment.text for moment in told]


def test_moments_lie_where_the_body_was(make: SimpleNamespace) -> None:
    trace = make.trace()
    landing = _told(trace, make.spec())[-2]
    assert landing.place_m == pytest.approx((float(trace.uav[landing.tick, 0, 0]), 5.0))


def test_a_trigger_and_its_message_are_two_moments(
    make: SimpleNamespace, with_event: ScenarioSpec
) -> None:
    trace = replace(
        make.trace(),
        events=(
            _event(200, ScenarioEventKind.TRIGGERED, 'e1'),
            _event(200, ScenarioEventKind.ACTION, 'e1'),
        ),
        links=(
            _link(200, LinkEventKind.SENT),
            _link(201, LinkEventKind.ATTEMPT_PASSED),
            _link(202, LinkEventKind.DELIVERED),
        ),
    )
    texts = [m.text for m in _told(trace, with_event) if m.tone is Tone.EVENT]
    assert texts == [
        'motorcycle1 within 20 m of uav1',
        'uav1 → motorcycle1: message delivered after 0.10 s',
    ]


def test_a_lost_message_is_a_failure(make: SimpleNamespace) -> None:
    trace = replace(
        make.trace(),
        links=(
            _link(200, LinkEventKind.SENT),
            _link(201, LinkEventKind.ATTEMPT_LOST, 1),
            _link(202, LinkEventKind.ATTEMPT_LOST, 2),
            _link(203, LinkEventKind.FAILED),
        ),
    )
    lost = next(m for m in _told(trace, make.spec()) if m.tone is Tone.FAILURE)
    assert lost.text == 'uav1 → motorcycle1: message lost (2 attempts)'


def test_faults_say_what_was_injected_into_whom(make: SimpleNamespace) -> None:
    trace = replace(
        make.trace(),
        events=(
            _event(
                100,
                ScenarioEventKind.FAULT,
                'motorcycle1',
                'target_removed {"at_s":5.0,"value":null}',
            ),
            _event(120, ScenarioEventKind.FAULT, '*', 'link_loss {"at_s":6.0,"value":null}'),
        ),
    )
    faults = [m for m in _told(trace, None) if m.tone is Tone.FAULT]
    assert [m.text for m in faults] == [
        'injected fault: target removed (motorcycle1)',
        'injected fault: link loss (every link)',
    ]
    assert faults[0].place_m is not None
    assert faults[1].place_m is None


def test_failures_are_never_left_out_and_one_without_a_time_comes_last(
    make: SimpleNamespace,
) -> None:
    crowd = tuple(_event(k, ScenarioEventKind.RELEASED, 'motorcycle1') for k in range(1, 60))
    failures = (
        Failure(sentence='it is never seen', time_s=None, place_m=None),
        Failure(sentence='it is too high', time_s=2.0, place_m=(1.0, 2.0, 3.0)),
    )
    told = _told(replace(make.trace(), events=crowd), make.spec(), failures)
    assert len(told) <= 13
    assert told[-1].text == '✗ it is never seen'
    high = next(m for m in told if m.text == '✗ it is too high')
    assert (high.tick, high.place_m) == (40, (1.0, 2.0))
