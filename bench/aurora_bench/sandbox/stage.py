# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The scene of one program: simulators and recorder, which the program never reaches itself.

What is recorded are the states of the simulators and the commands that they were given. The
program names its bodies and says which mission a UAV flies; nothing else of the record is its.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, field
from math import hypot
from pathlib import Path
from typing import Any

import numpy as np

from aurora_bench.sandbox.bodies import Bodies
from aurora_bench.sandbox.flying import Flying
from aurora_bench.sandbox.radio import Radio
from aurora_bench.sandbox.requests import (
    Begin,
    ChangeLane,
    Delivered,
    FlyTo,
    FreeSpeed,
    Land,
    Lanes,
    Link,
    Log,
    NextEdges,
    OfBody,
    Phase,
    Places,
    Refuse,
    Resume,
    Route,
    SceneRefusal,
    Send,
    SetRoute,
    SetSpeed,
    SetTimeGap,
    Spawn,
    SpawnUav,
    State,
    Step,
    StopAt,
    TakeOff,
    World,
    read_request,
)
from aurora_cli.local_recorder import LocalRecorder
from aurora_cli.local_run import TraceCollector
from aurora_core.errors import AuroraError
from aurora_core.execution.step_output import StepOutput
from aurora_core.geometry.frames import offset_at_bearing
from aurora_core.knowledge.measured_on import vtypes_path
from aurora_core.knowledge.world import NamedPlace, Wind, WorldModel
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.ports.simulators import AirLoad, AirSimulator, GroundLoad, GroundSimulator
from aurora_core.trace.bag_writer import BagWriter
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.hashing import TraceHashes, trace_hashes
from aurora_core.trace.layout import GroundColumn, GroundCommandKind, UavColumn
from aurora_core.trace.records import EventRecord, ScenarioEventKind
from aurora_core.trace.roster import Roster
from aurora_core.trace.trace import FloatArray

_VCLASS = 'passenger'
_MOST_LANES, _MOST_LOG = 200, 200


@dataclass(slots=True, kw_only=True)
class _Running:
    """What lives from `begin` to the end."""

    roster: Roster
    world: WorldModel
    ground: GroundSimulator
    air: AirSimulator | None
    recorder: LocalRecorder
    collected: TraceCollector
    flying: Flying
    radio: Radio
    ground_rows: FloatArray
    uav_rows: FloatArray
    tick: int = 0
    told: list[GroundCommand] = field(default_factory=list)
    sequence: int = 0
    ended: bool = False


class Stage:
    """The scene of one program; leave it by `with`.

    Args:
        known: What the stages work with.
        map_name: Map of the run.
        seed: Of the simulators and the links.
        bag: Folder that the recording becomes.
        simulators: Makes the two simulators, of the MAVLink numbers of the UAVs.

    Attributes:
        refused: Why the program says that the request cannot be carried out, '' otherwise.
        log: What it wrote for its reader.
    """

    def __init__(
        self,
        known: Knowledge,
        map_name: str,
        seed: int,
        bag: Path,
        simulators: Callable[[tuple[int, ...]], tuple[GroundSimulator, AirSimulator]],
    ) -> None:
        self._known = known
        self._map = known.map(map_name)
        self._seed = seed
        self._bag = bag
        self._simulators = simulators
        self._bodies = Bodies(self._map, known.types)
        self._sky = World(do='world')
        self._links: list[Link] = []
        self._running: _Running | None = None
        self._open = ExitStack()
        self.refused = ''
        self.log: list[str] = []

    @property
    def begun(self) -> bool:
        """Whether anything was simulated."""
        return self._running is not None

    @property
    def time_s(self) -> float:
        """Simulated time, 0 before it begins."""
        run = self._running
        return 0.0 if run is None else run.tick * run.roster.dt_s

    def answer(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return the answer to a request: what `is`, or the `error`.

        Raises:
            AuroraError: A simulator or the recording broke: that is no fault of the program.
        """
        try:
            return {'is': self._do(read_request(request))}
        except SceneRefusal as err:
            return {'error': str(err)}

    def end(self) -> TraceHashes | None:
        """Record the last tick and the end; None where nothing was simulated."""
        run = self._running
        if run is None or run.ended:
            return None
        run.ended = True
        self._tick(run, last=True)
        run.recorder.close()
        return trace_hashes(run.collected.trace(), run.world)

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    def _do(self, asked: Any) -> Any:
        match asked:
            case Lanes():
                return self._lanes(asked)
            case NextEdges():
                return list(self._map.network.successors(self._edge(asked.edge), _VCLASS))
            case Route():
                ends = self._edge(asked.from_edge), self._edge(asked.to_edge)
                found = self._map.network.shortest_route(*ends, _VCLASS)
                if found is None:
                    raise SceneRefusal('no car can drive there')
                return list(found)
            case Places():
                return {m.name: self._place(m.x_m, m.y_m) for m in self._map.landmarks}
            case Refuse():
                self.refused = asked.because
            case Log():
                if len(self.log) < _MOST_LOG:
                    self.log.append(asked.text)
            case World() | Spawn() | SpawnUav() | Link() | Begin():
                return self._before(asked)
            case _:
                return self._while(asked)
        return None

    def _before(self, asked: World | Spawn | SpawnUav | Link | Begin) -> float | None:
        if self._running is not None:
            raise SceneRefusal(f'{asked.do}: the simulators run already')
        match asked:
            case World():
                self._sky = asked
            case Spawn():
                self._bodies.add(asked)
            case SpawnUav():
                self._bodies.add_uav(asked)
            case Link():
                for name in (asked.sender, asked.receiver):
                    if not self._bodies.knows(name):
                        raise SceneRefusal(f'there is no {name!r}')
                self._links.append(asked)
            case Begin():
                self._running = self._begin()
                return self._running.roster.dt_s
        return None

    def _while(self, asked: Any) -> Any:
        run = self._running
        if run is None or run.ended:
            raise SceneRefusal(
                f'{asked.do}: {"call begin first" if run is None else "it is over"}'
            )
        match asked:
            case Step():
                return self._step(run, asked.ticks)
            case State():
                return self._state(run, asked.name)
            case TakeOff() | FlyTo() | Land() | Phase():
                run.flying.take(asked)
            case Send():
                run.radio.send(run.tick, asked.sender, asked.receiver)
            case Delivered():
                return run.radio.delivered(asked.sender, asked.receiver)
            case OfBody():
                row = run.roster.agent_index(asked.name)
                if row is None:
                    raise SceneRefusal(f'there is no {asked.name!r} on the ground')
                run.told.append(_ground_command(row, asked))
        return None

    def _begin(self) -> _Running:
        """Start the simulators; a placement that they refuse is the program's to mend."""
        dt_s, sky, known = self._known.settings.run.dt_s, self._sky, self._known
        roster = self._bodies.roster(dt_s)
        if not roster.agents and not roster.uavs:
            raise SceneRefusal('begin: nobody was placed')
        east, north = offset_at_bearing(sky.wind_mps, sky.wind_from_deg + 180.0)
        if sky.wind_mps == 0.0:
            east, north = known.limits.wind_mean_mps[sky.weather.value], 0.0
        gust = known.limits.wind_gust_mps[sky.weather.value]
        world = self._world(Wind(mean_east_mps=east, mean_north_mps=north, gust_mps=gust))
        ground, air = self._simulators(tuple(h.system_id for h in self._bodies.homes))
        self._open.callback(ground.close)
        self._open.callback(air.close)
        try:
            ground.load(
                GroundLoad(
                    map_name=self._map.name, net_path=self._map.net_path,
                    vtypes_path=vtypes_path(), map_digest=self._map.digest, dt_s=dt_s,
                    seed=self._seed, agents=self._bodies.agents, weather=sky.weather.value,
                )
            )  # fmt: skip
        except AuroraError as err:
            raise SceneRefusal(f'begin: {err}') from err
        ground_rows = ground.state()
        if roster.uavs:
            air.load(
                AirLoad(
                    dt_s=dt_s, seed=self._seed, homes=self._bodies.homes,
                    origin_lat_deg=self._map.origin_lat_deg,
                    origin_lon_deg=self._map.origin_lon_deg,
                    wind_mean_east_mps=east, wind_mean_north_mps=north, wind_gust_mps=gust,
                )
            )  # fmt: skip
        definitions = message_definitions()
        writer = self._open.enter_context(BagWriter(self._bag, definitions))
        recorder = LocalRecorder(writer, definitions, dt_s)
        recorder.prologue(self._bag.parent.name, roster, world)
        return _Running(
            roster=roster,
            world=world,
            ground=ground,
            air=air if roster.uavs else None,
            recorder=recorder,
            collected=TraceCollector(roster),
            flying=Flying(roster),
            radio=Radio(self._links, roster, world, self._known.parts(self._map.name).sight_line,
                        known.limits, self._seed),
            ground_rows=ground_rows,
            uav_rows=air.state() if roster.uavs else ground_rows[:0, :0],
        )  # fmt: skip

    def _step(self, run: _Running, ticks: int) -> float:
        most = round(self._known.limits.duration_max_s / run.roster.dt_s)
        if run.tick + ticks > most:
            raise SceneRefusal(f'step: the scene is over at {most * run.roster.dt_s:g} s')
        for _ in range(ticks):
            self._tick(run)
        return self.time_s

    def _tick(self, run: _Running, *, last: bool = False) -> None:
        """Record the present tick, and go on to the next one."""
        events = [*run.flying.events()]
        if last:
            events.append((ScenarioEventKind.FINISHED, '', 'finished'))
        told, commands = tuple(run.told), run.flying.commands()
        run.told = []
        output = StepOutput(
            ground_commands=told,
            uav_commands=commands,
            links=run.radio.step(run.tick, run.ground_rows, run.uav_rows),
            events=tuple(self._event(run, *event) for event in events),
            finished=last,
            outcome='finished' if last else '',
        )
        run.collected.add(run.ground_rows, run.uav_rows, output)
        run.recorder.add(run.tick, run.ground_rows, run.uav_rows, output)
        if last:
            return
        run.tick += 1
        try:
            run.ground_rows = run.ground.advance(run.tick, told)
            if run.air is not None:
                run.uav_rows = run.air.advance(run.tick, commands)
        except AuroraError as err:
            # What a simulator does not take is the program's command; the record ends here.
            run.ended = True
            run.recorder.close()
            raise SceneRefusal(f'step: {err}') from err

    def _event(
        self, run: _Running, kind: ScenarioEventKind, subject: str, detail: str
    ) -> EventRecord:
        run.sequence += 1
        return EventRecord(
            tick=run.tick, sequence=run.sequence, kind=kind, subject=subject, detail=detail
        )

    def _world(self, wind: Wind) -> WorldModel:
        parts = self._known.parts(self._map.name)
        return WorldModel(
            map_name=self._map.name,
            map_digest=self._map.digest,
            origin_lat_deg=self._map.origin_lat_deg,
            origin_lon_deg=self._map.origin_lon_deg,
            weather=self._sky.weather.value,
            time_of_day=self._sky.time_of_day.value,
            wind=wind,
            buildings=self._map.buildings,
            no_fly_zones=self._map.zones,
            surfaces=parts.surfaces + parts.sidewalks,
            lanes=parts.lanes,
            signals=parts.signals,
            places=tuple(
                NamedPlace(name=n, x_m=x, y_m=y) for n, (x, y) in sorted(parts.landmarks.items())
            ),
            limits=self._known.limits,
        )

    def _edge(self, edge_id: str) -> str:
        if edge_id not in self._map.network.edges:
            raise SceneRefusal(f'there is no edge {edge_id!r}')
        return edge_id

    def _lanes(self, asked: Lanes) -> list[dict[str, Any]]:
        network = self._map.network
        west, south, east, north = self._map.bounds_m
        x, y = asked.near or ((west + east) / 2.0, (south + north) / 2.0)
        found = []
        for lane in network.driving_lanes(_VCLASS):
            points = np.asarray(lane.polyline)
            away_m = float(np.hypot(points[:, 0] - x, points[:, 1] - y).min())
            if away_m <= asked.within_m:
                found.append((away_m, lane.id, lane))
        return [
            {
                'id': lane.id, 'edge': lane.edge_id, 'index': lane.index,
                'street': network.edge(lane.edge_id).street_name,
                'length_m': lane.arc_length_m, 'limit_mps': lane.speed_limit_mps,
                'start': list(lane.polyline[0]), 'end': list(lane.polyline[-1]),
            }
            for _, _, lane in sorted(found, key=lambda f: f[:2])[:_MOST_LANES]
        ]  # fmt: skip

    def _place(self, x_m: float, y_m: float) -> dict[str, Any]:
        lane, _, _ = self._map.network.nearest_lane(x_m, y_m, _VCLASS)
        return {'x': x_m, 'y': y_m, 'lane': lane}

    def _state(self, run: _Running, name: str) -> dict[str, float]:
        row = run.roster.agent_index(name)
        if row is not None:
            values = run.ground_rows[row].tolist()
            heading = np.arctan2(values[GroundColumn.HEADING_Y], values[GroundColumn.HEADING_X])
            return {
                'x': values[GroundColumn.X], 'y': values[GroundColumn.Y],
                'speed': values[GroundColumn.SPEED], 'heading_rad': float(heading),
                'present': values[GroundColumn.PRESENT],
            }  # fmt: skip
        row = run.roster.uav_index(name)
        if row is None:
            raise SceneRefusal(f'there is no {name!r}')
        values = run.uav_rows[row].tolist()
        w, i, j, k = values[UavColumn.QW : UavColumn.QZ + 1]
        yaw = float(np.arctan2(2.0 * (w * k + i * j), 1.0 - 2.0 * (j * j + k * k)))
        vx, vy, vz = values[UavColumn.VX : UavColumn.VZ + 1]
        return {
            'x': values[UavColumn.X], 'y': values[UavColumn.Y], 'z': values[UavColumn.Z],
            'vx': vx, 'vy': vy, 'vz': vz, 'speed': hypot(vx, vy), 'heading_rad': yaw,
            'present': 1.0, 'landed': values[UavColumn.LANDED],
        }  # fmt: skip


def _ground_command(row: int, asked: OfBody) -> GroundCommand:
    kinds = GroundCommandKind
    match asked:
        case SetSpeed():
            return GroundCommand(agent=row, kind=kinds.SET_SPEED, value=asked.value)
        case FreeSpeed():
            return GroundCommand(agent=row, kind=kinds.RELEASE_SPEED)
        case SetTimeGap():
            return GroundCommand(agent=row, kind=kinds.SET_TIME_GAP, value=asked.value)
        case SetRoute():
            return GroundCommand(agent=row, kind=kinds.SET_ROUTE, text=' '.join(asked.edges))
        case ChangeLane():
            return GroundCommand(
                agent=row, kind=kinds.CHANGE_LANE, value=float(asked.value), value2=asked.for_s
            )
        case StopAt():
            return GroundCommand(
                agent=row, kind=kinds.STOP_AT, value=asked.position_m, value2=asked.for_s,
                text=asked.lane,
            )  # fmt: skip
        case Resume():
            return GroundCommand(agent=row, kind=kinds.RESUME)
        case _:
            raise SceneRefusal('no command for a body on the ground')
