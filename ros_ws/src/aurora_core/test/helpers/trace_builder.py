# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Synthetic runs for tests: bodies on given paths, flights by phases, the world around them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from aurora_core.knowledge.limits import Limits, Tolerances, load_limits, load_tolerances
from aurora_core.knowledge.map_types import Building, NoFlyZone
from aurora_core.knowledge.world import Surface, SurfaceKind, Wind, WorldModel
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Span, Unit
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import (
    GROUND_WIDTH,
    UAV_COMMAND_WIDTH,
    UAV_WIDTH,
    GroundColumn,
    UavColumn,
    UavCommandColumn,
    UavMode,
    UavPhase,
)
from aurora_core.trace.records import (
    EventRecord,
    LinkRecord,
    ScenarioEventKind,
    SightRecord,
)
from aurora_core.trace.roster import Roster, RosterEntry
from aurora_core.trace.trace import Integrity, Trace

DT_S = 0.05
CONFIG = Path(__file__).resolve().parents[5] / 'config'
LIMITS: Limits = load_limits(CONFIG / 'limits.json')
TOLERANCES: Tolerances = load_tolerances(CONFIG / 'tolerances.json')

FloatArray = npt.NDArray[np.float64]
_SIZES = {
    'car': (4.5, 1.8, 1.5),
    'van': (5.5, 2.0, 2.2),
    'bus': (12.0, 2.5, 3.2),
    'ambulance': (6.5, 2.1, 2.6),
    'motorcycle': (2.2, 0.8, 1.4),
    'pedestrian': (0.5, 0.5, 1.7),
}


def number(
    value: float, unit: Unit = Unit.METRE, *, explicit: bool = False, bound: Bound = Bound.EXACTLY
) -> Parameter:
    """A parameter with a wide domain."""
    return Parameter(
        value=value,
        unit=unit,
        low=-1e9,
        high=1e9,
        provenance=Provenance.EXPLICIT if explicit else Provenance.DEFAULT,
        span=Span(start=0, end=1) if explicit else None,
        bound=bound,
    )


@dataclass
class Agent:
    """A ground agent on a straight road along +x (or a given path)."""

    id: str
    type: str
    x: FloatArray
    y: FloatArray
    speed: FloatArray
    heading: tuple[float | FloatArray, float | FloatArray] = (1.0, 0.0)
    present: FloatArray | None = None
    role: str = 'other'
    route: tuple[tuple[float, float], ...] = ()


def driver(
    id: str, type: str, x0: float, speed: FloatArray, y: float = 0.0, role: str = 'other'
) -> Agent:
    """An agent that drives along +x at the given speed of each tick."""
    speed = np.asarray(speed, dtype=np.float64)
    x = x0 + np.concatenate(([0.0], np.cumsum(speed[1:] * DT_S)))
    return Agent(
        id=id,
        type=type,
        x=x,
        y=np.full(len(speed), y),
        speed=speed,
        role=role,
        route=((x0, y), (x0 + 5000.0, y)),
    )


@dataclass
class Flight:
    """States and commands of one UAV."""

    id: str
    states: FloatArray
    commands: FloatArray
    ascent_end: int
    landing: int | None
    landed: int | None


def flight(
    ticks: int,
    home: tuple[float, float],
    altitude: float,
    path: Callable[[int], tuple[float, float, float]] | None = None,
    landing: int | None = None,
    id: str = 'uav1',
    later: Sequence[int] = (),
) -> Flight:
    """A UAV: climbs with 4 m/s from tick 1, follows `path(tick)`, lands straight down with 2 m/s.

    Args:
        path: Position at a tick of the mission; default: stays above home. The way from home is
            flown with at most 15 m/s.
        landing: Tick of the first landing command, None = stays on mission.
        later: First ticks of the second, third, ... mission.
    """
    where = path if path is not None else (lambda _tick: (*home, altitude))
    states = np.zeros((ticks, UAV_WIDTH))
    commands = np.zeros((ticks, UAV_COMMAND_WIDTH))
    states[:, UavColumn.QW] = 1.0
    # Python's own numbers: one by one, those of NumPy take several times as long.
    x, y, z = float(home[0]), float(home[1]), 0.0
    start = (x, y, z)
    reached = TOLERANCES.altitude_m.of(altitude)
    ascent_end = landed = None
    flown = [start]
    told = [(int(UavMode.IDLE), int(UavPhase.IDLE), True)]
    for k in range(1, ticks):
        mode: int = UavMode.IDLE
        phase: int
        if landed is not None:
            phase = UavPhase.LANDING
        elif landing is not None and k >= landing:
            mode, phase = UavMode.LAND, UavPhase.LANDING
            z = max(0.0, z - 2.0 * DT_S)
        elif ascent_end is None:
            mode, phase = UavMode.TAKEOFF, UavPhase.ASCENT
            z = min(altitude, z + 4.0 * DT_S)
            if abs(z - altitude) <= reached:
                ascent_end = k
        else:
            mode = UavMode.OFFBOARD
            phase = UavPhase.MISSION + sum(k >= tick for tick in later)
            wx, wy, wz = map(float, where(k))
            away = math.hypot(wx - x, wy - y)
            share = 1.0 if away <= 15.0 * DT_S else 15.0 * DT_S / away
            x, y = x + share * (wx - x), y + share * (wy - y)
            z += min(4.0 * DT_S, max(-2.0 * DT_S, wz - z))
        if landing is not None and k > landing and z == 0.0 and landed is None:
            landed = k
        flown.append((x, y, z))
        told.append((int(mode), int(phase), landed is not None))
    places = np.array(flown)
    velocities = np.diff(places, axis=0, prepend=np.array([start])) / DT_S
    marks = np.array(told, dtype=np.float64)
    states[:, UavColumn.X : UavColumn.Z + 1] = places
    states[:, UavColumn.VX : UavColumn.VZ + 1] = velocities
    states[:, UavColumn.MODE] = marks[:, 0]
    states[:, UavColumn.LANDED] = marks[:, 2]
    states[:, UavColumn.ARMED] = 1.0 - marks[:, 2]
    commands[:, UavCommandColumn.X : UavCommandColumn.Z + 1] = places
    commands[:, UavCommandColumn.VX : UavCommandColumn.VZ + 1] = velocities
    commands[:, UavCommandColumn.MODE] = marks[:, 0]
    commands[:, UavCommandColumn.PHASE] = marks[:, 1]
    commands[0] = 0.0
    return Flight(
        id=id,
        states=states,
        commands=commands,
        ascent_end=-1 if ascent_end is None else ascent_end,
        landing=landing,
        landed=landed,
    )


@dataclass
class Run:
    """A run under construction; `trace()` freezes it."""

    ticks: int
    agents: list[Agent] = field(default_factory=list)
    flights: list[Flight] = field(default_factory=list)
    links: list[LinkRecord] = field(default_factory=list)
    sights: list[SightRecord] = field(default_factory=list)
    events: list[EventRecord] = field(default_factory=list)
    finished: bool = True
    integrity: Integrity = Integrity.INTACT
    missing: tuple[int, ...] = ()
    ground_commands: dict[int, tuple[GroundCommand, ...]] = field(default_factory=dict)

    def claim(self, tick: int, kind: ScenarioEventKind, subject: str, detail: str = '') -> None:
        self.events.append(
            EventRecord(
                tick=tick, sequence=len(self.events), kind=kind, subject=subject, detail=detail
            )
        )

    def _phases(self) -> Iterator[EventRecord]:
        """What an executor tells of its commands; missions are called m1, m2, ..."""
        for one in self.flights:
            phase = one.commands[:, UavCommandColumn.PHASE].astype(int)
            for tick in np.flatnonzero(phase[1:] != phase[:-1]).tolist():
                number = int(phase[tick + 1])
                index = number - UavPhase.MISSION
                mission = 0 <= index < UavPhase.LANDING - UavPhase.MISSION
                yield EventRecord(
                    tick=tick,
                    sequence=0,
                    kind=ScenarioEventKind.PHASE,
                    subject=one.id,
                    detail=f'm{index + 1}' if mission else UavPhase(number).name.lower(),
                )

    def trace(self) -> Trace:
        ground = np.zeros((self.ticks, len(self.agents), GROUND_WIDTH))
        entries = []
        for row, agent in enumerate(self.agents):
            ground[:, row, GroundColumn.X] = agent.x
            ground[:, row, GroundColumn.Y] = agent.y
            ground[:, row, GroundColumn.HEADING_X] = agent.heading[0]
            ground[:, row, GroundColumn.HEADING_Y] = agent.heading[1]
            ground[:, row, GroundColumn.SPEED] = agent.speed
            ground[:, row, GroundColumn.PRESENT] = 1.0 if agent.present is None else agent.present
            length, width, height = _SIZES[agent.type]
            entries.append(
                RosterEntry(
                    body_id=agent.id,
                    type_name=agent.type,
                    is_person=agent.type == 'pedestrian',
                    system_id=0,
                    length_m=length,
                    width_m=width,
                    height_m=height,
                    route_xy_m=agent.route,
                    role=agent.role,
                )
            )
        uav_entries = [
            RosterEntry(
                body_id=one.id,
                type_name='uav',
                is_person=False,
                system_id=row + 1,
                length_m=0.5,
                width_m=0.5,
                height_m=0.2,
            )
            for row, one in enumerate(self.flights)
        ]
        events = [*self.events, *self._phases()]
        if self.finished:
            events.append(
                EventRecord(
                    tick=self.ticks - 1,
                    sequence=len(events),
                    kind=ScenarioEventKind.FINISHED,
                    subject='run',
                    detail='finished',
                )
            )
        uav = np.zeros((self.ticks, 0, UAV_WIDTH))
        commands = np.zeros((self.ticks, 0, UAV_COMMAND_WIDTH))
        if self.flights:
            uav = np.stack([one.states for one in self.flights], axis=1)
            commands = np.stack([one.commands for one in self.flights], axis=1)
        for tick in self.missing:
            ground[tick] = np.nan
            uav[tick] = np.nan
        return Trace(
            roster=Roster(dt_s=DT_S, agents=tuple(entries), uavs=tuple(uav_entries)),
            ground=ground,
            uav=uav,
            uav_commands=commands,
            ground_commands=tuple(self.ground_commands.get(k, ()) for k in range(self.ticks)),
            links=tuple(self.links),
            sights=tuple(self.sights),
            events=tuple(
                replace(record, sequence=number)
                for number, record in enumerate(sorted(events, key=lambda r: r.tick))
            ),
            missing_ticks=self.missing,
            integrity=self.integrity,
        )


def box_ring(x0: float, y0: float, x1: float, y1: float) -> tuple[tuple[float, float], ...]:
    """A rectangle as an open ring."""
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def building(
    x0: float, y0: float, x1: float, y1: float, height: float, name: str = ''
) -> Building:
    """A block."""
    return Building(
        id=f'b{x0:g}_{y0:g}',
        ring=box_ring(x0, y0, x1, y1),
        holes=(),
        height_m=height,
        height_source='test',
        kind='block',
        name=name,
    )


def zone(x0: float, y0: float, x1: float, y1: float, floor: float, ceiling: float) -> NoFlyZone:
    """A no-fly zone."""
    return NoFlyZone(
        id='z1', name='zone', ring=box_ring(x0, y0, x1, y1), floor_m=floor, ceiling_m=ceiling
    )


def world(
    buildings: Sequence[Building] = (),
    zones: Sequence[NoFlyZone] = (),
    streets: Sequence[tuple[float, float, float, float]] = ((-1000.0, -5.0, 6000.0, 5.0),),
    weather: str = 'clear',
) -> WorldModel:
    """A world with streets as rectangles."""
    return WorldModel(
        map_name='test',
        map_digest='0' * 64,
        origin_lat_deg=0.0,
        origin_lon_deg=0.0,
        weather=weather,
        time_of_day='noon',
        wind=Wind(),
        buildings=tuple(buildings),
        no_fly_zones=tuple(zones),
        surfaces=tuple(
            Surface(
                surface_id=f's{k}',
                kind=SurfaceKind.DRIVING,
                ring=np.array(box_ring(*street), dtype=np.float64),
            )
            for k, street in enumerate(streets)
        ),
        lanes=(),
        signals=(),
        limits=LIMITS,
    )
