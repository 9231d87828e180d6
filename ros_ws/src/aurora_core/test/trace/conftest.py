# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A small made-up run with every kind of record, and a recorder for it."""

from __future__ import annotations

import random
import resource
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from types import ModuleType

import forging as _forging
import numpy as np
import pytest

from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.knowledge.map_types import Building, NoFlyZone
from aurora_core.knowledge.world import (
    CentreLine,
    NamedPlace,
    SignalPost,
    Surface,
    SurfaceKind,
    Wind,
    WorldModel,
)
from aurora_core.trace import messages
from aurora_core.trace.bag_writer import BagSummary, BagWriter
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.layout import (
    GROUND_WIDTH,
    UAV_COMMAND_WIDTH,
    UAV_WIDTH,
    GroundCommandKind,
)
from aurora_core.trace.messages import MessageBuilder, time_ns
from aurora_core.trace.messages_world import world_message
from aurora_core.trace.records import (
    EventRecord,
    LinkEventKind,
    LinkRecord,
    LossReason,
    ScenarioEventKind,
    SightRecord,
)
from aurora_core.trace.roster import Roster, RosterEntry
from aurora_core.trace.trace import Trace

DT_S = 0.05

MakeTrace = Callable[..., Trace]
MakeWorld = Callable[..., WorldModel]
Record = Callable[..., BagSummary]


def _entry(body_id: str, type_name: str, system_id: int) -> RosterEntry:
    vehicle = system_id == 0
    return RosterEntry(
        body_id=body_id,
        type_name=type_name,
        is_person=type_name == 'pedestrian',
        system_id=system_id,
        length_m=4.6,
        width_m=1.8,
        height_m=1.5,
        route_edges=('a1', 'b2') if vehicle else (),
        route_xy_m=((0.1, -0.0), (1e-300, 2.0 / 3.0)) if vehicle else (),
        role='ego' if body_id == 'agent0' else 'other',
    )


def _trace(ticks: int = 45, agents: int = 2, uavs: int = 1, seed: int = 3) -> Trace:
    generator = np.random.default_rng(seed)
    ground = generator.normal(size=(ticks, agents, GROUND_WIDTH))
    uav = generator.normal(size=(ticks, uavs, UAV_WIDTH))
    flown = generator.normal(size=(ticks, uavs, UAV_COMMAND_WIDTH))
    flown[:1] = 0.0
    commands: list[tuple[GroundCommand, ...]] = [()] * ticks
    if agents and ticks > 4:
        commands[3] = (
            GroundCommand(agent=0, kind=GroundCommandKind.SET_SPEED, value=1.0 / 3.0),
            GroundCommand(
                agent=agents - 1, kind=GroundCommandKind.STOP_AT, value=2.5, value2=7.0, text='a_0'
            ),
        )
        commands[4] = (GroundCommand(agent=0, kind=GroundCommandKind.SET_ROUTE, text='a b c'),)
    roster = Roster(
        dt_s=DT_S,
        agents=tuple(
            _entry(f'agent{k}', 'pedestrian' if k == 1 else 'car', 0) for k in range(agents)
        ),
        uavs=tuple(_entry(f'uav{k + 1}', 'uav', k + 1) for k in range(uavs)),
    )
    return Trace(
        roster=roster,
        ground=ground,
        uav=uav,
        uav_commands=flown,
        ground_commands=tuple(commands),
        links=(
            _link(0, 5, LinkEventKind.SENT, LossReason.NONE),
            _link(1, 5, LinkEventKind.ATTEMPT_LOST, LossReason.RANDOM),
            _link(2, 9, LinkEventKind.DELIVERED, LossReason.NONE),
        ),
        sights=(
            SightRecord(
                tick=0, observer='uav1', target='agent0', visible=False, slant_range_m=0.1
            ),
            SightRecord(tick=7, observer='uav1', target='agent0', visible=True, slant_range_m=1e6),
        ),
        events=(
            EventRecord(
                tick=0, sequence=0, kind=ScenarioEventKind.PHASE, subject='uav1', detail='ascent'
            ),
            EventRecord(
                tick=9, sequence=1, kind=ScenarioEventKind.FAULT, subject='ägent→0', detail=''
            ),
        ),
    )


def _link(sequence: int, tick: int, kind: LinkEventKind, reason: LossReason) -> LinkRecord:
    return LinkRecord(
        tick=tick,
        sequence=sequence,
        message=1,
        link='l1',
        event='e1',
        sender='uav1',
        receiver='agent0',
        kind=kind,
        attempt=int(kind is LinkEventKind.DELIVERED),
        reason=reason,
        distance_m=123.456,
        line_of_sight=True,
    )


def _world(buildings: tuple[Building, ...] | None = None) -> WorldModel:
    square = ((0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0))
    hole_a = ((2.0, 2.0), (3.0, 2.0), (3.0, 3.0))
    hole_b = ((5.0, 5.0), (6.0, 5.0), (6.0, 6.0), (5.0, 6.0))
    default = (
        Building(
            id='b1',
            ring=square,
            holes=(hole_a, hole_b),
            height_m=12.5,
            height_source='storeys',
            kind='block',
            name='Café Überführung 東京 🚁',
        ),
        Building(
            id='b2', ring=square, holes=(), height_m=3.0, height_source='', kind='house', name=''
        ),
    )
    return WorldModel(
        map_name='made_up',
        map_digest='00' * 32,
        origin_lat_deg=47.397742,
        origin_lon_deg=-8.545594,
        weather='rain',
        time_of_day='dusk',
        wind=Wind(mean_east_mps=3.0, mean_north_mps=-0.1, gust_mps=2.0),
        buildings=default if buildings is None else buildings,
        no_fly_zones=(NoFlyZone(id='z1', name='Zone', ring=square, floor_m=0.0, ceiling_m=150.0),),
        surfaces=(
            Surface(
                surface_id='s1',
                kind=SurfaceKind.DRIVING,
                ring=np.array(square),
                holes=(np.array(hole_a), np.array(hole_b)),
            ),
            Surface(surface_id='s2', kind=SurfaceKind.CROSSING, ring=np.array(hole_a)),
        ),
        lanes=(
            CentreLine(
                lane_id='a_0',
                street_name='Elm Street',
                points=np.array(((0.0, 1.0), (1.0 / 3.0, 5.0))),
                width_m=3.2,
                speed_limit_mps=13.89,
            ),
        ),
        signals=(SignalPost(junction_id='j1', x_m=1.0, y_m=-2.0),),
        limits=load_limits(config_path('limits.json')),
        places=(NamedPlace(name='landmark:Depot', x_m=7.0, y_m=8.0),),
        conditions_json='[{"text":"é"}]',
    )


def _put_tick(
    put: Callable[[str, int, object], None], build: MessageBuilder, trace: Trace, tick: int
) -> None:
    put(messages.GROUND_STATE, tick, build.state(messages.GROUND_STATE, tick, trace.ground[tick]))
    if trace.roster.uavs:
        put(messages.UAV_STATE, tick, build.state(messages.UAV_STATE, tick, trace.uav[tick]))
    for link in (r for r in trace.links if r.tick == tick):
        put(messages.COMM, tick, build.link(link))
    for sight in (r for r in trace.sights if r.tick == tick):
        put(messages.SENSING, tick, build.sight(sight))
    for event in (r for r in trace.events if r.tick == tick):
        put(messages.EVENTS, tick, build.event(event))
    after = tick + 1
    last = after == trace.ticks
    commands = () if last else trace.ground_commands[after]
    put(messages.GROUND_COMMAND, after, build.ground_commands(after, commands))
    if trace.roster.uavs:
        rows = trace.uav_commands[0 if last else after]
        put(messages.UAV_COMMAND, after, build.state(messages.UAV_COMMAND, after, rows))


def _record(
    folder: Path, trace: Trace, world: WorldModel, run_id: str = 'r1', close: bool = True
) -> BagSummary | BagWriter:
    """Record a trace as an engine would; `close=False` leaves the writer open and returns it."""
    definitions = message_definitions()
    build = MessageBuilder(definitions, 1, trace.roster.dt_s)
    writer = BagWriter(folder, definitions)

    def put(topic: str, tick: int, message: object) -> None:
        type_name = messages.TOPICS[topic]
        cdr = definitions.encode(type_name, message)
        writer.write(topic, type_name, cdr, time_ns(tick, trace.roster.dt_s))

    put(messages.ROSTER, 0, build.roster(run_id, trace.roster))
    put(messages.WORLD, 0, world_message(definitions, build.header(0), run_id, world))
    for tick in range(trace.ticks):
        _put_tick(put, build, trace, tick)
    return writer.close() if close else writer


@pytest.fixture
def make_trace() -> MakeTrace:
    """Make a run of `ticks`, `agents`, `uavs` from random numbers."""
    return _trace


@pytest.fixture
def make_world() -> MakeWorld:
    """Make a world with everything in it."""
    return _world


@pytest.fixture
def record() -> Record:
    """Record a trace in a folder."""
    return _record  # type: ignore[return-value]


@contextmanager
def _full_disk(size: int) -> Iterator[None]:
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.fixture
def full_disk() -> Callable[[int], AbstractContextManager[None]]:
    """Let the kernel refuse to write a file beyond `size` bytes."""
    return _full_disk


def _fuzz(data: bytes, seed: int) -> bytes:
    generator = random.Random(seed)
    damaged = bytearray(data)
    for _ in range(generator.choice((1, 1, 1, 5, 40))):
        damaged[generator.randrange(len(damaged))] ^= 1 << generator.randrange(8)
    kind = generator.randrange(8)
    at = generator.randrange(len(damaged))
    if kind == 0:
        del damaged[at:]
    elif kind == 1:
        del damaged[at : at + generator.randrange(1, 2000)]
    elif kind == 2:
        damaged[at:at] = generator.randbytes(generator.randrange(1, 2000))
    return bytes(damaged)


@pytest.fixture
def fuzz() -> Callable[[bytes, int], bytes]:
    """Damage bytes at random places, by a seed."""
    return _fuzz


@pytest.fixture(scope='session')
def forging() -> ModuleType:
    """The names of `forging`."""
    return _forging
