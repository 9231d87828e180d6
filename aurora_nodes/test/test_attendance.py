# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who must be there in a run, with a roll call and a watch of the test's own."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import AuroraError, ExecutionError, ParticipantSilentError
from aurora_nodes.attendance import Attendance, AttendanceLimits
from aurora_nodes.supervision import Supervision

NAMES = ('sync', 'sumo_bridge', 'recorder', 'monitor', 'executor', 'grounding', 'parser')


class Watch:
    def __init__(self) -> None:
        self.processes = {name: (i + 1, 10) for i, name in enumerate((*NAMES, 'uav_bridge'))}
        self.causes: dict[str, str] = {}

    def cause_of_death(self, name: str) -> str:
        return self.causes.get(name, '')

    def process(self, name: str) -> tuple[int, int]:
        return self.processes.get(name, (0, 0))

    def was_heard(self, name: str) -> bool:
        return name in self.processes


class Question:
    def __init__(self, error: AuroraError | None) -> None:
        self.error = error
        self.response: Any = object()
        self.asked_at_s = float('-inf')
        self.is_settled = True

    def ask(self) -> None:
        pass

    def end(self, _limit_s: float) -> AuroraError | None:
        return self.error


class RollCall:
    def __init__(self) -> None:
        self.missing: list[dict[str, AuroraError]] = []
        self.asked: list[tuple[str, ...]] = []
        self.air: AuroraError | None = None

    def absent(
        self,
        names: Iterable[str],
        limit_s: float,
        *,
        cancelled: Callable[[], bool] = lambda: False,
    ) -> dict[str, AuroraError]:
        self.asked.append(tuple(names))
        return self.missing.pop(0) if self.missing else {}

    def question(self, name: str) -> Question:
        assert name == 'uav_bridge'
        return Question(self.air)


class Setup:
    def __init__(self, restart_s: float = 5.0) -> None:
        self.watch, self.roll_call = Watch(), RollCall()
        limits = AttendanceLimits(roll_call_s=1.0, air_period_s=1.0)
        supervision = Supervision(None, supervised_s=1.0, alone_s=restart_s)
        self.attendance = Attendance(
            self.roll_call,  # type: ignore[arg-type]
            self.watch,  # type: ignore[arg-type]
            supervision,
            limits,
        )

    def open(self) -> None:
        self.attendance.open(lambda: False)


def gone(name: str) -> AuroraError:
    return ParticipantSilentError(f'{name} died', component=name)


def test_whoever_dies_in_a_run_is_named_and_nobody_counts_outside_of_one() -> None:
    setup = Setup()
    setup.attendance.check()
    setup.open()
    setup.attendance.check()
    setup.watch.causes['monitor'] = 'died (process 4)'
    with pytest.raises(ParticipantSilentError, match='monitor died') as caught:
        setup.attendance.check()
    assert caught.value.component == 'monitor'
    setup.attendance.close()
    setup.attendance.check()


def test_a_node_that_answers_before_its_first_heartbeat_was_not_restarted() -> None:
    setup = Setup()
    process = setup.watch.processes.pop('sync')
    setup.open()
    setup.attendance.check()
    setup.watch.processes['sync'] = process
    setup.attendance.check()
    setup.watch.processes['sync'] = (99, 20)
    with pytest.raises(ParticipantSilentError, match='sync was restarted'):
        setup.attendance.check()


def test_a_node_that_was_restarted_in_a_run_would_fake_continuity() -> None:
    setup = Setup()
    setup.open()
    setup.watch.processes['sumo_bridge'] = (99, 20)
    with pytest.raises(ParticipantSilentError, match='restarted during the run') as caught:
        setup.attendance.check()
    assert caught.value.component == 'sumo_bridge'


def test_parser_and_grounding_may_go_once_they_have_worked() -> None:
    setup = Setup()
    setup.open()
    setup.watch.causes = {'parser': 'died', 'grounding': 'died'}
    setup.attendance.check()
    setup.attendance.confirm()
    assert not {'parser', 'grounding'} & set(setup.roll_call.asked[-1])


def test_the_air_side_counts_only_where_there_are_uavs() -> None:
    setup = Setup()
    setup.open()
    setup.watch.causes['uav_bridge'] = 'died'
    setup.attendance.check()
    setup.attendance.expect_air()
    with pytest.raises(ParticipantSilentError, match='uav_bridge died'):
        setup.attendance.check()


def test_uav_bridge_tells_of_a_dead_uav_sim() -> None:
    setup = Setup()
    setup.open()
    setup.attendance.expect_air()
    setup.roll_call.air = gone('uav_sim')
    setup.attendance.check()  # asks
    with pytest.raises(ParticipantSilentError) as caught:
        setup.attendance.check()  # hears the answer
    assert caught.value.component == 'uav_sim'


def test_a_run_waits_for_who_is_being_restarted() -> None:
    setup = Setup()
    setup.roll_call.missing = [{'sync': gone('sync')}, {}]
    setup.open()
    assert setup.roll_call.asked == [(*NAMES, 'uav_bridge')] * 2


def test_a_run_does_not_wait_for_ever() -> None:
    setup = Setup(restart_s=1e-9)
    setup.roll_call.missing = [{'sync': gone('sync'), 'monitor': gone('monitor')}] * 100
    with pytest.raises(ParticipantSilentError) as caught:
        setup.open()
    assert caught.value.component == 'sync'


def test_a_node_that_answered_and_died_before_the_run_began_is_waited_for_too() -> None:
    setup = Setup(restart_s=1e-9)
    setup.watch.causes['sync'] = 'died'
    with pytest.raises(ExecutionError, match='still being restarted'):
        setup.open()


def test_a_run_never_ends_well_with_somebody_absent() -> None:
    setup = Setup()
    setup.open()
    setup.attendance.expect_air()
    setup.roll_call.missing = [{'uav_bridge': gone('uav_sim')}]
    with pytest.raises(ParticipantSilentError) as caught:
        setup.attendance.confirm()
    assert caught.value.component == 'uav_sim'
    assert 'uav_bridge' in setup.roll_call.asked[-1]
