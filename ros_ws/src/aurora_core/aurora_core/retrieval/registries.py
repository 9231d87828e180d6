# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The registries: short closed lists that belong into every context, whatever the prompt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import StrEnum

from pydantic import JsonValue

from aurora_core.knowledge.agent_types import AgentTypeRecord, top_speed_mps
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import MapRecords
from aurora_core.outcomes.retrieval import RecordKind
from aurora_core.retrieval.record import Record
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    MissionMode,
    Pattern,
    Place,
    Relation,
    TimeOfDay,
    TrafficDensity,
    Weather,
)

# How a link fades towards its range is nothing that a request says.
_UNSAID = {'link_decade_db'}
_SIZES = ('length_m', 'width_m', 'height_m')
_VOCABULARY: Mapping[str, type[StrEnum]] = {
    'behaviors': BehaviorKind,
    'relations': Relation,
    'places': Place,
    'weather': Weather,
    'time_of_day': TimeOfDay,
    'traffic_density': TrafficDensity,
}
# Which defaults of the parser each mission and pattern takes when the prompt is silent.
_MODES = {
    MissionMode.HOVER: ('altitude', 'mission_duration'),
    MissionMode.TRACK: ('altitude', 'standoff', 'mission_duration'),
    MissionMode.NAVIGATE: ('altitude', 'route_speed'),
}
_PATTERNS = {
    Pattern.RECTANGLE: ('pattern_length', 'pattern_width'),
    Pattern.LINE: ('pattern_length',),
    Pattern.LAWNMOWER: ('pattern_length', 'pattern_width'),
    Pattern.ORBIT: ('orbit_radius',),
    Pattern.WAYPOINTS: ('waypoint_count',),
}


def registry_records(
    *,
    limits: Limits,
    types: Mapping[str, AgentTypeRecord],
    map_model: MapModel,
    maps: Sequence[str],
    unsaid: Mapping[str, float],
    measured: MapRecords | None,
) -> tuple[Record, ...]:
    """Return the registries.

    Args:
        limits: Those that feasibility and verification rule by.
        types: Those that grounding makes bodies from.
        map_model: The active map.
        maps: Names of all maps.
        measured: What was measured on the active map; None where nothing was.
        unsaid: The parser's values for what a prompt leaves out, SI, angles in degrees.
    """
    return (
        _registry('agent_types', 'knowledge/measured/agent_types.json', _types(types, limits)),
        _registry('mission_templates', 'parsing/defaults.yaml', _templates(unsaid)),
        _registry('limits', 'limits.json', limits.model_dump(mode='json', exclude=_UNSAID)),
        _registry('maps', f'maps/{map_model.name}', _map(map_model, maps, measured)),
        _registry(
            'vocabulary',
            'spec/vocabulary.py',
            {name: [member.value for member in kind] for name, kind in _VOCABULARY.items()},
        ),
    )


def _registry(name: str, source: str, data: dict[str, JsonValue]) -> Record:
    words = name.replace('_', ' ')
    return Record(kind=RecordKind.REGISTRY, id=name, text=words, source=source, data=data)


def _types(types: Mapping[str, AgentTypeRecord], limits: Limits) -> dict[str, JsonValue]:
    """A roadside unit has no body: it is named without sizes."""
    found: dict[str, JsonValue] = {}
    for kind in AgentType:
        record = types.get(kind.value)
        if record is None:
            found[kind.value] = {}
            continue
        sizes: dict[str, JsonValue] = {name: getattr(record, name) for name in _SIZES}
        found[kind.value] = {**sizes, 'max_speed_mps': top_speed_mps(record, limits)}
    return found


def _templates(unsaid: Mapping[str, float]) -> dict[str, JsonValue]:
    return {
        'modes': {m.value: {n: unsaid[n] for n in names} for m, names in _MODES.items()},
        'patterns': {p.value: {n: unsaid[n] for n in names} for p, names in _PATTERNS.items()},
    }


def _map(
    map_model: MapModel, maps: Sequence[str], measured: MapRecords | None
) -> dict[str, JsonValue]:
    return {
        **({} if measured is None else _offers(measured)),
        'active': map_model.name,
        'all': list(maps),
        'description': map_model.description,
        'bounds_m': list(map_model.bounds_m),
        'streets': list(map_model.network.street_names),
        'landmarks': {mark.name: mark.kind for mark in map_model.landmarks},
        'no_fly_zones': [
            {'name': zone.name, 'floor_m': zone.floor_m, 'ceiling_m': zone.ceiling_m}
            for zone in map_model.zones
        ],
    }


def _offers(measured: MapRecords) -> dict[str, JsonValue]:
    """What was found to be possible on the map: where to drive, to walk and to see from."""
    return {
        'street_km': {
            part.vehicle_class: round(part.length_km * part.largest_share, 2)
            for part in measured.parts
        },
        'walked': {
            'sidewalks': measured.sidewalks.walked,
            'crossings': measured.crossings.walked,
        },
        'seen_share': [
            {'height_m': s.height_m, 'distance_m': s.distance_m, 'share': s.free_share}
            for s in measured.sight
        ],
        'hidden_corners_share': {f'{c.before_m:g} m': c.hidden_share for c in measured.corners},
    }
