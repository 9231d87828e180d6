# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Recorded motion with the edits of many candidates carried through it.

Bodies that an edit does not move keep their recorded motion. A UAV answers to another altitude or
standoff as fast as the record shows that it climbs, sinks and flies; a vehicle that starts farther
away drives as fast as it was seen to, until it is as near as its time gap allows. The result is
the recorded position plus the difference of two such models, with the edit and without: no edit
gives the record itself.

Arrays are (C, S): candidates by samples.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounded import GroundedAgent
from aurora_core.quantities import motion
from aurora_core.quantities.routes import along_route
from aurora_core.quantities.view import RunView
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import GroundColumn, UavCommandColumn, UavMode, UavPhase

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.intp]

# What a body is taken to do that never did it in the record: climb, sink, go round (m/s).
_LEAST_RATE_MPS = 1.0
# How fast a UAV closes what it is off (1/s), and a vehicle what its gap is too large (1/s).
_GAIN_HZ, _CLOSE_HZ = 1.0, 0.5
# A vehicle in a queue, without a time gap of its own (s), and its gap at a standstill (m).
_TIME_GAP_S, _STANDSTILL_M = 1.0, 2.5
# Distances of a vehicle that an edit can move, by relation: 1 it is behind, -1 ahead.
_ALONG = {'behind': 1.0, 'ahead': -1.0}


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidates:
    """Edits to be foreseen.

    Attributes:
        values: By path of the parameter, (C,) values in its unit.
        here: The values of the recorded realisation.
    """

    values: Mapping[str, FloatArray]
    here: Mapping[str, float]

    @property
    def number(self) -> int:
        """How many there are."""
        return len(next(iter(self.values.values())))

    def shift(self, path: str) -> FloatArray | None:
        """Return by how much a parameter is moved, None where no candidate moves it."""
        values = self.values.get(path)
        return None if values is None else values - self.here[path]


class Moved:
    """Positions of bodies under many candidates.

    Args:
        view: The recorded run.
        agsg: The graph that it was executed from.
        candidates: The edits.
        ticks: (S,) samples that are looked at, in order.
    """

    def __init__(
        self,
        view: RunView,
        agsg: Agsg,
        candidates: Candidates,
        ticks: npt.NDArray[np.intp],
    ) -> None:
        assert agsg.grounding is not None  # it was executed
        self.view = view
        self.candidates = candidates
        self.ticks = ticks
        self._agsg = agsg
        self._plans = {plan.id: plan for plan in agsg.grounding.uavs}
        self._agents = {agent.id: agent for agent in agsg.grounding.agents}
        self._found: dict[str, tuple[FloatArray, FloatArray, FloatArray]] = {}
        self._shifts: dict[str, FloatArray | None] = {}

    @cached_property
    def modelled(self) -> frozenset[str]:
        """Paths of the edits that have a model here."""
        known = {
            f'missions/{mission.id}/{name}'
            for plan in self._plans.values()
            for mission in plan.missions
            for name in self._names(mission)
        }
        known |= {path for path, _, _, _ in self._gaps()}
        return frozenset(self.candidates.values) & known

    @staticmethod
    def _names(mission: MissionPlan) -> tuple[str, ...]:
        if mission.mode is MissionMode.TRACK:
            return ('altitude_m', 'standoff_m')
        return ('altitude_m',)

    def altitude(self, mission: str) -> FloatArray | None:
        """Return what the altitude of a mission is moved by, (C,)."""
        return self.candidates.shift(f'missions/{mission}/altitude_m')

    def standoff(self, mission: str) -> FloatArray | None:
        """Return what the standoff of a mission is moved by, (C,)."""
        return self.candidates.shift(f'missions/{mission}/standoff_m')

    def position(self, name: str) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return east, north and height of a body or place, (C, S) or (1, S) metres each."""
        if name not in self._found:
            recorded = self.view.reference(name)[self.ticks]
            east, north, up = (recorded[None, :, k] for k in range(3))
            if name in self._plans:
                east, north, up = self._flown(self._plans[name], east, north, up)
            elif name in self._agents:
                along = self.along(name)
                if along is not None:
                    east, north = _on_path(recorded[:, :2], self._heading(name), along)
            self._found[name] = east, north, up
        return self._found[name]

    def moves(self, name: str) -> bool:
        """Tell whether a candidate moves a body."""
        return any(len(part) > 1 for part in self.position(name))

    def distance(self, a: str, b: str, *, flat: bool = False) -> FloatArray:
        """Return the distance of two bodies, (C, S) or (1, S) metres."""
        (ax, ay, az), (bx, by, bz) = self.position(a), self.position(b)
        square = (ax - bx) ** 2 + (ay - by) ** 2
        return np.sqrt(square if flat else square + (az - bz) ** 2)

    def _flown(
        self, plan: UavPlan, east: FloatArray, north: FloatArray, up: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        phase = self._commands(plan.id)[:, UavCommandColumn.PHASE]
        delayed = self._delayed(plan)
        if delayed is not None:
            up = self._climbed(plan, up, delayed)
            east, north = self._later(plan, phase, east[0], north[0], delayed)
        for index, mission in enumerate(plan.missions):
            if mission.target is not None and mission.mode is MissionMode.TRACK:
                flown = phase == UavPhase.MISSION + index
                east, north = self._tracked(mission, flown, east, north)
        return east, north, up

    def when(self, uav: str) -> IndexArray | None:
        """Return which recorded sample of a UAV's flight each sample is like, (C, S).

        None where no candidate moves an altitude of it.
        """
        return self._delayed(self._plans[uav]) if uav in self._plans else None

    def _delayed(self, plan: UavPlan) -> IndexArray | None:
        """Return which recorded sample each one is like, (C, S): who climbs higher is later.

        None where no candidate moves an altitude.
        """
        shifts = [self.altitude(mission.id) for mission in plan.missions]
        if all(shift is None for shift in shifts):
            return None
        number = np.arange(len(self.ticks))
        if shifts[0] is None:
            return np.repeat(number[None], self.candidates.number, axis=0)
        climb, _ = self._rates(plan.id)
        step_s = float(self._steps_s[-1]) or self.view.dt_s
        late = np.round(shifts[0] / climb / step_s).astype(np.intp)
        found: IndexArray = np.clip(number[None] - late[:, None], 0, len(number) - 1)
        return found

    def _rates(self, uav: str) -> tuple[float, float]:
        """Return how fast a UAV was seen to climb and to sink, m/s."""
        rate = motion.climb_rate(self.view, self.view.body(uav))
        return max(_LEAST_RATE_MPS, float(rate.max())), max(_LEAST_RATE_MPS, float(-rate.min()))

    def _later(
        self,
        plan: UavPlan,
        phase: FloatArray,
        east: FloatArray,
        north: FloatArray,
        delayed: IndexArray,
    ) -> tuple[FloatArray, FloatArray]:
        """Return the way over ground, so much later; who tracks is as far from its target."""
        found_x, found_y = east[delayed], north[delayed]
        for index, mission in enumerate(plan.missions):
            if mission.target is None or mission.mode is not MissionMode.TRACK:
                continue
            target = self.view.reference(mission.target)[self.ticks]
            flown = phase[delayed] == UavPhase.MISSION + index
            with_x = target[None, :, 0] + (east - target[:, 0])[delayed]
            with_y = target[None, :, 1] + (north - target[:, 1])[delayed]
            found_x = np.where(flown, with_x, found_x)
            found_y = np.where(flown, with_y, found_y)
        return found_x, found_y

    def _climbed(self, plan: UavPlan, up: FloatArray, delayed: IndexArray) -> FloatArray:
        """Return the height: the record plus what the model climbs more with the edit.

        The way to the landing spot is flown as high as the last mission.
        """
        shifts = [self.altitude(mission.id) for mission in plan.missions]
        climb, sink = self._rates(plan.id)
        zero = np.zeros(self.candidates.number)
        # The first row has no edit: what the model says of it is what the record holds.
        when = np.concatenate((np.arange(len(self.ticks))[None], delayed))
        commands = self._commands(plan.id)
        phase = commands[:, UavCommandColumn.PHASE][when]
        home = (commands[:, UavCommandColumn.MODE] == UavMode.OFFBOARD)[when]
        home = (phase == UavPhase.HOLDING) | (home & (phase == UavPhase.LANDING))
        goal = commands[:, UavCommandColumn.Z][when]
        for index, (mission, shift) in enumerate(zip(plan.missions, shifts, strict=True)):
            flown = phase == UavPhase.MISSION + index
            if index == 0:
                flown |= phase == UavPhase.ASCENT
            more = np.concatenate(([0.0], zero if shift is None else shift))[:, None]
            goal = np.where(flown, mission.altitude_m + more, goal)
            if index + 1 == len(plan.missions):
                goal = np.where(home, goal + more, goal)
        model = np.empty_like(goal)
        here = np.full(len(goal), up[0, 0])
        for k, step_s in enumerate(self._steps_s):
            off = np.clip((goal[:, k] - here) * _GAIN_HZ, -sink, climb) * step_s
            here = here + off
            model[:, k] = here
        rest = up[0] - model[0]
        found: FloatArray = np.maximum(model[1:] + rest[delayed], 0.0)
        return found

    def _tracked(
        self,
        mission: MissionPlan,
        flown: npt.NDArray[np.bool_],
        east: FloatArray,
        north: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:
        """Return where a tracker is: it goes with its target, and as far from it as is asked."""
        assert mission.target is not None
        shift = self.standoff(mission.id)
        goal_x, goal_y = np.zeros((1, len(self.ticks))), np.zeros((1, len(self.ticks)))
        target = self.view.reference(mission.target)[self.ticks]
        if self.moves(mission.target):
            moved_x, moved_y, _ = self.position(mission.target)
            goal_x, goal_y = moved_x - target[:, 0], moved_y - target[:, 1]
        if shift is not None:
            away_x, away_y = self._away(mission, target)
            goal_x = goal_x + shift[:, None] * away_x
            goal_y = goal_y + shift[:, None] * away_y
        if goal_x.shape[0] == 1:
            return east, north
        speeds = motion.horizontal_speed(self.view, self.view.body(self._uav_of(mission)))
        fastest = max(_LEAST_RATE_MPS, float(speeds.max()))
        dx, dy = np.zeros(goal_x.shape), np.zeros(goal_x.shape)
        here_x, here_y = np.zeros(len(goal_x)), np.zeros(len(goal_x))
        for k, step_s in enumerate(self._steps_s):
            if flown[k]:
                off_x, off_y = goal_x[:, k] - here_x, goal_y[:, k] - here_y
                far = np.sqrt(off_x * off_x + off_y * off_y)
                share = np.minimum(1.0, fastest * step_s / np.maximum(far, 1e-9))
                share = np.minimum(share, _GAIN_HZ * step_s) if k else share
                here_x, here_y = here_x + share * off_x, here_y + share * off_y
            dx[:, k], dy[:, k] = here_x, here_y
        return east + dx, north + dy

    def _away(self, mission: MissionPlan, target: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the direction from a target to its tracker, (S,) each of unit length."""
        heading = self._heading(mission.target or '')
        if mission.standoff_m <= 0.0 or mission.offset_m == (0.0, 0.0):
            return -heading[:, 0], -heading[:, 1]
        length = float(np.hypot(*mission.offset_m))
        ahead, left = mission.offset_m[0] / length, mission.offset_m[1] / length
        if not mission.offset_turns:
            return np.full(len(target), ahead), np.full(len(target), left)
        hx, hy = heading[:, 0], heading[:, 1]
        return ahead * hx - left * hy, ahead * hy + left * hx

    def along(self, agent: str) -> FloatArray | None:
        """Return how far behind its recorded place a vehicle drives, (C, S) m along its way."""
        if agent not in self._shifts:
            self._shifts[agent] = self._along(agent)
        return self._shifts[agent]

    def _along(self, agent: str) -> FloatArray | None:
        for path, who, other, sign in self._gaps():
            shift = self.candidates.shift(path)
            if who != agent or shift is None:
                continue
            if sign < 0.0:
                return np.repeat(-shift[:, None], len(self.ticks), axis=1)
            return self._caught_up(agent, other, shift)
        return None

    def _gaps(self) -> list[tuple[str, str, str, float]]:
        """Return path, agent, the other one and the sense of every distance that is modelled."""
        return [
            (f'agents/{agent.id}/placements/{k}/distance_m', agent.id, place.of, sign)
            for agent in self._agsg.spec.agents
            for k, place in enumerate(agent.placements)
            if (sign := _ALONG.get(place.relation.value)) is not None and place.of in self._agents
        ]

    def _caught_up(self, follower: str, leader: str, shift: FloatArray) -> FloatArray:
        """Return how much farther back a follower is that starts so much farther back."""
        view = self.view
        gap = along_route(view, view.body(follower), view.body(leader)).gap_m[self.ticks]
        ahead = motion.speed(view, view.body(leader))[self.ticks]
        own = motion.speed(view, view.body(follower))
        agent: GroundedAgent = self._agents[follower]
        headway_s = _TIME_GAP_S if agent.time_gap_s is None else agent.time_gap_s
        fastest = max(float(own.max()), float(ahead.max()), _LEAST_RATE_MPS)
        shifts = np.concatenate(([0.0], shift))
        here = gap[0] + shifts
        speed = np.full(len(shifts), own[self.ticks[0]])
        model = np.empty((len(shifts), len(self.ticks)))
        for k, step_s in enumerate(self._steps_s):
            wanted = here - _STANDSTILL_M - headway_s * speed
            free = np.clip(ahead[k] + _CLOSE_HZ * wanted, 0.0, fastest)
            most, least = agent.acceleration_mps2 * step_s, agent.deceleration_mps2 * step_s
            speed = np.clip(speed + np.clip(free - speed, -least, most), 0.0, fastest)
            if k:
                here = here + (ahead[k] - speed) * step_s
            model[:, k] = here
        return model[1:] - model[:1]

    def _heading(self, agent: str) -> FloatArray:
        if not self.view.has(agent) or self.view.body(agent).is_uav:
            return np.tile(np.array([1.0, 0.0]), (len(self.ticks), 1))
        columns = slice(GroundColumn.HEADING_X, GroundColumn.HEADING_Y + 1)
        heading: FloatArray = self.view.rows(self.view.body(agent))[self.ticks, columns]
        return heading

    def _commands(self, uav: str) -> FloatArray:
        return self.view.commands(self.view.body(uav))[self.ticks]

    def _uav_of(self, mission: MissionPlan) -> str:
        return next(p.id for p in self._plans.values() if mission in p.missions)

    @cached_property
    def _steps_s(self) -> list[float]:
        steps = np.diff(self.ticks, prepend=self.ticks[0]) * self.view.dt_s
        return [float(step) for step in steps]


def _on_path(
    recorded: FloatArray, heading: FloatArray, behind: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return positions so far behind on a recorded way, (C, S) each; before it straight back."""
    steps = np.sqrt((np.diff(recorded, axis=0) ** 2).sum(axis=1))
    way = np.concatenate(([0.0], np.cumsum(steps)))
    wanted = way[None, :] - behind
    east = np.interp(wanted, way, recorded[:, 0])
    north = np.interp(wanted, way, recorded[:, 1])
    before = np.minimum(wanted, 0.0)
    after = np.maximum(wanted - way[-1], 0.0)
    east = east + before * heading[0, 0] + after * heading[-1, 0]
    north = north + before * heading[0, 1] + after * heading[-1, 1]
    return east, north
