# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Tables of who comes near whom: an event that waits for it happens, whoever they are.

Nobody says how they meet; a tracked vehicle is told of it, or brakes.
"""

from __future__ import annotations

from collections.abc import Iterator

from aurora_bench.matrix.cells import Cell, agent, does, empty, flies, stands, uav, when
from aurora_bench.prompts.documents import Doc
from aurora_core.spec.vocabulary import BehaviorKind, Place, Relation

# How near, m: in words, since a number in a prompt would be what it states.
_NEAR_M = {15.0: 'close', 30.0: 'near', 60.0: 'about'}
_FLOWN_M = {40.0: 'close', 60.0: 'near', 100.0: 'about'}
_EGO = agent('ego', 'car', 'ego')
_TELLS: Doc = {'do': 'send_message', 'sender': 'uav1', 'receiver': 'ego'}
_BRAKES: Doc = {'do': 'brake', 'agent': 'ego'}

_TYPES = ('van', 'truck', 'bus', 'bicycle')
# Where who comes near is at first, and how far from the ego that is said to be (m).
_AT_FIRST: tuple[tuple[str, str | None, float | None], ...] = (
    ('', None, None),
    (Relation.BEHIND, 'ego', 45.0),
    (Relation.AHEAD, 'ego', 40.0),
    (Relation.ONCOMING, 'ego', None),
    (Relation.ADJACENT_LANE, 'ego', None),
    (Relation.PARKED_AT, Place.ROADSIDE, None),
    (Relation.AT, Place.INTERSECTION, None),
    (Relation.ON, Place.MAIN_ROAD, None),
)
_PERSONS: tuple[tuple[str, str | None], ...] = (
    ('', None),
    (BehaviorKind.WAIT, Place.CROSSWALK),
    (BehaviorKind.CROSS, None),
    (BehaviorKind.WALK, Place.SIDEWALK),
)


def meetings(landmark: str) -> Iterator[Cell]:
    """Yield the cells of vehicles, persons and units that come near the ego, and of UAVs."""
    yield from _vehicles()
    yield from _persons()
    yield from _units(landmark)
    yield from _flown()


def _vehicles() -> Iterator[Cell]:
    for kind in _TYPES:
        for relation, of, metres in _AT_FIRST:
            row = f'{kind} {relation} {of or ""}'.strip()
            for near_m in _NEAR_M:
                if metres is not None and near_m >= metres:
                    yield from empty('Comes near', row, (_NEAR_M[near_m],), 'it is from the start')
                    continue
                told = {} if metres is None else {'distance_m': metres}
                there = [stands('other', relation, of, **told)] if relation else []
                yield _met(row, near_m, [agent('other', kind), *there], _TELLS)


def _persons() -> Iterator[Cell]:
    for behavior, target in _PERSONS:
        for relation, of in ((Relation.ON, Place.SIDEWALK), (Relation.AHEAD, 'ego')):
            row = f'person {relation} {of} {behavior} {target or ""}'.strip()
            acts = [does('other', behavior, target)] if behavior else []
            there = [stands('other', relation, of), *acts]
            for near_m in _NEAR_M:
                yield _met(row, near_m, [agent('other', 'pedestrian'), *there], _BRAKES)


def _units(landmark: str) -> Iterator[Cell]:
    for of in (Place.INTERSECTION, Place.ROADSIDE, Place.CROSSWALK, landmark):
        unit = [agent('other', 'rsu'), stands('other', Relation.AT, of)]
        name = 'landmark' if of == landmark else of
        for near_m in list(_NEAR_M)[1:]:
            yield _met(f'unit at {name}', near_m, unit, {**_TELLS, 'sender': 'other'})


def _flown() -> Iterator[Cell]:
    """Yield who comes near a UAV that tracks, hovers or patrols."""
    ways: dict[str, Doc] = {
        'that tracks the ego': flies('track', 'ego', altitude_m=30.0),
        'that hovers': flies('hover', 'intersection', altitude_m=30.0),
        'on a patrol': flies('navigate', None, pattern='rectangle', size_m=[80.0, 60.0]),
    }
    for name, mission in ways.items():
        for kind in ('car', 'bicycle', 'pedestrian'):
            for near_m in _FLOWN_M:
                other = [_EGO, agent('other', kind), uav(), mission]
                near: Doc = {'on': 'distance_below', 'a': 'other', 'b': 'uav1', 'value_m': near_m}
                yield Cell(
                    table='Comes near a UAV', row=f'{kind}, {name}', column=_FLOWN_M[near_m],
                    parts=[*other, when(near, _TELLS)],
                )  # fmt: skip


def _met(row: str, near_m: float, other: list[Doc], action: Doc) -> Cell:
    near: Doc = {'on': 'distance_below', 'a': 'other', 'b': 'ego', 'value_m': near_m}
    tracked = [uav(), flies('track', 'ego', altitude_m=40.0)]
    return Cell(
        table='Comes near', row=row, column=_NEAR_M[near_m],
        parts=[_EGO, *other, *tracked, when(near, action)],
    )  # fmt: skip
