# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from aurora_core.judging.evaluation import Context, Measured
from aurora_core.monitor import signals_for_plot as signals
from aurora_core.report.build import build_report
from aurora_core.report.html import report_html
from aurora_core.report.page import courses
from aurora_core.report.page.graph import graph_paper
from aurora_core.report.page.ledger import messages_of
from aurora_core.report.page.motion import bodies_of, samples_of, stride_of
from aurora_core.report.page.recorded import Recorded, recorded, script_json
from aurora_core.report.scene.style import colours_of
from aurora_core.report.scene.tracks import region_of, tracks_of
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.layout import GroundColumn
from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason
from aurora_core.trace.trace import Trace


def _recorded(make: SimpleNamespace, trace: Trace | None = None) -> Recorded:
    content = BagContent(
        trace=trace or make.trace(),
        world=make.world(make.condition()),
        agsg_message=None,
    )
    found = recorded(build_report(make.facts()), content, make.graph())
    assert found is not None
    return found


def _bodies(trace: Trace) -> list[dict[str, Any]]:
    tracks = tracks_of(trace)
    return bodies_of(trace, tracks, colours_of(tracks), region_of(tracks), stride_of(trace))


def test_places_are_those_of_the_recording_to_half_a_step(make: SimpleNamespace) -> None:
    trace = make.trace()
    ticks = samples_of(trace, stride_of(trace))
    box = region_of(tracks_of(trace))
    rider, drone = _bodies(trace)
    east = np.cumsum(rider['x']) * 0.1 + box.west
    assert np.abs(east - trace.ground[ticks, 0, GroundColumn.X]).max() <= 0.05 + 1e-9
    assert np.abs(np.cumsum(drone['z']) * 0.1 - trace.uav[ticks, 0, 2]).max() <= 0.05 + 1e-9
    assert ticks[-1] == trace.ticks - 1


def test_who_is_not_there_is_told(make: SimpleNamespace) -> None:
    trace = make.trace()
    ground = trace.ground.copy()
    ground[100:200, 0, GroundColumn.PRESENT] = 0.0
    rider, _ = _bodies(replace(trace, ground=ground))
    stride = stride_of(trace)
    (_, left), (back, _) = rider['there']
    assert left * stride < 100 <= (left + 1) * stride
    assert (back - 1) * stride < 200 <= back * stride


def test_three_minutes_of_many_bodies_stay_below_5_mb(make: SimpleNamespace) -> None:
    trace = make.trace(3600)
    many, noise = 60, np.random.default_rng(1)
    ground = np.repeat(trace.ground, many, axis=1)
    ground[:, :, :2] += noise.normal(0.0, 3.0, (1, many, 2)).cumsum(axis=1)
    ground[:, :, :2] += noise.normal(0.0, 0.3, (3600, many, 2)).cumsum(axis=0)
    agents = tuple(replace(trace.roster.agents[0], body_id=f'car{k}') for k in range(many))
    crowd = replace(trace, ground=ground, roster=replace(trace.roster, agents=agents))
    page = report_html(build_report(make.facts()), b'p' * 400_000, _recorded(make, crowd))
    assert len(page.encode()) < 5_000_000


def test_data_cannot_end_its_element() -> None:
    text = script_json({'id': '</script><!--<script>&\u2028\u202e'})
    assert not set('<>&\u2028\u202e') & set(text)
    assert json.loads(text) == {'id': '</script><!--<script>&\u2028\u202e'}


def test_a_thinned_course_keeps_its_extremes(
    make: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    values = np.sin(np.arange(5000) / 40.0)
    values[3333] = -7.0
    signal = signals.PlotSignal(
        condition_id='m1.visible', signal_name='s',
        times_s=np.linspace(0.0, 249.95, 5000), values=values, held=None, unit='m',
        threshold=0.0, tolerance=0.0, robustness=values, margin=-7.0,
    )  # fmt: skip
    monkeypatch.setattr(courses, 'signals_for_plot', lambda context: (signal,))
    context = SimpleNamespace(conditions=(make.condition(),))
    course = courses.courses_of(context)['m1.visible']  # type: ignore[arg-type]
    assert len(course['t']) < 500
    assert (min(course['m']), max(course['m'])) == (-7.0, 1.0)
    assert course['t'][course['m'].index(-7.0)] == pytest.approx(3333 * 0.05)
    assert (course['t'][0], course['t'][-1]) == (0.0, pytest.approx(4999 * 0.05))


def test_what_a_verdict_measured_is_not_measured_again(make: SimpleNamespace) -> None:
    condition = make.condition()
    kept = Measured(ticks=np.arange(3), values=np.array([0.1, 0.2, 0.9]))
    context = Context(
        SimpleNamespace(ticks=3, dt_s=0.05, complete=lambda horizon_s: True),  # type: ignore[arg-type]
        make.spec(),
        (condition,),
    )
    context.kept[condition.id] = kept
    (drawn,) = signals.signals_for_plot(context)
    assert drawn.values is kept.values


def test_the_ledger_tells_what_became_of_each_message(make: SimpleNamespace) -> None:
    def entry(k: int, message: int, kind: LinkEventKind, reason: LossReason) -> LinkRecord:
        return LinkRecord(
            tick=20 * k, sequence=k, message=message, link='link1', event='e1', sender='uav1',
            receiver='motorcycle1', kind=kind, attempt=1, reason=reason, distance_m=30.0,
            line_of_sight=False,
        )  # fmt: skip

    none, lost = LossReason.NONE, LinkEventKind.ATTEMPT_LOST
    links = (
        entry(0, 1, LinkEventKind.SENT, none),
        entry(1, 1, lost, LossReason.RANGE),
        entry(2, 1, LinkEventKind.ATTEMPT_PASSED, none),
        entry(3, 1, LinkEventKind.DELIVERED, none),
        entry(4, 2, LinkEventKind.SENT, none),
        entry(5, 2, lost, LossReason.RANDOM),
        entry(6, 2, LinkEventKind.FAILED, none),
        entry(7, 3, LinkEventKind.SENT, none),
    )
    rows = messages_of(replace(make.trace(), links=links))
    assert [row.outcome for row in rows] == ['delivered', 'not delivered', 'under way at the end']
    assert rows[0].attempts == ((1.0, 'out of range'), (2.0, 'passed'))
    assert (rows[0].sent_s, rows[0].ended_s, rows[0].distance_m) == (0.0, 3.0, 30.0)
    assert rows[2].distance_m is None


def test_a_condition_names_what_it_depends_on(make: SimpleNamespace) -> None:
    paper = graph_paper(make.graph())
    assert paper is not None
    (visible,) = (d for d in paper.conditions if d.id == 'm1.visible')
    assert set(visible.sources) == {'uav1', 'motorcycle1'}
    assert any('missions/m1/altitude_m = 40 m' in text for text in visible.parameters)
    for node in paper.nodes:
        assert paper.left <= node.x - node.width / 2
        assert node.x + node.width / 2 <= paper.left + paper.width
