# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The disk is asked beside the work: at once, once for many requests, and its errors are told."""

from __future__ import annotations

import os
import threading
import time

import pytest

from aurora_core.trace.disk_sync import PAUSE_S, DiskSync

WAIT_S = 20.0


def test_requests_that_come_during_a_call_become_one(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[int] = []
    begun, proceed, second = threading.Event(), threading.Event(), threading.Event()

    def slow_disk(descriptor: int) -> None:
        calls.append(descriptor)
        if len(calls) == 1:
            begun.set()
            assert proceed.wait(WAIT_S)
        else:
            second.set()

    monkeypatch.setattr(os, 'fsync', slow_disk)
    with DiskSync(7) as sync:
        sync.request()
        assert begun.wait(WAIT_S)
        for _ in range(5):
            sync.request()
        proceed.set()
        assert second.wait(WAIT_S)
    assert calls == [7, 7]


def test_a_fast_run_does_not_ask_the_disk_at_every_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    times_s: list[float] = []
    second = threading.Event()

    def disk(_descriptor: int) -> None:
        times_s.append(time.monotonic())
        if len(times_s) == 2:
            second.set()

    monkeypatch.setattr(os, 'fsync', disk)
    with DiskSync(7) as sync:
        while not second.is_set():
            sync.request()
            time.sleep(0.001)
        begun_s = time.monotonic()
    assert times_s[1] - times_s[0] >= PAUSE_S
    assert time.monotonic() - begun_s < WAIT_S  # closing waits for no pause


def test_an_error_is_told_at_the_next_request(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken_disk(_descriptor: int) -> None:
        raise OSError(5, 'Input/output error')

    monkeypatch.setattr(os, 'fsync', broken_disk)
    others = set(threading.enumerate())
    sync = DiskSync(7)
    (mine,) = set(threading.enumerate()) - others
    sync.request()
    mine.join(WAIT_S)
    assert not mine.is_alive()
    with pytest.raises(OSError, match='Input/output'):
        sync.request()
    sync.close()


def test_no_thread_is_left() -> None:
    before = threading.active_count()
    for _ in range(3):
        with DiskSync(0):
            pass
    assert threading.active_count() == before
