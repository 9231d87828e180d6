# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The trace hash: the same for the same run, another for any change of what it covers."""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Callable
from dataclasses import fields, replace
from enum import IntEnum
from typing import Any

import numpy as np
import pytest

from aurora_core.knowledge.world import SurfaceKind
from aurora_core.trace.hashing import _Encoder, trace_hashes, trace_sha256, world_sha256
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.records import LinkEventKind, LossReason, ScenarioEventKind
from aurora_core.trace.trace import Integrity, Trace

_OTHER: dict[type, IntEnum] = {
    LinkEventKind: LinkEventKind.FAILED,
    LossReason: LossReason.RANGE,
    ScenarioEventKind: ScenarioEventKind.FINISHED,
    GroundCommandKind: GroundCommandKind.REMOVE,
    SurfaceKind: SurfaceKind.SIDEWALK,
}


def _changed(value: Any) -> Any:
    """Return the smallest change of a value."""
    if isinstance(value, IntEnum):
        return _OTHER[type(value)]
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + 1
    if isinstance(value, float):
        return float(np.nextafter(value, 2.0 * abs(value) + 1.0))
    if isinstance(value, str):
        return value + ' '
    if isinstance(value, np.ndarray):
        return np.nextafter(value, 1e9)
    if isinstance(value, tuple):
        return value[:-1]
    raise TypeError(type(value).__name__)


def _variants(record: Any) -> list[tuple[str, Any]]:
    return [
        (f.name, replace(record, **{f.name: _changed(getattr(record, f.name))}))
        for f in fields(record)
        if f.init
        and not (isinstance(getattr(record, f.name), tuple) and not getattr(record, f.name))
    ]


def test_every_field_of_every_record_counts(
    make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    trace, world = make_trace(), make_world()
    first = trace_hashes(trace, world)
    seen = {first.trace_sha256: 'original', first.motion_sha256: 'motion of the original'}

    def check(name: str, changed: Trace) -> None:
        hashes = trace_hashes(changed, world)
        for digest in (hashes.trace_sha256, hashes.motion_sha256):
            assert digest not in seen, (name, seen.get(digest))
            seen[digest] = name

    for name, record in _variants(trace.links[1]):
        check(f'link {name}', replace(trace, links=(trace.links[0], record, trace.links[2])))
    for name, record in _variants(trace.sights[1]):
        check(f'sight {name}', replace(trace, sights=(trace.sights[0], record)))
    for name, record in _variants(trace.events[1]):
        check(f'event {name}', replace(trace, events=(trace.events[0], record)))
    for name, command in _variants(trace.ground_commands[4][0]):
        commands = (*trace.ground_commands[:4], (command,), *trace.ground_commands[5:])
        check(f'command {name}', replace(trace, ground_commands=commands))
    for name, entry in _variants(trace.roster.agents[0]):
        agents = (entry, *trace.roster.agents[1:])
        check(f'agent {name}', replace(trace, roster=replace(trace.roster, agents=agents)))
    for name, entry in _variants(trace.roster.uavs[0]):
        check(f'uav {name}', replace(trace, roster=replace(trace.roster, uavs=(entry,))))
    check('dt', replace(trace, roster=replace(trace.roster, dt_s=0.1)))
    for kind in ('ground', 'uav', 'uav_commands'):
        for place in ((1, 0, 0), (trace.ticks - 1, 0, 5)):
            rows = getattr(trace, kind).copy()
            rows[place] = np.nextafter(rows[place], 1e9)
            check(f'{kind} {place}', replace(trace, **{kind: rows}))
    check('lost event', replace(trace, events=trace.events[:1]))
    check('sign of zero', replace(trace, uav_commands=-trace.uav_commands))


def test_every_field_of_the_world_counts(make_world: Callable[..., Any]) -> None:
    world = make_world()
    seen = {world_sha256(world): 'original'}

    def check(name: str, changed: Any) -> None:
        digest = world_sha256(changed)
        assert digest not in seen, (name, seen.get(digest))
        seen[digest] = name

    whole = {'wind', 'buildings', 'no_fly_zones', 'surfaces', 'lanes', 'signals', 'places'}
    for f in fields(world):
        if f.init and f.name not in whole | {'limits'}:
            check(f.name, replace(world, **{f.name: _changed(getattr(world, f.name))}))
    for f in fields(world.wind):
        wind = replace(world.wind, **{f.name: getattr(world.wind, f.name) + 1.0})
        check(f'wind {f.name}', replace(world, wind=wind))
    for group in sorted(whole - {'wind'}):
        members = getattr(world, group)
        for name, member in _variants(members[0]):
            check(f'{group} {name}', replace(world, **{group: (member, *members[1:])}))
        check(f'{group} lost', replace(world, **{group: members[:-1]}))
    limits = world.limits.model_copy(update={'uavs_max': 11})
    check('limits', replace(world, limits=limits))


def test_the_motion_is_the_same_in_another_world(
    make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    trace, world = make_trace(), make_world()
    told = replace(world, conditions_json='[{}]')
    before, after = trace_hashes(trace, world), trace_hashes(trace, told)
    assert before.motion_sha256 == after.motion_sha256
    assert before.trace_sha256 != after.trace_sha256


def test_what_is_not_covered_does_not_count(
    make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    trace, world = make_trace(), make_world()
    noted = replace(trace, integrity=Integrity.ALTERED, integrity_note='x', missing_ticks=(1,))
    assert trace_sha256(noted, world) == trace_sha256(trace, world)


def test_order_of_sights_in_the_file_does_not_count(
    make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    trace, world = make_trace(), make_world()
    turned = replace(trace, sights=trace.sights[::-1])
    assert trace_sha256(turned, world) == trace_sha256(trace, world)


def test_hash_is_the_same_on_every_machine() -> None:
    """A change of the canonical encoding breaks every stored hash: it has to be deliberate."""
    encoder = _Encoder()
    for value in ('ä', -2, True, 0.1, np.array([[1.0], [2.0]]), (3, ('x',))):
        encoder.add(value)
    expected = hashlib.sha256()
    for tag, size, data in (
        (b's', 2, 'ä'.encode()),
        (b'i', 1, struct.pack('<q', -2)),
        (b'i', 1, struct.pack('<q', 1)),
        (b'f', 1, struct.pack('<d', 0.1)),
        (b'a', 2, struct.pack('<dd', 1.0, 2.0)),
        (b't', 2, b''),
        (b'i', 1, struct.pack('<q', 3)),
        (b't', 1, b''),
        (b's', 1, b'x'),
    ):
        expected.update(tag + struct.pack('<Q', size) + data)
    assert encoder.hexdigests()[0] == expected.hexdigest()


def test_neighbouring_values_do_not_run_together() -> None:
    def digest(*values: object) -> str:
        encoder = _Encoder()
        for value in values:
            encoder.add(value)
        return encoder.hexdigests()[0]

    assert digest('ab', 'c') != digest('a', 'bc')
    assert digest((1, 2), ()) != digest((1,), (2,))
    assert digest(1) != digest(1.0)
    assert digest('1') != digest(1)
    assert digest(np.array([1.0]), np.array([2.0])) != digest(np.array([1.0, 2.0]))


def test_what_has_no_encoding_is_refused() -> None:
    with pytest.raises(TypeError, match='NoneType'):
        _Encoder().add(None)
