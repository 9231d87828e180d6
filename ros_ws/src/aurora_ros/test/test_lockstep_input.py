# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Pairing of ticks and their inputs."""

from __future__ import annotations

import pytest

from aurora_core.errors import ExecutionError
from aurora_ros.lockstep_input import LockstepInput

RUN = 4


def armed(*, first_needs_input: bool = False) -> LockstepInput[str]:
    made: LockstepInput[str] = LockstepInput(first_needs_input=first_needs_input)
    made.arm(RUN)
    return made


def test_tick_zero_needs_no_input_and_later_ones_do() -> None:
    made = armed()
    made.grant(RUN, 0)
    assert made.take() == (0, None)
    made.grant(RUN, 1)
    assert made.take() is None
    made.put(RUN, 1, 'command 1')
    assert made.take() == (1, 'command 1')
    assert made.take() is None


def test_tick_zero_can_be_made_to_wait() -> None:
    made = armed(first_needs_input=True)
    made.grant(RUN, 0)
    assert made.take() is None
    made.put(RUN, 0, 'x')
    assert made.take() == (0, 'x')


def test_the_input_may_come_before_its_tick_and_never_serves_another() -> None:
    made = armed()
    made.put(RUN, 2, 'command 2')
    made.put(RUN, 1, 'command 1')
    made.grant(RUN, 0)
    assert made.take() == (0, None)
    assert made.take() is None, 'tick 1 may not begin yet'
    made.grant(RUN, 1)
    assert made.take() == (1, 'command 1')
    made.grant(RUN, 2)
    assert made.take() == (2, 'command 2')


def test_inside_the_window_the_input_alone_is_waited_for() -> None:
    made = armed()
    made.grant(RUN, 3)
    assert made.take() == (0, None)
    assert made.take() is None, 'nothing stands in for command 1'
    made.put(RUN, 2, 'command 2')
    assert made.take() is None, 'nor does the command of another tick'
    made.put(RUN, 1, 'command 1')
    assert made.take() == (1, 'command 1')
    assert made.take() == (2, 'command 2')
    made.put(RUN, 3, 'command 3')
    made.put(RUN, 4, 'command 4')
    assert made.take() == (3, 'command 3')
    assert made.take() is None, 'the window ends with tick 3'


def test_another_run_and_repeated_or_smaller_grants_are_ignored() -> None:
    made = armed()
    made.grant(RUN + 1, 0)
    made.put(RUN + 1, 1, 'of another run')
    assert made.take() is None
    made.grant(RUN, 1)
    made.grant(RUN, 0)
    assert made.take() == (0, None)
    assert made.take() is None
    made.put(RUN, 0, 'late')
    made.put(RUN, 1, 'command 1')
    assert made.take() == (1, 'command 1')


def lacks_grant(made: LockstepInput[str]) -> bool:
    return made.lacks_grant


def test_what_is_missing_is_told() -> None:
    made = armed()
    assert lacks_grant(made)
    made.grant(RUN, 0)
    made.take()
    made.put(RUN, 1, 'command 1')
    assert lacks_grant(made)
    made.grant(RUN, 2)
    assert not lacks_grant(made)
    made.take()
    assert made.take() is None
    assert not lacks_grant(made)


def test_disarm_and_a_new_run_forget_what_was_there() -> None:
    made = armed()
    made.put(RUN, 1, 'old')
    made.grant(RUN, 9)
    made.disarm()
    assert made.take() is None
    assert made.run_number is None
    made.arm(RUN + 1)
    assert made.take() is None
    made.grant(RUN + 1, 0)
    assert made.take() == (0, None)
    made.grant(RUN + 1, 1)
    assert made.take() is None


def test_a_second_input_for_one_tick_is_refused_unless_it_is_the_same() -> None:
    made = armed()
    made.put(RUN, 2, 'command 2')
    made.put(RUN, 2, 'command 2')
    with pytest.raises(ExecutionError, match='two inputs for tick 2') as caught:
        made.put(RUN, 2, 'of somebody else')
    assert caught.value.component == 'network'
