# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A small world and motions in it, as recordings that the checker judges."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from shapely.geometry import box

from aurora_bench.checker import Answer, check_recording
from aurora_bench.checker.recording import (
    Body,
    Lane,
    LinkEntry,
    LinkKind,
    Prism,
    Recording,
    World,
)

Array = npt.NDArray[np.float64]
DT_S = 0.1
SIZES = {'car': (4.6, 1.8, 1.5), 'bus': (12.0, 2.55, 3.2), 'truck': (8.5, 2.5, 3.5)}


def _lane(name: str, street: str, *points: tuple[float, float]) -> Lane:
    return Lane(lane_id=name, street=street, xy_m=np.array(points, dtype=float))


def a_world(**changes: Any) -> World:
    """Return a street along x (two lanes east, one west), a junction at 300, a tower."""
    values: dict[str, Any] = {
        'map_name': 'street',
        'buildings': (
            Prism(name='City Hall', polygon=box(200, 20, 220, 40), top_m=20.0),
            Prism(name='', polygon=box(40, 20, 60, 40), top_m=60.0),
        ),
        'driving': (('road', box(-500, -6.6, 600, 3.3)), ('cross', box(290, -200, 310, 200))),
        'crossings': ((':c0', box(98, -6.6, 102, 3.3)),),
        'sidewalks': (('walk', box(-500, 3.3, 600, 6.0)), ('walk2', box(-500, -9.0, 600, -6.6))),
        'lanes': (
            _lane('main_e_0', 'Main Street', (-500, -4.95), (285, -4.95)),
            _lane('main_e_1', 'Main Street', (-500, -1.65), (285, -1.65)),
            _lane('main_w_0', 'Main Street', (285, 1.65), (-500, 1.65)),
            _lane('main2_e_0', 'Main Street', (315, -4.95), (600, -4.95)),
            _lane('main2_w_0', 'Main Street', (600, 1.65), (315, 1.65)),
            _lane('side_n_0', 'Side Street', (301.65, 15), (301.65, 200)),
            _lane('side_s_0', 'Side Street', (298.35, 200), (298.35, 15)),
            _lane('side2_n_0', 'Side Street', (301.65, -200), (301.65, -18)),
            _lane('side2_s_0', 'Side Street', (298.35, -18), (298.35, -200)),
        ),
        'places': (('approach:City Hall', 210.0, 15.0), ('landmark:City Hall', 210.0, 30.0)),
    }
    return World(**{**values, **changes})


class Stage:
    """Collects bodies, UAVs and messages, and asks the checker.

    Args:
        seconds: Length of the recording.
    """

    def __init__(self, seconds: float = 60.0) -> None:
        self.t: Array = np.arange(round(seconds / DT_S) + 1, dtype=np.float64) * DT_S
        self.world = a_world()
        self._ground: list[tuple[Body, Array]] = []
        self._uavs: list[tuple[Body, Array, Array]] = []
        self._ledger: list[LinkEntry] = []
        self._messages = 0

    def ground(
        self,
        name: str,
        kind: str,
        x: Any,
        y: Any,
        heading: tuple[float, float] = (1.0, 0.0),
        role: str = 'other',
        route: Sequence[tuple[float, float]] = (),
        present: Any = 1.0,
    ) -> None:
        """Add a ground body on a path (numbers or one value a tick)."""
        xy = np.column_stack([np.broadcast_to(v, self.t.shape) for v in (x, y)]).astype(float)
        step = np.diff(xy, axis=0, prepend=xy[:1])
        step[0] = step[1]
        speed = np.linalg.norm(step, axis=1) / DT_S
        facing = np.tile(np.array(heading, dtype=float), (len(xy), 1))
        moving = speed > 1e-6
        facing[moving] = step[moving] / np.linalg.norm(step[moving], axis=1, keepdims=True)
        gain = np.diff(speed, prepend=speed[:1]) / DT_S
        rows = np.column_stack([xy, facing, speed, gain, np.broadcast_to(present, self.t.shape)])
        length, width, height = SIZES.get(kind, (4.6, 1.8, 1.5))
        person = kind == 'pedestrian'
        if person:
            length, width, height = 0.5, 0.5, 1.7
        body = Body(
            body_id=name,
            type_name=kind,
            row=len(self._ground),
            is_person=person,
            role=role,
            length_m=length,
            width_m=width,
            height_m=height,
            route_xy_m=np.array(route, dtype=float).reshape(-1, 2),
        )
        self._ground.append((body, rows))

    def drive(
        self,
        name: str,
        kind: str,
        speed: float | Array | Callable[[Array], Any],
        x: float = 0.0,
        y: Any = -1.65,
        back: bool = False,
        **more: Any,
    ) -> None:
        """Add a body that drives along x with a speed (m/s, over time)."""
        given = speed(self.t) if callable(speed) else speed
        v = np.broadcast_to(np.asarray(given, dtype=float), self.t.shape)
        way = np.concatenate([[0.0], np.cumsum(v[1:] * DT_S)])
        sign = -1.0 if back else 1.0
        self.ground(name, kind, x + sign * way, y, heading=(sign, 0.0), **more)

    def uav(
        self,
        name: str,
        mission: Callable[[Array], tuple[Any, Any, Any]],
        start_s: float = 10.0,
        ends: Sequence[float] = (50.0,),
        lands: bool = True,
    ) -> None:
        """Add a UAV: ascent, missions by position over time from start_s, landing after the last.

        Args:
            ends: When each mission ends (the next begins at once).
        """
        x, y, z = (np.broadcast_to(v, self.t.shape).astype(float) for v in mission(self.t))
        first, last = round(start_s / DT_S), round(ends[-1] / DT_S)
        xyz = np.column_stack([x, y, z])
        xyz[:first, :2] = xyz[first, :2]
        xyz[:first, 2] = np.linspace(0.0, xyz[first, 2], first)
        phase = np.zeros(len(self.t))
        phase[1:first] = 1.0
        bounds = [start_s, *ends]
        for k, (a, b) in enumerate(zip(bounds, ends, strict=False)):
            phase[round(a / DT_S) : round(b / DT_S)] = 2.0 + k
        if lands and last < len(xyz):
            phase[last:] = 100.0
            down = np.maximum(xyz[last - 1, 2] - 5.0 * (self.t[last:] - self.t[last]), 0.0)
            xyz[last:, :2], xyz[last:, 2] = xyz[last - 1, :2], down
        elif last < len(xyz):
            phase[last:] = phase[last - 1]
        rows = np.zeros((len(xyz), 16))
        rows[:, :3] = xyz
        rows[:, 3:6] = np.gradient(xyz, DT_S, axis=0)
        rows[:, 15] = xyz[:, 2] < 0.05
        body = Body(body_id=name, type_name='uav', row=len(self._uavs), is_uav=True)
        self._uavs.append((body, rows, phase))

    def message(
        self,
        sender: str,
        receiver: str,
        sent: float,
        latency: float | None = 0.1,
        losses: int = 0,
        reason: int = 1,
    ) -> None:
        """Add a message: `losses` lost transmissions 0.2 s apart, then one that takes `latency`.

        Without a latency it is given up after the losses.
        """
        number, self._messages = self._messages, self._messages + 1

        def entry(time: float, kind: LinkKind, attempt: int = 0, why: int = 0) -> None:
            self._ledger.append(
                LinkEntry(
                    time_s=time,
                    message=number,
                    sender=sender,
                    receiver=receiver,
                    kind=kind,
                    attempt=attempt,
                    reason=why,
                )
            )

        entry(sent, LinkKind.SENT)
        for k in range(losses):
            entry(sent + 0.2 * k, LinkKind.ATTEMPT_LOST, k, reason)
        end = sent + 0.2 * losses
        if latency is None:
            entry(end, LinkKind.FAILED, max(losses - 1, 0))
        else:
            entry(end, LinkKind.ATTEMPT_PASSED, losses)
            entry(end + latency, LinkKind.DELIVERED, losses)

    def recording(self) -> Recording:
        """Return the recording."""
        ground = np.zeros((len(self.t), 0, 7))
        if self._ground:
            ground = np.stack([rows for _, rows in self._ground], axis=1)
        uav, phase = np.zeros((len(self.t), 0, 16)), np.zeros((len(self.t), 0))
        if self._uavs:
            uav = np.stack([rows for _, rows, _ in self._uavs], axis=1)
            phase = np.stack([p for _, _, p in self._uavs], axis=1)
        bodies = (*(b for b, _ in self._ground), *(b for b, _, _ in self._uavs))
        return Recording(
            dt_s=DT_S,
            bodies=bodies,
            world=self.world,
            ground=ground,
            uav=uav,
            phase=phase,
            ledger=tuple(sorted(self._ledger, key=lambda e: e.time_s)),
        )

    def answer(self, *requirements: Mapping[str, Any], **prompt: Any) -> Answer:
        """Return the answer to the first requirement; bodies are declared by their ids."""
        listed = [
            {'id': f'r{k + 1}', **r}
            for k, r in enumerate([*requirements, *self._declared(requirements)])
        ]
        return check_recording(self.recording(), {'requirements': listed, **prompt}).answers[0]

    def outcomes(self, *requirements: Mapping[str, Any]) -> list[str]:
        """Return the outcomes of all these requirements."""
        listed = [
            {'id': f'r{k + 1}', **r}
            for k, r in enumerate([*requirements, *self._declared(requirements)])
        ]
        answers = check_recording(self.recording(), {'requirements': listed}).answers
        return [a.outcome.value for a in answers[: len(requirements)]]

    def says(self, *requirements: Mapping[str, Any], **prompt: Any) -> str:
        """Return the outcome of the first requirement."""
        return self.answer(*requirements, **prompt).outcome.value

    def _declared(self, requirements: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
        known = {r.get('ref') for r in requirements}
        ground = [
            {'kind': 'agent', 'ref': b.body_id, 'type': b.type_name}
            for b, _ in self._ground
            if b.body_id not in known and b.role != 'background'
        ]
        uavs = [
            {'kind': 'uav', 'ref': b.body_id} for b, _, _ in self._uavs if b.body_id not in known
        ]
        return [*ground, *uavs]


@pytest.fixture
def stage() -> Stage:
    """Return an empty stage of 60 s."""
    return Stage()


@pytest.fixture
def make_stage() -> type[Stage]:
    """Return the class, for tests that need several or another length."""
    return Stage
