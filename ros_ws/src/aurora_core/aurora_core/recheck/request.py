# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The specification and the configuration as plain JSON, and what they say."""

from __future__ import annotations

import math
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeGuard

from shapely import STRtree, point_on_surface
from shapely.geometry import Point, Polygon, shape
from shapely.ops import unary_union

from aurora_core.files import MAP_BYTES, read_json, read_xml
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.map_folders import map_folder
from aurora_core.outcomes.feasibility import Certificate, Fact, FactSource
from aurora_core.recheck.finding import Step

# "about" widens a relative tolerance to a tenth.
_ABOUT = 0.10
# A vehicle is asked for this much less than it was measured to do, in whole tenths.
_UAV_RESERVE = 1.15
_OF_THE_UAV = {
    'uav_speed_max_mps': 'speed_mps',
    'uav_climb_max_mps': 'climb_mps',
    'uav_descent_max_mps': 'descent_mps',
}
_OF_THE_LINK = {
    'link_range_sight_m': 'reach_sight_m',
    'link_range_blocked_m': 'reach_blocked_m',
}
_LEAST_REACH_M = {'link_range_sight_m': 0.1, 'link_range_blocked_m': 0.0}
# A landmark so near to a building stands in it.
_BESIDE_M = 1.0


def read_config(*parts: str) -> Any:
    """Return a JSON document of the configuration."""
    return read_json(config_path(*parts), MAP_BYTES)


def read_limits() -> dict[str, Any]:
    """Return the limits in force: what is configured, nowhere beyond what the UAV can do."""
    table: dict[str, Any] = read_config('limits.json')
    uav = read_config('knowledge', 'measured', 'multirotor.json')['multirotor']
    done = {limit: float(uav[measured]) for limit, measured in _OF_THE_UAV.items()}
    done['uav_endurance_s'] = _hover_s(uav)
    for limit, value in done.items():
        most = max(1.0, math.floor(10.0 * value / _UAV_RESERVE)) / 10.0
        table[limit] = min(float(table[limit]), most)
    for limit, measured in _OF_THE_LINK.items():
        reach_m = max(float(uav[measured]), _LEAST_REACH_M[limit])
        table[limit] = min(float(table[limit]), reach_m)
    return table


def _hover_s(uav: Any) -> float:
    """Return how long one battery lasted in a hover in calm air, seconds."""
    still = ('speed_mps', 'mean_mps', 'gust_mps')
    return next(float(r['endurance_s']) for r in uav['endurances'] if not any(r[k] for k in still))


def read_map_file(name: str, file: str) -> Any:
    """Return a JSON document of a map, bundled or imported; nobody may change it."""
    return _document(*_version(map_folder(name) / file))


def _version(path: Path) -> tuple[Path, int, int]:
    """Return a file as a key under which what was read of it can be kept."""
    found = path.stat()
    return path, found.st_mtime_ns, found.st_size


@lru_cache(maxsize=16)
def _document(path: Path, _changed_ns: int, _size: int) -> Any:
    return read_json(path, MAP_BYTES)


@lru_cache(maxsize=4)
def _outlines(path: Path, changed_ns: int, size: int) -> STRtree:
    """Return the outlines of the buildings in a file, without their courtyards."""
    features = _document(path, changed_ns, size)['features']
    return STRtree([Polygon(shape(f['geometry']).exterior) for f in features])


def _inside(feature: dict[str, Any]) -> tuple[float, float]:
    point = point_on_surface(Polygon(shape(feature['geometry']).exterior))
    return round(float(point.x), 1), round(float(point.y), 1)


def read_map_stops(name: str) -> frozenset[str]:
    """Return the names of the bus stops of a map, without their directions."""
    document = read_xml(map_folder(name) / 'stops.add.xml')
    plain = (e.get('name', '').partition('(')[0].strip() for e in document.iterfind('busStop'))
    return frozenset(f'{name} bus stop' for name in plain if name)


def node_at(document: Any, path: str) -> Any:
    """Return what stands at a path such as `missions/m1/altitude_m`; None where nothing does."""
    node = document
    for part in path.split('/'):
        if isinstance(node, list):
            by_id = next((e for e in node if isinstance(e, dict) and e.get('id') == part), None)
            if by_id is None and part.isdigit() and int(part) < len(node):
                by_id = node[int(part)]
            node = by_id
        elif isinstance(node, dict):
            node = node.get(part)
        else:
            return None
    return node


class Request:
    """One request with the limits, tolerances and map that it is judged by."""

    def __init__(self, spec: dict[str, Any]) -> None:
        self.spec = spec
        self.limits: dict[str, Any] = read_limits()
        self.tolerances: dict[str, Any] = read_config('tolerances.json')

    def all(self, kind: str) -> list[dict[str, Any]]:
        """Return the elements of one kind: missions, events, ..."""
        return list(self.spec.get(kind) or ())

    def one(self, path: str) -> dict[str, Any] | None:
        """Return the element at a path."""
        node = node_at(self.spec, path)
        return node if isinstance(node, dict) else None

    def limit(self, name: str) -> float:
        """Return a limit."""
        return float(self.limits[name])

    def slack(self, name: str, number: dict[str, Any]) -> float:
        """Return by how much a stated number may be missed."""
        entry = self.tolerances[name]
        share = float(entry['relative'])
        if number.get('approximate'):
            share = max(share, _ABOUT)
        return max(float(entry['absolute']), share * abs(float(number['value'])))

    def features(self, file: str) -> list[dict[str, Any]]:
        """Return the features of a file of the map."""
        return list(read_map_file(self._map_name(), file)['features'])

    def landmarks(self) -> dict[str, tuple[float, float]]:
        """Return where the landmarks of the map are, and inside its areas, by their references."""
        areas = {
            f'landmark:{f["properties"]["name"]}': _inside(f)
            for f in reversed(self.features('zones.geojson'))
            if f['properties']['kind'] != 'no_fly' and f['properties'].get('name')
        }
        return areas | {
            f'landmark:{f["properties"]["name"]}': (
                float(f['geometry']['coordinates'][0]),
                float(f['geometry']['coordinates'][1]),
            )
            for f in self.features('landmarks.geojson')
        }

    def roof(self, target: str | None) -> Any:
        """Return the outline of the buildings that a landmark stands in, None in the open."""
        centre = self.landmarks().get(target or '')
        if centre is None:
            return None
        outlines = _outlines(*_version(map_folder(self._map_name()) / 'buildings.geojson'))
        near = sorted(outlines.query(Point(centre), 'dwithin', _BESIDE_M))
        return unary_union([outlines.geometries[k] for k in near]) if near else None

    def _map_name(self) -> str:
        return str((self.spec.get('world') or {}).get('map_name', ''))


def names_of(request: Request, kind: str) -> set[str]:
    """Return the ids and group names of `uavs` or `agents`."""
    return {b[key] for b in request.all(kind) for key in ('id', 'group') if b.get(key)}


def sent_to(request: Request, uav: str | None) -> list[dict[str, Any]]:
    """Return the altitudes to which events send a UAV."""
    actions = [e.get('action') or {} for e in request.all('events')]
    return [a['altitude_m'] for a in actions if a.get('uav') == uav and a.get('altitude_m')]


def stated(number: Any) -> TypeGuard[dict[str, Any]]:
    """Return whether the prompt itself gives this number."""
    return isinstance(number, dict) and number.get('provenance') == 'explicit'


def left_open(
    number: Any, slack: float, floor: float = 0.0, ceiling: float = math.inf
) -> tuple[float, float]:
    """Return the lowest and highest value that meet a number; what is not stated is free."""
    if not stated(number):
        return floor, ceiling
    value, bound = float(number['value']), number.get('bound', 'exactly')
    low = floor if bound == 'at_most' else max(floor, value - slack)
    high = ceiling if bound == 'at_least' else min(ceiling, value + slack)
    return low, high


def fact_holds(request: Request, fact: Fact) -> Step:
    """Look a fact up where it says that it stands."""
    if fact.source is FactSource.REQUEST:
        found = node_at(request.spec, fact.path)
        if isinstance(found, dict) and 'value' in found:
            if not stated(found):
                return False, f'{fact.path} is {found.get("provenance")}, not stated'
            found = found['value']
    elif fact.source is FactSource.LIMITS:
        found = node_at(request.limits, fact.path)
    elif fact.source is FactSource.TOLERANCES:
        found = node_at(request.tolerances, fact.path)
    else:
        files = ('zones.geojson', 'buildings.geojson')
        properties = [f['properties'] for file in files for f in request.features(file)]
        found = node_at(properties, fact.path)
    return found == fact.value, f'{fact.source} has {fact.path} = {found}'


def was_read(proof: Certificate, spec: dict[str, Any] | None) -> list[Step]:
    """No number that the proof rests on stands in words that the reader did not understand."""
    if spec is None:
        return []
    unread = [c['span'] for c in spec.get('clauses') or () if c['status'] == 'not_encoded']
    paths = {proof.path, *(f.path for f in proof.facts if f.source is FactSource.REQUEST)}
    numbers = {p: n for p in paths if isinstance(n := node_at(spec, p), dict) and 'value' in n}
    return [
        (False, f'{path} stands in words that were not read')
        for path, number in sorted(numbers.items())
        for words in unread
        if (at := number.get('span'))
        and words['start'] <= at['start']
        and at['end'] <= words['end']
    ]


def clauses_quoted(proof: Certificate, spec: dict[str, Any] | None) -> list[Step]:
    """The prompt has the clauses that the proof names."""
    if spec is None:
        return []
    prompt = str(spec.get('prompt', ''))
    return [(c in prompt, f'the prompt says {c!r}') for c in proof.clauses]


def quoted(proof: Certificate, spec: dict[str, Any] | None, word: str = '') -> list[Step]:
    """The prompt has words, or this word, where the proof points."""
    if spec is None or proof.span is None:
        return []
    words = str(spec.get('prompt', ''))[proof.span.start : proof.span.end]
    if word:
        same = word.casefold() in words.casefold() or words.casefold() in word.casefold()
        return [(bool(words) and same, f'the prompt says {words!r} there')]
    return [(bool(words.strip()), f'the prompt says {words!r} there')]
