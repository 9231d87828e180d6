# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Tables about bodies on the ground: behaviours, triggers, actions, relations and places."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import get_args

from aurora_bench.matrix.cells import Cell, agent, does, empty, flies, stands, uav, when
from aurora_bench.prompts.documents import Doc
from aurora_bench.prompts.format import Action, Trigger
from aurora_core.spec.events import AgentDo
from aurora_core.spec.vocabulary import BehaviorKind, Place, Relation

_EGO = (agent('ego', 'car', 'ego'), does('ego', 'drive'))
_BODIES = ('vehicle', 'person')
# Towards whom a behaviour is; nobody for every other kind.
_TOWARDS = {
    BehaviorKind.FOLLOW: 'ego',
    BehaviorKind.TAILGATE: 'ego',
    BehaviorKind.OVERTAKE: 'ego',
    BehaviorKind.APPROACH: Place.INTERSECTION.value,
    BehaviorKind.YIELD: 'ped1',
}
_ONLY_DRIVEN = frozenset(
    {
        BehaviorKind.DRIVE, BehaviorKind.CIRCULATE, BehaviorKind.TAILGATE, BehaviorKind.OVERTAKE,
        BehaviorKind.BRAKE, BehaviorKind.CHANGE_LANE, BehaviorKind.EMERGENCY_RUN,
        BehaviorKind.PARK,
    }
)  # fmt: skip
_ONLY_WALKED = frozenset({BehaviorKind.WALK, BehaviorKind.CROSS})
_LANES = frozenset({Relation.ADJACENT_LANE, Relation.SAME_LANE, Relation.ONCOMING})
_SIDES = frozenset({Relation.AHEAD, Relation.BEHIND, Relation.LEFT, Relation.RIGHT})
_SURFACES = frozenset({Place.SIDEWALK, Place.ROADSIDE, Place.MAIN_ROAD})


def behaviours() -> Iterator[Cell]:
    """Yield what vehicles and persons do."""
    for kind in BehaviorKind:
        for body in _BODIES:
            name = f'{kind.value}'
            driven = body == 'vehicle'
            if kind in (_ONLY_WALKED if driven else _ONLY_DRIVEN):
                why = 'persons do this' if driven else 'vehicles do this'
                yield from empty('Behaviour', name, (body,), why)
                continue
            who = 'van1' if driven else 'ped2'
            types = {'van1': 'ambulance' if kind is BehaviorKind.EMERGENCY_RUN else 'van'}
            parts = [agent(who, types.get(who, 'pedestrian'))]
            target = _TOWARDS.get(kind)
            if target == 'ego':
                parts += _EGO
            elif target == 'ped1':
                parts += [agent('ped1', 'pedestrian'), does('ped1', 'cross')]
            yield _cell('Behaviour', name, body, [*parts, does(who, kind.value, target)])


def triggers(landmark: str) -> Iterator[Cell]:
    """Yield what lets something happen: the ego stops, or the UAV tells it."""
    for name in get_args(Trigger.model_fields['on'].annotation):
        for body, who in (('vehicle', 'van1'), ('person', 'ped1'), ('UAV', 'uav1')):
            found = _trigger(name, body, who, landmark)
            if isinstance(found, str):
                yield from empty('Trigger', name, (body,), found)
            else:
                yield _cell('Trigger', name, body, found)


def _trigger(name: str, body: str, who: str, landmark: str) -> list[Doc] | str:
    """Return the request of one trigger of one body, or why there is none."""
    flown = body == 'UAV'
    alone = {'altitude_reached', 'mission_done', 'battery_below'}
    if name in alone and not flown:
        return 'UAVs alone do this'
    if name in ('speed_below', 'speed_above') and flown:
        return 'a speed of vehicles and persons'
    if name == 'behavior_done' and flown:
        return 'what a UAV does for a time is a mission'
    if name == 'time' and body != 'vehicle':
        return 'it is nobody who does this'
    stop: Doc = {'do': 'stop', 'agent': 'ego'}
    land: Doc = {'do': 'land', 'uav': 'uav1'}
    ego = list(_EGO)
    up = [uav(), flies('hover', 'intersection', altitude_m=40.0)]
    moves = {'van1': 'drive', 'ped1': 'walk'}
    mine = [] if flown else [agent(who, {'van1': 'van'}.get(who, 'pedestrian'))]
    moving = mine + ([] if flown else [does(who, moves[who])])
    tracks = [uav(), flies('track', 'ego', altitude_m=40.0)]
    match name:
        case 'distance_below':
            near: Doc = {'on': name, 'a': who, 'b': 'ego', 'value_m': 45.0 if flown else 20.0}
            return [*ego, *moving, *(tracks if flown else []), when(near, stop)]
        case 'distance_above':
            far: Doc = {'on': name, 'a': who, 'b': 'ego', 'value_m': 35.0 if flown else 60.0}
            return [*ego, *moving, *(tracks if flown else []), when(far, stop)]
        case 'visible' | 'occluded':
            seen: Doc = {'on': name, 'observer': who, 'target': 'ego'}
            return [*ego, *moving, *(tracks if flown else []), when(seen, stop)]
        case 'time':
            return [*ego, when({'on': name, 'at_s': 15.0}, stop)]
        case 'altitude_reached':
            return [*ego, *tracks, when({'on': name, 'uav': who, 'value_m': 25.0}, stop)]
        case 'arrives' if flown:
            way = [uav(), flies('navigate', landmark, pattern='rectangle', altitude_m=40.0)]
            return [*ego, *way, when({'on': name, 'who': who, 'place': landmark}, stop)]
        case 'arrives':
            at: Doc = {'on': name, 'who': who, 'place': 'intersection'}
            return [*moving, *up, when(at, land)]
        case 'message_received':
            sender = 'van2' if flown else 'uav1'
            more = [agent('van2', 'van'), does('van2', 'drive')] if flown else []
            send: Doc = {'do': 'send_message', 'sender': sender, 'receiver': who}
            told: Doc = {'on': name, 'by': who, 'from': sender}
            start = when({'on': 'time', 'at_s': 20.0}, send, 'e0')
            then: Doc = land if flown else {'do': 'stop', 'agent': who}
            return [*moving, *more, *up, start, when(told, then)]
        case 'speed_below' | 'speed_above':
            limit = {'van1': 5.0, 'ped1': 0.5}[who]
            return [*moving, *up, when({'on': name, 'who': who, 'value_mps': limit}, land)]
        case 'event_done' | 'event_begun':
            first: Doc = {'do': 'ascend', 'uav': who, 'altitude_m': 50.0}
            acts = first if flown else {'do': 'stop', 'agent': who}
            e0 = when({'on': 'time', 'at_s': 20.0}, acts, 'e0')
            return [*moving, *up, e0, when({'on': name, 'event': 'e0', 'after_s': 3.0}, land)]
        case 'behavior_done':
            lasts: Doc = {'on': name, 'who': who, 'behavior': moves[who]}
            return [*mine, does(who, moves[who], duration_s=15.0), *up, when(lasts, land)]
        case 'mission_done':
            return [*ego, *tracks, when({'on': name, 'uav': who}, stop)]
        case 'battery_below':
            return [*up, when({'on': name, 'uav': who, 'value': 0.97}, land)]
        case _:
            return f'the matrix has no request for {name} yet'


def actions(landmark: str) -> Iterator[Cell]:
    """Yield what events let happen, 20 s after the start."""
    driven = set(get_args(AgentDo))
    for name in get_args(Action.model_fields['do'].annotation):
        for body, who in (('vehicle', 'van1'), ('person', 'ped1'), ('UAV', 'uav1')):
            flown = body == 'UAV'
            if name != 'send_message' and (name in driven) is flown:
                why = 'UAVs alone do this' if not flown else 'vehicles and persons do this'
                yield from empty('Action', name, (body,), why)
                continue
            if name in ('brake', 'accelerate', 'change_lane') and body == 'person':
                yield from empty('Action', name, (body,), 'vehicles do this')
                continue
            if name == 'cross' and body == 'vehicle':
                yield from empty('Action', name, (body,), 'persons do this')
                continue
            yield _cell('Action', name, body, _action(name, who, landmark))


def _action(name: str, who: str, landmark: str) -> list[Doc]:
    flown = who == 'uav1'
    parts: list[Doc] = []
    if flown:
        parts += [uav(), flies('hover', 'intersection', altitude_m=40.0)]
    else:
        parts.append(agent(who, {'van1': 'van'}.get(who, 'pedestrian')))
        if name not in ('start', 'cross'):
            parts.append(does(who, {'van1': 'drive'}.get(who, 'walk')))
    after: Doc = {'on': 'time', 'at_s': 20.0}
    fields: Doc = {'uav': who} if flown else {'agent': who}
    if name == 'send_message':
        receiver = 'car9'
        parts += [agent(receiver, 'car'), does(receiver, 'drive')]
        fields = {'sender': who, 'receiver': receiver}
    elif name == 'ascend':
        fields['altitude_m'] = 60.0
    elif name == 'change_mission':
        fields |= {'mode': 'hover', 'target': landmark, 'altitude_m': 60.0}
    elif name == 'hand_over':
        parts = [agent('car9', 'car'), does('car9', 'drive'), uav(), uav('uav2')]
        parts.append(flies('track', 'car9', altitude_m=40.0))
        fields['to'] = 'uav2'
    elif name == 'yield':
        parts += [agent('ped9', 'pedestrian'), does('ped9', 'cross')]
    return [*parts, when(after, {'do': name, **fields})]


def relations(landmark: str) -> Iterator[Cell]:
    """Yield where a vehicle or a person stands at t = 0, to whom or at what."""
    others = ('vehicle', 'person', *(p.value for p in Place), 'landmark')
    for who, table in (('van1', 'Place of a vehicle'), ('ped1', 'Place of a person')):
        for relation in Relation:
            for of in others:
                why = _senseless(relation, of, is_person=who == 'ped1')
                if why:
                    yield from empty(table, relation.value, (of,), why)
                    continue
                name = {'vehicle': 'ego', 'person': 'ped9', 'landmark': landmark}.get(of, of)
                parts = list(_EGO) if of == 'vehicle' else []
                parts += [agent('ped9', 'pedestrian')] if of == 'person' else []
                numbers = {'distance_m': 25.0} if relation in _SIDES or _stated(relation) else {}
                kind = 'pedestrian' if who == 'ped1' else 'van'
                there = stands(who, relation.value, name, **_fitting(relation, of, numbers))
                yield _cell(table, relation.value, of, [*parts, agent(who, kind), there])


def _stated(relation: Relation) -> bool:
    return relation in (Relation.SAME_LANE, Relation.ONCOMING, Relation.NEAR, Relation.BEFORE)


def _fitting(relation: Relation, of: str, numbers: dict[str, float]) -> dict[str, float]:
    """Return the stated numbers of a relation: none of a side of somebody beside."""
    beside = relation in (Relation.LEFT, Relation.RIGHT) and of in ('vehicle', 'person')
    flat = of in {p.value for p in _SURFACES}
    return {} if beside or flat else numbers


def _senseless(relation: Relation, of: str, *, is_person: bool) -> str:
    """Return why nobody says this, '' where somebody may."""
    if relation in _LANES and (is_person or of != 'vehicle'):
        return 'lanes relate vehicles'
    if relation in _SIDES and of in ('intersection', 'crosswalk', 'landmark'):
        return 'a place has no heading; before says where one comes from'
    if of in ('vehicle', 'person') and relation in (Relation.ON, Relation.AT, Relation.PARKED_AT):
        return 'of places'
    if relation is Relation.PARKED_AT and is_person:
        return 'vehicles park'
    if of in {p.value for p in _SURFACES} and relation not in (
        Relation.ON, Relation.AT, Relation.NEAR, Relation.PARKED_AT,
    ):  # fmt: skip
        return 'it runs along everywhere'
    if relation is Relation.BEFORE and of in ('vehicle', 'person'):
        return 'of places; ahead and behind say it'
    if relation is Relation.ON and of == 'landmark':
        return 'nobody stands on a building'
    return ''


def _cell(table: str, row: str, column: str, parts: Sequence[Doc]) -> Cell:
    return Cell(table=table, row=row, column=column, parts=parts)
