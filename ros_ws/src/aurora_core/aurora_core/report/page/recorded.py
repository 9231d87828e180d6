# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""All that a page shows of a recording, ready for its template and its scripts."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from aurora_core.errors import AuroraError
from aurora_core.judging.codec import conditions_from_json
from aurora_core.judging.evaluation import Context
from aurora_core.monitor.verify import context_of
from aurora_core.outcomes.agsg import Agsg
from aurora_core.report.page.courses import courses_of
from aurora_core.report.page.graph import GraphPaper, graph_paper
from aurora_core.report.page.ground import ground_of
from aurora_core.report.page.ledger import MessageRow, messages_of, sights_of
from aurora_core.report.page.motion import STEP_M, bodies_of, samples_of, stride_of
from aurora_core.report.run_report import RunReport
from aurora_core.report.scene.caption import Caption
from aurora_core.report.scene.story import Moment, moments_of, realised_altitudes
from aurora_core.report.scene.style import TONE_COLOURS, colours_of
from aurora_core.report.scene.tracks import Box, region_of, tracks_of
from aurora_core.report.visible import visible
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.trace import Trace


@dataclass(frozen=True, slots=True, kw_only=True)
class MomentRow:
    """Something that happened; `time_s` is None when it has no time of its own."""

    time_s: float | None
    text: str
    tone: str
    colour: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Recorded:
    """What a page shows of a bag.

    Attributes:
        data: JSON for the scripts; stands in HTML without any further escaping.
        moments: What happened, in order.
        messages: The ledger.
        graph: The scenario graph.
        courses: Conditions that have a course.
        moving: Those whose course is more than one value all along.
    """

    data: str
    moments: tuple[MomentRow, ...]
    messages: tuple[MessageRow, ...]
    graph: GraphPaper | None
    courses: frozenset[str]
    moving: frozenset[str]


def recorded(
    report: RunReport, content: BagContent, agsg: Agsg | None, context: Context | None = None
) -> Recorded | None:
    """Return what a page shows of a bag, None when it holds no tick.

    Args:
        report: Of the run.
        content: Its bag.
        agsg: The graph in it, None when it cannot be read.
        context: In which it was judged; None measures everything anew.
    """
    trace = content.trace
    if trace.ticks == 0:
        return None
    tracks = tracks_of(trace)
    box = region_of(tracks)
    conditions = conditions_from_json(content.world.conditions_json)
    moments = moments_of(
        trace,
        tracks,
        agsg.spec if agsg is not None else None,
        Caption.of_report(report).failures,
        realised_altitudes(conditions),
    )
    courses = _courses(content, agsg, context)
    messages = messages_of(trace)
    graph = graph_paper(agsg) if agsg is not None else None
    stride = stride_of(trace)
    data = {
        'step': round(stride * trace.roster.dt_s, 6),
        'count': len(samples_of(trace, stride)),
        'end': round(trace.time_s(trace.ticks - 1), 3),
        'unit': STEP_M,
        'size': [round(box.width, 1), round(box.height, 1)],
        'bodies': bodies_of(trace, tracks, colours_of(tracks), box, stride),
        'ground': ground_of(content.world, box),
        'moments': [_placed(trace, moment, box) for moment in moments],
        'sights': sights_of(trace),
        'messages': [
            {
                'from': m.sender,
                'to': m.receiver,
                'sent': m.sent_s,
                'end': m.ended_s,
                'ok': m.delivered,
                'lost': [t for t, what in m.attempts if what != 'passed'],
            }
            for m in messages
        ],
        'courses': courses,
        'conditions': {
            row.id: {'ok': row.satisfied, 'at': row.worst_time_s} for row in report.conditions
        },
        'graph': _dependences(graph),
    }
    return Recorded(
        data=script_json(data),
        moments=tuple(
            MomentRow(
                time_s=None if m.tick < 0 else trace.time_s(m.tick),
                text=m.text,
                tone=m.tone.value,
                colour=TONE_COLOURS[m.tone],
            )
            for m in moments
        ),
        messages=messages,
        graph=graph,
        courses=frozenset(courses),
        moving=frozenset(k for k, c in courses.items() if 'held' in c or len(set(c['v'])) > 1),
    )


def script_json(data: object) -> str:
    """Return JSON that ends no script element, whatever texts it holds."""
    text = json.dumps(data, separators=(',', ':'), allow_nan=False, ensure_ascii=True)
    for character in '<>&':
        text = text.replace(character, f'\\u{ord(character):04x}')
    return text


def _courses(
    content: BagContent, agsg: Agsg | None, context: Context | None
) -> dict[str, dict[str, Any]]:
    if agsg is None:
        return {}
    try:
        if context is None:
            conditions = conditions_from_json(content.world.conditions_json)
            context = context_of(content.trace, content.world, conditions, agsg.realised_spec)
        return courses_of(context)
    except AuroraError:
        # Conditions that do not fit a damaged recording are told in the report.
        return {}


def _placed(trace: Trace, moment: Moment, box: Box) -> dict[str, Any]:
    place = moment.place_m
    return {
        't': None if moment.tick < 0 else round(trace.time_s(moment.tick), 3),
        'text': visible(moment.text),
        'tone': moment.tone.value,
        'at': place and [round(place[0] - box.west, 1), round(place[1] - box.south, 1)],
    }


def _dependences(graph: GraphPaper | None) -> dict[str, Any]:
    if graph is None:
        return {}
    return {
        'edges': [[e.source, e.target] for e in graph.edges],
        'conditions': {
            d.id: {
                'of': d.sources,
                'parameters': [visible(text) for text in d.parameters],
                'more': d.more,
            }
            for d in graph.conditions
        },
    }
