# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a map lacks, and which requests that touches, in plain words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from aurora_core.knowledge.folds import folds_back_m
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import MapRecords
from aurora_core.knowledge.road_network import RoadNetwork

# "closing from 45 meters" and a follow of half a minute need about this much road ahead (m).
_LONG_M = 150.0
_SHARE = 0.98
# A usual view of a UAV: so high, so far away (m); with less of the streets in sight it is lost.
_VIEW_M = (40.0, 50.0)
_SEEN_SHARE = 0.5
_GUESSED = ('default', 'default of its kind')


@dataclass(frozen=True, slots=True)
class MapGap:
    """Something that a map lacks, and what that means for requests."""

    lacks: str
    means: str

    @property
    def text(self) -> str:
        """Both in one line."""
        return f'{self.lacks}: {self.means}'


def map_gaps(model: MapModel, measured: MapRecords | None = None) -> tuple[MapGap, ...]:
    """Return what a map lacks for some kinds of request, the weightiest first.

    Args:
        model: Map.
        measured: What was measured on it; what only that tells is left out without.
    """
    tried = () if measured is None else _tried(measured)
    return (*_roads(model.network), *_walking(model.network), *_surroundings(model), *tried)


def _tried(measured: MapRecords) -> Iterator[MapGap]:
    """Yield what did not work where it was tried."""
    apart: dict[str, list[str]] = {}
    for part in measured.parts:
        if part.largest_share < _SHARE:
            apart.setdefault(f'{1.0 - part.largest_share:.0%}', []).append(part.vehicle_class)
    for share, classes in apart.items():
        yield MapGap(
            f'unconnected roads, {share} of the length for {", ".join(classes)}',
            'vehicles that are placed there cannot come back, and none can be sent there',
        )
    for walk, name in ((measured.sidewalks, 'sidewalks'), (measured.crossings, 'crossings')):
        if walk.walked < walk.tried:
            yield MapGap(
                f'{walk.tried - walk.walked} of {walk.tried} {name} that nobody gets along',
                'no pedestrian is placed there',
            )
    seen = next((s for s in measured.sight if (s.height_m, s.distance_m) == _VIEW_M), None)
    if seen is not None and seen.free_share < _SEEN_SHARE:
        yield MapGap(
            f'narrow streets: {seen.free_share:.0%} seen from {seen.height_m:.0f} m up and '
            f'{seen.distance_m:.0f} m away',
            'a UAV that is not right above somebody often loses sight',
        )
    worst = min(measured.spawns, key=lambda s: s.stands / max(1, s.tried), default=None)
    if worst is not None and worst.stands < _SHARE * worst.tried:
        yield MapGap(
            f'{worst.tried - worst.stands} of {worst.tried} places where no {worst.type_name} '
            'stands',
            'none is placed there',
        )


def _roads(network: RoadNetwork) -> Iterator[MapGap]:
    lanes = network.driving_lanes('passenger')
    folds = _folds(network)
    if folds:
        yield MapGap(
            f'lanes that fold back on themselves at {", ".join(folds[:3])}'
            + (f' and {len(folds) - 3} more' if len(folds) > 3 else ''),
            'no vehicle is led over one of more than a metre',
        )
    by_edge = Counter(lane.edge_id for lane in lanes)
    if all(count < 2 for count in by_edge.values()):
        yield MapGap(
            'no street with two lanes in a direction',
            'no lane change, overtaking or cutting in',
        )
    if all(network.opposite_edge(lane.edge_id) is None for lane in lanes):
        yield MapGap('no street with two directions', 'nobody can be oncoming')
    if all(edge.length_m < _LONG_M for edge in network.edges.values()):
        yield MapGap(
            f'no street longer than {_LONG_M:.0f} m without a junction',
            'fast or long manoeuvres, such as closing in from far behind, may find no room',
        )
    if not any(junction.has_signal for junction in network.junctions.values()):
        yield MapGap('no traffic light', 'nothing can stop at or run a red light')
    if not network.street_names:
        yield MapGap('no street names', 'pictures and reports name lanes by their ids')


def _folds(network: RoadNetwork) -> tuple[str, ...]:
    """Return the junctions in which a lane for cars goes on backwards, by id."""
    found = {
        network.edge(network.lane(link.from_lane_id).edge_id).to_junction
        for link in network.connections
        if folds_back_m(link, network.lanes) > 0.0
        and all(
            'passenger' in network.lane(name).allows
            for name in (link.from_lane_id, link.to_lane_id)
        )
    }
    return tuple(sorted(found))


def _walking(network: RoadNetwork) -> Iterator[MapGap]:
    if not network.sidewalks:
        yield MapGap('no walkway', 'no pedestrian can be placed')
    elif not network.crossings:
        yield MapGap('no crossing', 'no pedestrian can cross a street at a crosswalk')


def _surroundings(model: MapModel) -> Iterator[MapGap]:
    if not model.buildings:
        yield MapGap(
            'no buildings',
            'nothing blocks a view, a radio link or a flight: such margins are optimistic',
        )
    guessed = sum(b.height_source in _GUESSED for b in model.buildings)
    if guessed:
        yield MapGap(
            f'no measured height for {guessed} of {len(model.buildings)} buildings',
            'their heights are defaults: clearances and views over them are guesses',
        )
    if not model.landmarks:
        yield MapGap('no landmarks', 'no place can be named, as in "hovers over City Hall"')
    if not model.bus_stops:
        yield MapGap('no bus stops', 'buses stop nowhere in particular')
