# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io
import signal
import sys
from typing import Any

import pytest

from aurora_cli.interrupts import Interrupts


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_the_first_signal_asks_the_second_insists(number: signal.Signals) -> None:
    before = signal.getsignal(number)
    with Interrupts() as interrupts:
        assert not interrupts.cancelled()
        signal.raise_signal(number)
        assert interrupts.cancelled()
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(number)
    assert signal.getsignal(number) is before


def test_a_hang_up_that_is_ignored_stays_so() -> None:
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with Interrupts() as interrupts:
            signal.raise_signal(signal.SIGHUP)
            assert not interrupts.cancelled()
    finally:
        signal.signal(signal.SIGHUP, before)


class _Pipe(io.RawIOBase):
    """Where a signal arrives while something is written to it."""

    def writable(self) -> bool:
        return True

    def write(self, data: Any) -> int:
        signal.raise_signal(signal.SIGINT)
        return len(data)


def test_a_signal_amid_a_write_to_standard_error_breaks_nothing(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr('sys.stderr', io.TextIOWrapper(io.BufferedWriter(_Pipe())))
    with Interrupts() as interrupts:
        sys.stderr.write('run: execute\n')
        sys.stderr.flush()
        assert interrupts.cancelled()
    assert 'stopping' in capfd.readouterr().err
