# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C at any moment of a command: held back, never lost."""

import signal
from collections.abc import Callable, Iterator

import pytest
from rclpy.executors import SingleThreadedExecutor

from aurora_ros2cli.graph import interrupts_held, spin_until, temporary_node


@pytest.fixture(autouse=True)
def _interruptible() -> Iterator[None]:
    """In a background job, SIGINT is ignored from the start, and then stays so on purpose."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def _press() -> None:
    signal.raise_signal(signal.SIGINT)


def _struck(passed: list[str], *steps: Callable[[], None]) -> bool:
    """Whether Ctrl-C came out of a block that ran these steps; notes those that were passed."""
    try:
        with interrupts_held():
            for step in steps:
                step()
                passed.append(step.__name__)
    except KeyboardInterrupt:
        return True
    return False


def _wait() -> None:
    with interrupts_held():
        pass


def test_a_held_interrupt_comes_after_the_block() -> None:
    passed: list[str] = []
    assert _struck(passed, _wait, _press)

    assert passed == ['_wait', '_press']
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_the_wait_after_an_interrupt_is_the_last() -> None:
    passed: list[str] = []
    assert _struck(passed, _press, _wait, _wait)

    assert passed == ['_press']
    assert not _struck(passed, _wait)  # the next block starts anew


def test_the_second_interrupt_strikes_at_once() -> None:
    passed: list[str] = []
    assert _struck(passed, _press, _press)

    assert passed == ['_press']


def test_an_interrupt_in_the_executors_finalizer_is_not_lost(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    finalize: Callable[[object], None] = SingleThreadedExecutor.__del__

    def strike(executor: object) -> None:
        signal.raise_signal(signal.SIGINT)
        finalize(executor)

    with temporary_node() as node:
        monkeypatch.setattr(SingleThreadedExecutor, '__del__', strike)
        with pytest.raises(KeyboardInterrupt):
            spin_until(node, lambda: True)
        monkeypatch.undo()


def test_a_background_job_stays_deaf() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    assert not _struck([], _press, _wait)
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
