# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The barrier without ROS: order, credit, silence, faults."""

from __future__ import annotations

import pytest

from aurora_core.errors import ExecutionError, GroundSimulatorError, ParticipantSilentError
from aurora_sync.barrier import BarrierLoad, Phase, TickBarrier, tick_of_horizon

RUN = 7
PARTICIPANTS = ('sumo_bridge', 'uav_bridge', 'executor')


def barrier(credit_ticks: int = 100, observers: tuple[str, ...] = ()) -> TickBarrier:
    made = TickBarrier(credit_ticks=credit_ticks, silence_limit_s=5.0)
    made.load(
        BarrierLoad(run_number=RUN, last_tick=1000, participants=PARTICIPANTS, observers=observers)
    )
    return made


def phase(made: TickBarrier) -> Phase:
    """Return the phase afresh (a type checker believes that it stays what it was)."""
    return made.status.phase


def finish(made: TickBarrier, tick: int, now_s: float = 0.0, finished: bool = False) -> int | None:
    """Let every participant finish a tick; return what the last one started."""
    started = None
    for name in PARTICIPANTS:
        assert started is None
        started = made.done(RUN, tick, name, finished and name == 'executor', now_s)
    return started


def test_ticks_begin_at_zero_and_follow_each_other() -> None:
    made = barrier()
    assert made.start(RUN, 0.0) == 0
    assert [finish(made, tick) for tick in range(5)] == [1, 2, 3, 4, 5]
    assert made.status.tick == 5
    assert made.status.completed == 4


@pytest.mark.parametrize('missing', PARTICIPANTS)
def test_no_tick_begins_while_anyone_is_missing(missing: str) -> None:
    made = barrier()
    made.start(RUN, 0.0)
    for name in PARTICIPANTS:
        if name != missing:
            assert made.done(RUN, 0, name, False, 0.0) is None
    assert made.status.tick == 0
    assert made.done(RUN, 0, missing, False, 0.0) == 1


def test_a_repeated_done_does_not_stand_in_for_another() -> None:
    made = barrier()
    made.start(RUN, 0.0)
    for _ in range(3):
        assert made.done(RUN, 0, 'sumo_bridge', False, 0.0) is None
    assert made.status.tick == 0


def test_words_of_another_run_an_old_tick_or_a_stranger_are_ignored() -> None:
    made = barrier()
    made.start(RUN, 0.0)
    finish(made, 0)
    before = made.status
    assert made.done(RUN - 1, 1, 'executor', False, 0.0) is None
    assert made.done(RUN, 0, 'executor', True, 0.0) is None
    assert made.done(RUN, 1, 'stranger', True, 0.0) is None
    assert made.status == before


def test_a_tick_finished_before_it_began_fails_the_run() -> None:
    made = barrier()
    made.start(RUN, 0.0)
    made.done(RUN, 1, 'uav_bridge', False, 0.0)
    assert phase(made) is Phase.FAILED
    assert made.status.error is not None
    assert made.status.error.component == 'uav_bridge'


def test_finished_ends_the_run_only_when_all_are_done_with_the_tick() -> None:
    made = barrier()
    made.start(RUN, 0.0)
    made.done(RUN, 0, 'executor', True, 0.0)
    assert phase(made) is Phase.RUNNING
    made.done(RUN, 0, 'sumo_bridge', False, 0.0)
    assert made.done(RUN, 0, 'uav_bridge', False, 0.0) is None
    assert phase(made) is Phase.FINISHED
    assert made.stop(RUN) == 0


def test_the_horizon_is_a_hard_end() -> None:
    made = TickBarrier(credit_ticks=9, silence_limit_s=5.0)
    made.load(BarrierLoad(run_number=RUN, last_tick=2, participants=PARTICIPANTS))
    made.start(RUN, 0.0)
    assert [finish(made, tick) for tick in range(3)] == [1, 2, None]
    assert phase(made) is Phase.FINISHED


def test_the_clock_waits_for_an_observer_outside_its_credit() -> None:
    made = barrier(credit_ticks=3, observers=('recorder', 'monitor'))
    made.start(RUN, 0.0)
    assert [finish(made, tick) for tick in range(2)] == [1, 2]
    assert finish(made, 2) is None
    assert made.acknowledge(RUN, 'recorder', 2, 0.0) is None, 'the monitor is still behind'
    assert made.acknowledge(RUN - 1, 'monitor', 9, 0.0) is None
    assert made.acknowledge(RUN, 'monitor', 0, 0.0) == 3
    assert finish(made, 3) is None


def test_what_is_granted_ends_with_the_first_credit_and_with_the_horizon() -> None:
    made = TickBarrier(credit_ticks=9, silence_limit_s=5.0, own_credit_ticks={'recorder': 4})
    load = BarrierLoad(
        run_number=RUN,
        last_tick=12,
        participants=PARTICIPANTS,
        observers=('monitor', 'recorder'),
    )
    made.load(load)
    assert made.granted == -1, 'nothing before the start'
    made.start(RUN, 0.0)
    assert made.granted == 3
    made.acknowledge(RUN, 'recorder', 2, 0.0)
    assert made.granted == 6
    made.acknowledge(RUN, 'recorder', 9, 0.0)
    assert made.granted == 8, 'now the monitor holds the clock'
    made.acknowledge(RUN, 'monitor', 9, 0.0)
    assert made.granted == 12, 'the horizon'
    made.stop(RUN)
    assert made.granted == -1
    made.load(load)
    made.start(RUN, 0.0)
    assert made.granted == 3, 'a new load forgets what was acknowledged'


def test_whatever_is_granted_may_be_finished() -> None:
    made = barrier(credit_ticks=3, observers=('recorder',))
    made.start(RUN, 0.0)
    for tick in range(made.granted + 1):
        finish(made, tick)
        assert phase(made) is Phase.RUNNING
    assert made.status.tick == made.granted
    assert made.acknowledge(RUN, 'recorder', 1, 0.0) == 3


def test_an_observer_with_less_credit_holds_the_clock_first() -> None:
    made = TickBarrier(credit_ticks=9, silence_limit_s=5.0, own_credit_ticks={'recorder': 2})
    made.load(
        BarrierLoad(
            run_number=RUN,
            last_tick=99,
            participants=PARTICIPANTS,
            observers=('monitor', 'recorder'),
        )
    )
    made.start(RUN, 0.0)
    assert finish(made, 0) == 1
    assert finish(made, 1) is None
    made.check(5.1)
    assert made.status.error is not None
    assert made.status.error.component == 'recorder'


def test_a_silent_participant_is_named_and_the_one_that_waits_for_it_is_not() -> None:
    made = barrier()
    made.start(RUN, 100.0)
    made.done(RUN, 0, 'sumo_bridge', False, 101.0)
    made.check(106.0)
    assert phase(made) is Phase.RUNNING
    made.check(106.1)
    assert phase(made) is Phase.FAILED
    error = made.status.error
    assert isinstance(error, ParticipantSilentError)
    assert error.component == 'uav_bridge'
    assert 'tick 0' in error.message
    assert made.done(RUN, 0, 'uav_bridge', False, 107.0) is None, 'too late'


def test_an_observer_that_holds_the_clock_too_long_is_named() -> None:
    made = barrier(credit_ticks=1, observers=('recorder',))
    made.start(RUN, 0.0)
    finish(made, 0)
    made.check(5.1)
    assert made.status.error is not None
    assert made.status.error.component == 'recorder'


def test_a_fault_ends_the_run_with_the_error_of_its_component() -> None:
    made = barrier()
    made.start(RUN, 0.0)
    made.fault(RUN - 1, GroundSimulatorError('an old run'))
    assert phase(made) is Phase.RUNNING
    made.fault(RUN, GroundSimulatorError('edge 5 is gone'))
    assert phase(made) is Phase.FAILED
    assert made.status.error is not None
    assert made.status.error.message == 'edge 5 is gone'
    made.check(99.0)
    assert made.status.error.message == 'edge 5 is gone', 'the first error stays'


def test_stop_gives_the_last_complete_tick_and_is_safe_at_any_time() -> None:
    made = TickBarrier(credit_ticks=9, silence_limit_s=5.0)
    assert made.stop(RUN) == 0
    made = barrier()
    made.start(RUN, 0.0)
    finish(made, 0)
    finish(made, 1)
    assert made.stop(RUN - 1) == 0
    assert phase(made) is Phase.RUNNING
    assert made.stop(RUN) == 1
    assert phase(made) is Phase.IDLE
    assert made.done(RUN, 2, 'executor', False, 0.0) is None
    assert made.stop(RUN) == 1


def test_a_new_load_forgets_the_run_before() -> None:
    made = barrier(observers=('recorder',))
    made.start(RUN, 0.0)
    made.done(RUN, 0, 'sumo_bridge', False, 0.0)
    made.load(BarrierLoad(run_number=RUN + 1, last_tick=5, participants=('executor',)))
    assert made.start(RUN + 1, 0.0) == 0
    assert made.done(RUN, 0, 'executor', False, 0.0) is None
    assert made.done(RUN + 1, 0, 'executor', False, 0.0) == 1


@pytest.mark.parametrize('run_number', [RUN - 1, RUN + 1])
def test_only_the_loaded_run_can_be_started_and_only_once(run_number: int) -> None:
    made = barrier()
    with pytest.raises(ExecutionError, match='to be loaded'):
        made.start(run_number, 0.0)
    made.start(RUN, 0.0)
    with pytest.raises(ExecutionError, match='found running'):
        made.start(RUN, 0.0)


def test_a_load_without_participants_or_with_a_name_twice_is_refused() -> None:
    made = TickBarrier(credit_ticks=9, silence_limit_s=5.0)
    with pytest.raises(ExecutionError, match='expected participants'):
        made.load(BarrierLoad(run_number=RUN, last_tick=5, participants=()))
    with pytest.raises(ExecutionError, match='twice'):
        made.load(BarrierLoad(run_number=RUN, last_tick=5, participants=('a', 'a')))


def test_horizon_in_ticks() -> None:
    assert tick_of_horizon(60.0, 0.05) == 1200
    for horizon_s, dt_s in ((0.0, 0.05), (60.0, 0.0), (float('inf'), 0.05), (float('nan'), 0.05)):
        with pytest.raises(ExecutionError):
            tick_of_horizon(horizon_s, dt_s)


def test_a_run_is_loaded_once() -> None:
    made = barrier()
    shorter = BarrierLoad(run_number=RUN, last_tick=1, participants=PARTICIPANTS)
    with pytest.raises(ExecutionError, match='loaded already'):
        made.load(shorter)
    made.start(RUN, 0.0)
    with pytest.raises(ExecutionError, match='loaded already'):
        made.load(shorter)
    assert phase(made) is Phase.RUNNING
