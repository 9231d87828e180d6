# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sizes and dynamics of the vehicle types, driven and walked on a straight track."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

import libsumo

from aurora_core.errors import GroundSimulatorError
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.ports.simulators import GroundAgentLoad, GroundLoad
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundColumn, GroundCommandKind
from aurora_sumo_bridge.network import PEDESTRIAN
from aurora_sumo_bridge.sumo_client import SumoClient

TRACK_M = 8000.0
_START_M = 40.0
_LIMIT_MPS = 150.0
_LONGEST_S = 180.0
# A speed that has not changed for so long is the last one.
_STEADY_S = 2.0
# Beyond the factor that a type drives at of its own.
_FASTEST_FACTOR = 5.0
# Numbers are kept to a thousandth.
_DIGITS = 3

_TRACK = f"""<net version="1.20">
  <location netOffset="0.00,0.00" convBoundary="0.00,0.00,{TRACK_M:.2f},0.00"
            origBoundary="0.00,0.00,{TRACK_M:.2f},0.00" projParameter="!"/>
  <edge id="track" from="a" to="b" priority="1">
    <lane id="track_0" index="0" allow="pedestrian" speed="{_LIMIT_MPS:.2f}"
          length="{TRACK_M:.2f}" width="3.00" shape="0.00,-5.50 {TRACK_M:.2f},-5.50"/>
    <lane id="track_1" index="1" disallow="pedestrian" speed="{_LIMIT_MPS:.2f}"
          length="{TRACK_M:.2f}" width="4.00" shape="0.00,-2.00 {TRACK_M:.2f},-2.00"/>
  </edge>
  <junction id="a" type="dead_end" x="0.00" y="0.00" incLanes="" intLanes=""
            shape="0.00,0.00 0.00,-7.00"/>
  <junction id="b" type="dead_end" x="{TRACK_M:.2f}" y="0.00" incLanes="track_0 track_1"
            intLanes="" shape="{TRACK_M:.2f},-7.00 {TRACK_M:.2f},0.00"/>
</net>
"""


def measure_types(
    vtypes_path: Path, names: Iterable[str], dt_s: float, progress: Callable[[str], None]
) -> tuple[AgentTypeRecord, ...]:
    """Drive every type and return what it did, in the order of the names.

    Args:
        vtypes_path: Additional file with the types.
        names: Types to measure.
        dt_s: Step.
        progress: Is told the name of each type before it drives.

    Raises:
        GroundSimulatorError: A type is missing, does not start, or does not come to a steady
            speed on the track.
    """
    with tempfile.TemporaryDirectory(prefix='aurora-track-') as folder:
        net_path = Path(folder) / 'track.net.xml'
        net_path.write_text(_TRACK, encoding='utf-8')
        track = _Track(net_path, vtypes_path, dt_s)
        try:
            records = []
            for name in names:
                progress(name)
                records.append(track.measure(name))
            return tuple(records)
        finally:
            track.close()


class _Track:
    def __init__(self, net_path: Path, vtypes_path: Path, dt_s: float) -> None:
        self._net_path = net_path
        self._vtypes_path = vtypes_path
        self._dt_s = dt_s
        self._client = SumoClient()
        self._order: tuple[GroundCommand, ...] = ()
        self._tick = 0

    def close(self) -> None:
        self._client.close()

    def measure(self, name: str) -> AgentTypeRecord:
        """Drive one type: as it goes of its own, then as fast as it can, each to rest."""
        self._load(name, 1.0)  # nobody yet: only the loaded types tell who walks
        types = libsumo.vehicletype
        is_person = str(types.getVehicleClass(name)) == PEDESTRIAN
        usual, gain, loss = self._drive(name, is_person, 1.0)
        fastest, _, _ = self._drive(name, is_person, _FASTEST_FACTOR)
        return AgentTypeRecord(
            name=name,
            vclass=str(types.getVehicleClass(name)),
            is_person=is_person,
            length_m=_kept(types.getLength(name)),
            width_m=_kept(types.getWidth(name)),
            height_m=_kept(types.getHeight(name)),
            max_speed_mps=fastest,
            accel_mps2=gain,
            decel_mps2=loss,
            emergency_decel_mps2=_kept(types.getEmergencyDecel(name)),
            headway_s=_kept(types.getTau(name)),
            min_gap_m=_kept(types.getMinGap(name)),
            # Walkers go at their own pace everywhere; grounding states it for each.
            desired_speed_mps=usual if usual < fastest and not is_person else None,
        )

    def _drive(self, name: str, is_person: bool, factor: float) -> tuple[float, float, float]:
        """Return steady speed, mean acceleration to it and mean deceleration from it."""
        self._load(name, factor, is_person=is_person)
        if is_person and factor > 1.0:
            most_mps = float(libsumo.vehicletype.getMaxSpeed(name))
            self._order = (
                GroundCommand(agent=0, kind=GroundCommandKind.SET_SPEED, value=most_mps),
            )
        steady = round(_STEADY_S / self._dt_s)
        speeds = [0.0]
        for speed_mps in self._speeds(name):
            speeds.append(speed_mps)
            if len(speeds) > steady and speeds[-steady] == speed_mps > 0.0:
                break
        self._order = _speed(0.0)
        top_mps = speeds[-1]
        slowing = [top_mps]
        for speed_mps in self._speeds(name):
            slowing.append(speed_mps)
            if speed_mps == 0.0:
                break
        gain = _mean(speeds[: speeds.index(top_mps) + 1], self._dt_s)
        return _kept(top_mps), gain, _mean(slowing, self._dt_s)

    def _speeds(self, name: str) -> Iterator[float]:
        """Advance and yield the speed, as long as a run may take."""
        for _ in range(round(_LONGEST_S / self._dt_s)):
            self._tick += 1
            state = self._client.advance(self._tick, self._order)
            self._order = ()
            yield float(state[0, GroundColumn.SPEED])
        raise GroundSimulatorError(
            f'type {name} comes to no steady speed within {_LONGEST_S:g} s',
            hint='compare config/maps/vtypes.add.xml with the shipped file',
        )

    def _load(self, name: str, factor: float, *, is_person: bool | None = None) -> None:
        agents: tuple[GroundAgentLoad, ...] = ()
        if is_person is not None:
            agents = (
                GroundAgentLoad(
                    agent_id=name,
                    type_name=name,
                    is_person=is_person,
                    edges=('track',),
                    lane_id='track_0' if is_person else 'track_1',
                    lane_position_m=_START_M,
                    arrival_position_m=TRACK_M - _START_M if is_person else None,
                    speed_factor=1.0 if is_person else factor,
                ),
            )
        self._order = ()
        self._tick = 0
        self._client.load(
            GroundLoad(
                map_name='track',
                net_path=self._net_path,
                vtypes_path=self._vtypes_path,
                map_digest='',
                dt_s=self._dt_s,
                seed=1,
                agents=agents,
            )
        )
        if name not in libsumo.vehicletype.getIDList():
            raise GroundSimulatorError(f"{self._vtypes_path} has no type '{name}'")


def _speed(speed_mps: float) -> tuple[GroundCommand, ...]:
    return (GroundCommand(agent=0, kind=GroundCommandKind.SET_SPEED, value=speed_mps),)


def _kept(value: float) -> float:
    return round(float(value), _DIGITS)


def _mean(speeds_mps: Sequence[float], dt_s: float) -> float:
    """Return the mean rate of a change of speed; its last step ends within and does not count."""
    steps = max(1, len(speeds_mps) - 2)
    return _kept(abs(speeds_mps[steps] - speeds_mps[0]) / (steps * dt_s))
