# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Too little address space is an error in words, before libsumo dies of it."""

from __future__ import annotations

import resource

import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_sumo_bridge.room import ROOM_BYTES, check_room


@pytest.mark.parametrize('limit', [resource.RLIM_INFINITY, 1 << 42])
def test_where_there_is_room_nothing_is_said(limit: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resource, 'getrlimit', lambda _: (limit, limit))
    check_room()


def test_too_little_room_is_told_with_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resource, 'getrlimit', lambda _: (ROOM_BYTES, ROOM_BYTES))
    with pytest.raises(GroundSimulatorError, match='SUMO needs 900 MiB') as caught:
        check_room()
    assert caught.value.hint == 'raise ulimit -v'
