# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Prompts in the manner of users, each with the whole scene that it asks for."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from yaml_rows import rows_of

from aurora_core.outcomes.parse import ParseContext, ParseOutcome
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.parameter import Bound, Parameter, Provenance
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import ClauseStatus

CONTEXT = ParseContext(
    map_name='downtown',
    landmark_names=('central_park', 'clock_tower', 'city_hospital', 'north_plaza'),
    seed=1,
)
_TABLES = [
    Path(__file__).with_name(name)
    for name in (
        'prompts.yaml',
        'wordings.yaml',
        'shorthand.yaml',
        'commands.yaml',
        'wrapped.yaml',
        'criteria.yaml',
        'documents.yaml',
        'events.yaml',
        'reactions.yaml',
        'flight_words.yaml',
        'flights.yaml',
        'scenes.yaml',
        'several.yaml',
        'plain.yaml',
    )
]
_MARK = {Provenance.EXPLICIT: '', Provenance.INFERRED: 'i', Provenance.DEFAULT: 'd'}
_BOUND = {Bound.EXACTLY: '', Bound.AT_LEAST: '>=', Bound.AT_MOST: '<='}


def _p(parameter: Parameter) -> str:
    """`40`: stated; `30d`: default; `35i`: inferred; `~`: about; `<=`: at most."""
    about = '~' if parameter.approximate else ''
    return f'{about}{_BOUND[parameter.bound]}{parameter.value:g}{_MARK[parameter.provenance]}'


def _agent(agent: GroundAgent) -> str:
    parts = [f'{agent.id} {agent.role.value}']
    for place in agent.placements:
        words: list[str] = [place.of or '-']
        if place.distance_m is not None:
            words.append(_p(place.distance_m))
        if place.bearing_deg is not None:
            words.append(f'bearing {_p(place.bearing_deg)}')
        if place.kept_in_motion:
            words.append('throughout' if place.throughout else 'kept')
        parts.append(f'{place.relation.value}({" ".join(words)})')
    for behavior in agent.behaviors:
        words = [behavior.target] if behavior.target else []
        if behavior.speed_mps is not None:
            words.append(f'speed {_p(behavior.speed_mps)}')
        if behavior.closing_from_m is not None:
            words.append(f'from {_p(behavior.closing_from_m)}')
        if behavior.headway_s is not None:
            words.append(f'{_p(behavior.headway_s)} s')
        if behavior.side is not None:
            words.append(f'to the {behavior.side.value}')
        if behavior.duration_s is not None:
            words.append(f'for {_p(behavior.duration_s)}')
        parts.append(f'{behavior.kind.value}({" ".join(words)})')
    return ' '.join(parts)


def _mission(mission: UavMission) -> str:
    parts = [mission.uav, mission.mode.value]
    if mission.pattern is not None:
        parts.append(mission.pattern.value)
    if mission.target is not None:
        parts.append(mission.target + ('?' if mission.target_inferred else ''))
    parts += [f'from {mission.start}'] if mission.start is not None else []
    for name, value in (
        ('alt', mission.altitude_m),
        ('standoff', mission.standoff_m),
        ('bearing', mission.bearing_deg),
        ('for', mission.duration_s),
        ('radius', mission.radius_m),
        ('waypoints', mission.waypoint_count),
        ('turns', mission.turns),
        ('speed', mission.speed_mps),
    ):
        if value is not None:
            parts.append(f'{name} {_p(value)}')
    if mission.size_m is not None:
        parts.append(f'size {_p(mission.size_m[0])}x{_p(mission.size_m[1])}')
    parts += [mission.side.value] if mission.side is not None else []
    parts += ['streets'] * mission.over_streets + ['stays-up'] * mission.ends_in_flight
    return ' '.join(parts)


def _fields(element: Any) -> str:
    values = [value for _, value in element if value is not None]
    return ' '.join(_p(v) if isinstance(v, Parameter) else str(v) for v in values)


def scene_lines(spec: ScenarioSpec) -> list[str]:
    """Return the whole scene, one element a line."""
    lines = []
    world = spec.world
    stated = [world.weather.value] if world.weather_span else []
    stated += [world.time_of_day.value] if world.time_of_day_span else []
    stated += [f'traffic {world.traffic_density.value}'] if world.traffic_density else []
    stated += [f'for {_p(world.duration_s)}'] if world.duration_s else []
    stated += [f'wind {_p(world.wind_mps)}'] if world.wind_mps else []
    stated += [f'gusts {_p(world.gust_mps)}'] if world.gust_mps else []
    stated += [f'wind from {_p(world.wind_from_deg)}'] if world.wind_from_deg else []
    stated += [world.wind.value] if world.wind else []
    if stated:
        lines.append('world ' + ' '.join(stated))
    lines += [_agent(a) for a in spec.agents]
    lines += [_mission(m) for m in spec.missions]
    for link in spec.links:
        line = (
            f'link {link.sender}>{link.receiver} loss {_p(link.loss)} latency {_p(link.latency_s)}'
        )
        if link.range_m is not None:
            line += f' range {_p(link.range_m)}'
        line += f' retries {_p(link.retransmissions)}'
        if link.outage_s is not None:
            line += f' out {_p(link.outage_s[0])}-{_p(link.outage_s[1])}'
        lines.append(line + (f' rate {_p(link.rate_hz)}' if link.rate_hz is not None else ''))
    for event in spec.events:
        trigger = _fields(event.trigger) if event.trigger is not None else '?'
        action = _fields(event.action) if event.action is not None else '?'
        delay = f' delay {_p(event.delay_s)}' if event.delay_s is not None else ''
        lines.append(f'{event.id}: {trigger} -> {action}{delay}')
    for condition in spec.conditions:
        of = ' '.join(condition.of)
        line = f'require {condition.quantity} {of} {condition.op} {_p(condition.value)}'
        for word, value in (
            ('hold', condition.hold_s),
            ('by', condition.by_s),
            ('share', condition.fraction),
        ):
            line += f' {word} {_p(value)}' if value is not None else ''
        lines.append(line)
    return lines


def outcome_lines(outcome: ParseOutcome) -> list[str]:
    """Return the scene, or the question, or the refusals; then what was not read."""
    lines = scene_lines(outcome.spec) if outcome.spec is not None else []
    if outcome.question is not None:
        lines.append('question')
    lines += [f'refused {r.kind.value}: {r.word}' for r in outcome.refusals]
    if outcome.spec is not None:
        lines += [
            f'unread: {c.text}' for c in outcome.clauses if c.status is ClauseStatus.NOT_ENCODED
        ]
    return lines


def _rows() -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = []
    for table in _TABLES:
        rows += rows_of(table)
    return rows


_ROWS = _rows()


@pytest.mark.parametrize('row', _ROWS, ids=lambda row: row['prompt'][:50])
def test_prompt_gives_the_scene(row: dict[str, Any]) -> None:
    outcome = parse_offline(row['prompt'], CONTEXT)
    assert outcome_lines(outcome) == row['scene']


def test_table_has_all_styles() -> None:
    styles = [row['style'] for row in _ROWS]
    assert {style: styles.count(style) >= 20 for style in ('plain', 'wordy', 'careless')} == {
        'plain': True,
        'wordy': True,
        'careless': True,
    }


def test_paraphrases_give_one_scene() -> None:
    groups: dict[str, set[tuple[str, ...]]] = {}
    for row in _ROWS:
        if 'group' in row:
            scene = tuple(outcome_lines(parse_offline(row['prompt'], CONTEXT)))
            groups.setdefault(row['group'], set()).add(scene)
    assert groups
    assert {name: len(scenes) for name, scenes in groups.items()} == dict.fromkeys(groups, 1)
