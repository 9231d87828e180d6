# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Assets: what a scenario can be made of, with the words that people use for it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from pydantic import JsonValue

from aurora_core.knowledge.agent_types import AgentTypeRecord, top_speed_mps
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.uav_record import UavRecord
from aurora_core.outcomes.retrieval import RecordKind
from aurora_core.retrieval.record import Record
from aurora_core.spec.vocabulary import AgentType, TimeOfDay, Weather

UAV_ID = 'uav'
Words = Mapping[str, Sequence[str]]
_UAV_LIMITS = (
    'uav_altitude_min_m',
    'uav_altitude_max_m',
    'uav_speed_max_mps',
    'uav_climb_max_mps',
    'uav_descent_max_mps',
    'uav_endurance_s',
    'uav_standoff_max_m',
    'clearance_min_m',
    'separation_min_m',
)
_LINK_LIMITS = ('link_range_sight_m', 'link_range_blocked_m')
_UAV_WORDS = 'flies in the air: hover, track, follow from above, patrol, survey, orbit'


def asset_records(
    types: Mapping[str, AgentTypeRecord], limits: Limits, words: Words, measured: UavRecord
) -> tuple[Record, ...]:
    """Return one record per agent type, weather, time of day, for UAVs and for links.

    Args:
        types: Measured sizes and dynamics.
        limits: Limits in force.
        measured: What the multirotor does, and over what distances messages were received.
        words: Synonyms by agent type, weather, time of day and `uav`, from the lexicon.
    """
    records = [_type(kind, types, limits, words) for kind in AgentType]
    uav: dict[str, JsonValue] = {name: getattr(limits, name) for name in _UAV_LIMITS}
    uav['stop_m'] = measured.stop_m(limits.uav_speed_max_mps)
    records.append(_asset(UAV_ID, words, 'limits.json', uav, _UAV_WORDS))
    link: dict[str, JsonValue] = {name: getattr(limits, name) for name in _LINK_LIMITS}
    link['received_sight_m'] = measured.received_m(with_sight=True)
    link['received_blocked_m'] = measured.received_m(with_sight=False)
    about = (
        'radio link: message, alert, warning, report, communication range, packet loss, latency'
    )
    records.append(_asset('link', words, 'limits.json', link, about))
    for weather in Weather:
        seen: dict[str, JsonValue] = {
            'sensing_range_m': limits.sensing_range_m[weather],
            'wind_mean_mps': limits.wind_mean_mps[weather],
            'wind_gust_mps': limits.wind_gust_mps[weather],
        }
        about = 'weather: how far the camera sees, wind'
        records.append(_asset(weather.value, words, 'limits.json', seen, about))
    for hour in TimeOfDay:
        factor: dict[str, JsonValue] = {'sensing_factor': limits.sensing_factor[hour]}
        about = 'time of day: light, how far the camera sees'
        records.append(_asset(hour.value, words, 'limits.json', factor, about))
    return tuple(records)


def _type(
    kind: AgentType, types: Mapping[str, AgentTypeRecord], limits: Limits, words: Words
) -> Record:
    if kind.value not in types:
        about = 'fixed unit beside the road that exchanges messages'
        return _asset(kind.value, words, 'knowledge/measured/agent_types.json', {}, about)
    record = types[kind.value]
    data: dict[str, JsonValue] = {
        'length_m': record.length_m,
        'width_m': record.width_m,
        'height_m': record.height_m,
        'max_speed_mps': top_speed_mps(record, limits),
        'accel_mps2': record.accel_mps2,
        'decel_mps2': record.decel_mps2,
    }
    about = 'walks on foot' if record.is_person else 'drives on the road'
    return _asset(kind.value, words, 'knowledge/measured/agent_types.json', data, about)


def _asset(name: str, words: Words, source: str, data: dict[str, JsonValue], about: str) -> Record:
    synonyms = ', '.join(dict.fromkeys((name.replace('_', ' '), *words.get(name, ()))))
    text = f'{synonyms}; {about}'
    return Record(kind=RecordKind.ASSET, id=name, text=text, source=source, data=data)
