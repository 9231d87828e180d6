# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Tables about flights, sides, links, observers, winds and zones."""

from __future__ import annotations

from collections.abc import Iterator
from typing import get_args

from aurora_bench.matrix.cells import Cell, agent, does, empty, flies, stands, uav, when
from aurora_bench.prompts.documents import Doc
from aurora_bench.prompts.format import LinkRequirement, PatternName
from aurora_core.spec.vocabulary import (
    AgentType,
    MissionMode,
    Pattern,
    RelativeWind,
    Side,
    TimeOfDay,
    Weather,
)

_CAR = (agent('car1', 'car'), does('car1', 'drive'))
_PLACES = ('intersection', 'crosswalk', 'main_road', 'landmark')


def missions(landmark: str) -> Iterator[Cell]:
    """Yield the modes, over everybody that they can be about."""
    types = tuple(t.value for t in AgentType)
    for mode in MissionMode:
        for target in (*types, *_PLACES, 'nobody'):
            if mode is MissionMode.TRACK and target in ('nobody', *_PLACES):
                yield from empty('Mission', target, (mode.value,), 'one tracks a body')
                continue
            pattern = {'pattern': 'orbit'} if mode is MissionMode.NAVIGATE else {}
            parts: list[Doc] = []
            aim: str | None = target
            if target in types:
                moves = {'pedestrian': 'walk', 'rsu': ''}.get(target, 'drive')
                parts.append(agent('it1', target))
                parts += [does('it1', moves)] if moves and not pattern else []
                aim = 'it1'
            elif target == 'landmark':
                aim = landmark
            elif target == 'nobody':
                aim = None
            flight = flies(mode.value, aim, altitude_m=40.0, **pattern)
            parts += [uav(), flight]
            yield Cell(table='Mission', row=target, column=mode.value, parts=parts)


def patterns(landmark: str) -> Iterator[Cell]:
    """Yield the patterns, over whom or what they are."""
    own = {name.value for name in Pattern}
    names = (*sorted(own), *(n for n in get_args(get_args(PatternName)[1]) if n not in own))
    for name in names:
        for over in ('vehicle', 'intersection', 'landmark', 'nobody'):
            aim = {'vehicle': 'car1', 'landmark': landmark, 'nobody': None}.get(over, over)
            parts = [agent('car1', 'car')] if over == 'vehicle' else []
            fields: Doc = {'altitude_m': 40.0, 'pattern': name}
            if name == 'facade':
                if over != 'landmark':
                    yield from empty('Pattern', name, (over,), 'buildings have facades')
                    continue
                fields['altitude_m'] = (15.0, 35.0)
            if name == 'street':
                if over != 'nobody':
                    yield from empty('Pattern', name, (over,), 'it is along a street by name')
                    continue
                aim = STREET
            parts += [uav(), flies('navigate', aim, **fields)]
            yield Cell(table='Pattern', row=name, column=over, parts=parts)


# A street by name is that of the map; see `street_of`.
STREET = 'street'


def sides() -> Iterator[Cell]:
    """Yield the sides of a moving target."""
    for side in Side:
        for kind in ('car', 'bus', 'motorcycle', 'bicycle', 'pedestrian'):
            moves = 'walk' if kind == 'pedestrian' else 'drive'
            parts = [agent('it1', kind), does('it1', moves), uav()]
            flight = flies('track', 'it1', side=side.value, altitude_m=30.0, standoff_m=20.0)
            yield Cell(table='Side', row=side.value, column=kind, parts=[*parts, flight])


def links() -> Iterator[Cell]:
    """Yield who tells whom, and each property of a link."""
    bodies = {
        'vehicle': ([agent('van1', 'van'), does('van1', 'drive')], 'van1'),
        'person': ([agent('ped1', 'pedestrian')], 'ped1'),
        'rsu': ([agent('unit1', 'rsu')], 'unit1'),
        'UAV': ([uav(), flies('hover', 'intersection', altitude_m=40.0)], 'uav1'),
    }
    for sender, (ours, one) in bodies.items():
        for receiver, (theirs, other) in bodies.items():
            if sender == receiver:
                if sender != 'vehicle':
                    yield from empty('Link', sender, (receiver,), 'asked of vehicles')
                    continue
                theirs, other = [agent('van2', 'van'), does('van2', 'drive')], 'van2'
            send: Doc = {'do': 'send_message', 'sender': one, 'receiver': other}
            parts = [*ours, *theirs, when({'on': 'time', 'at_s': 25.0}, send)]
            yield Cell(table='Link', row=sender, column=receiver, parts=parts)
    numbers: dict[str, object] = {
        'loss': 0.2, 'latency_s': 0.3, 'range_m': 300.0, 'retransmissions': 2.0,
        'outage_s': (20.0, 30.0), 'rate_hz': 2.0,
    }  # fmt: skip
    for field in LinkRequirement.model_fields:
        if field in ('id', 'negate', 'tol', 'kind', 'sender', 'receiver'):
            continue
        link: Doc = {'kind': 'link', 'sender': 'uav1', 'receiver': 'car1'}
        ours = [*_CAR, uav(), flies('track', 'car1', altitude_m=40.0)]
        tell: Doc = {'do': 'send_message', 'sender': 'uav1', 'receiver': 'car1'}
        ours.append({**link, field: numbers.get(field, 1.0)})
        if field != 'rate_hz':
            ours.append(when({'on': 'time', 'at_s': 35.0}, tell))
        yield Cell(table='Property of a link', row=field, column='stated', parts=ours)


def observers(landmark: str) -> Iterator[Cell]:
    """Yield who sees whom, most of the time."""
    for observer in ('vehicle', 'person', 'UAV'):
        for target in ('vehicle', 'person', 'landmark'):
            seen = {'vehicle': 'van1', 'person': 'ped1', 'landmark': landmark}[target]
            parts = [agent('van1', 'van')] if target == 'vehicle' else []
            parts += [agent('ped1', 'pedestrian')] if target == 'person' else []
            one = {'vehicle': 'car1', 'person': 'ped9', 'UAV': 'uav1'}[observer]
            near: Doc | None = None
            if observer == 'UAV':
                aim = seen if target != 'landmark' else landmark
                parts += [uav(), flies('hover', aim, altitude_m=40.0)]
            else:
                parts.append(agent(one, 'car' if observer == 'vehicle' else 'pedestrian'))
                place = landmark if target == 'landmark' else seen
                relation = 'behind' if observer == 'vehicle' and target == 'vehicle' else 'near'
                near = stands(one, relation, place, distance_m=25.0)
                if target == 'person' and observer == 'vehicle':
                    near = stands('ped1', 'ahead', 'car1', distance_m=25.0)
            parts += [] if near is None else [near]
            says: Doc = {
                'kind': 'condition', 'quantity': 'visible_time', 'of': (one, seen), 'op': '>=',
                'value': 5.0,
            }  # fmt: skip
            yield Cell(table='Observer', row=observer, column=target, parts=[*parts, says])


def worlds(landmark: str) -> Iterator[Cell]:
    """Yield weathers, lights and winds, in each mode."""
    settings: dict[str, list[Doc]] = {w.value: [_world('weather', w.value)] for w in Weather}
    settings |= {t.value: [_world('time_of_day', t.value)] for t in TimeOfDay}
    for speed in (5.0, 10.0):
        settings[f'{speed:g} m/s'] = [_world('wind_mps', speed)]
        from_west = [_world('wind_mps', speed), _world('wind_from_deg', 270.0)]
        settings[f'{speed:g} m/s from 270 deg'] = from_west
        for wind in RelativeWind:
            both = [_world('wind', wind.value), _world('wind_mps', speed)]
            settings[f'{wind.value} {speed:g} m/s'] = both
    for name, world in settings.items():
        hover = flies('hover', landmark, altitude_m=50.0)
        track = flies('track', 'car1', altitude_m=30.0)
        line = flies('navigate', None, pattern='line', altitude_m=40.0)
        for mode, flight in (('hover', hover), ('track', track), ('navigate', line)):
            body = _CAR if mode == 'track' else ()
            cell = [*world, *body, uav(), flight]
            yield Cell(table='World', row=name, column=mode, parts=cell)


def zones(landmark: str, other: str) -> Iterator[Cell]:
    """Yield what is to be kept away from, in each mode."""
    hows: tuple[tuple[str, Doc], ...] = (('avoided', {}), ('40 m off', {'avoid_m': 40.0}))
    for how, fields in hows:
        for mode in MissionMode:
            aim = {'hover': landmark, 'track': 'car1', 'navigate': landmark}[mode.value]
            body = _CAR if mode is MissionMode.TRACK else ()
            pattern = {'pattern': 'orbit'} if mode is MissionMode.NAVIGATE else {}
            stated: Doc = {'altitude_m': 40.0, 'avoid': (other,), **fields, **pattern}
            flight = {**flies(mode.value, aim), **stated}
            cell = [*body, uav(), flight]
            yield Cell(table='Zone', row=how, column=mode.value, parts=cell)
    ends: dict[str, Doc] = {'from A to B': {'start': landmark, 'end': other}}
    for name, more in ends.items():
        flight = flies('navigate', None, pattern='waypoints', altitude_m=60.0, **more)
        yield Cell(table='Zone', row=name, column='navigate', parts=[uav(), flight])


def _world(field: str, value: str | float) -> Doc:
    return {'kind': 'world', 'field': field, 'value': value}
