# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The history: only verified runs enter, a frozen one takes nothing in."""

from __future__ import annotations

from pathlib import Path

import pytest

from aurora_core.errors import ConfigError
from aurora_core.report.status import Status
from aurora_core.retrieval.episodes import Episode, EpisodeStore


def episode(name: str = 'run-1', status: str = 'verified') -> Episode:
    return Episode(
        id=name,
        prompt='A drone hovers.',
        map_name='downtown',
        status=status,
        elements=('hover ego',),
        conditions=('The drone stays.',),
        worst_normalised=0.4,
        trace_sha256='ab',
    )


def test_verified_runs_come_back_by_id(tmp_path: Path) -> None:
    store = EpisodeStore(tmp_path / 'history')
    assert store.episodes() == ()
    assert store.add(episode('b'))
    assert store.add(episode('a'))
    assert [e.id for e in store.episodes()] == ['a', 'b']
    assert 'A drone hovers.' in store.episodes()[0].record().text


@pytest.mark.parametrize('status', [s.value for s in Status if s is not Status.VERIFIED])
def test_no_other_run_enters(tmp_path: Path, status: str) -> None:
    store = EpisodeStore(tmp_path)
    assert not store.add(episode(status=status))
    assert list(tmp_path.iterdir()) == []


def test_a_frozen_history_is_read_only(tmp_path: Path) -> None:
    EpisodeStore(tmp_path).add(episode('a'))
    frozen = EpisodeStore(tmp_path, frozen=True)
    assert not frozen.add(episode('b'))
    assert [e.id for e in frozen.episodes()] == ['a']


def test_files_that_are_none_are_named(tmp_path: Path) -> None:
    (tmp_path / 'x.json').write_text('{}')
    with pytest.raises(ConfigError, match=r'x\.json'):
        EpisodeStore(tmp_path).episodes()
    (tmp_path / 'x.json').write_text(episode(status='violated').model_dump_json())
    with pytest.raises(ConfigError, match='violated'):
        EpisodeStore(tmp_path).episodes()
    with pytest.raises(ConfigError, match='id'):
        EpisodeStore(tmp_path).add(episode('../x'))
