# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import subprocess
import sys

import pytest

from aurora_core.report import process
from aurora_core.report.process import ProcessIdentity, process_lives, this_process


def _changed(identity: ProcessIdentity, **values: object) -> ProcessIdentity:
    return ProcessIdentity.model_validate({**identity.model_dump(), **values})


def test_this_process_lives() -> None:
    assert process_lives(this_process())


def test_a_process_that_ended_does_not_live() -> None:
    child = subprocess.Popen([sys.executable, '-c', ''])
    child.wait()
    assert not process_lives(_changed(this_process(), pid=child.pid, started=''))


def test_a_process_id_that_is_used_again_is_another_process() -> None:
    assert not process_lives(_changed(this_process(), started='boot/1'))


def test_a_process_of_another_machine_may_live() -> None:
    assert process_lives(_changed(this_process(), host='elsewhere', pid=999_999_999))


def test_where_the_system_tells_no_start_the_id_decides(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process, '_started', lambda _pid: '')
    identity = this_process()
    assert identity.started == ''
    assert process_lives(identity)
