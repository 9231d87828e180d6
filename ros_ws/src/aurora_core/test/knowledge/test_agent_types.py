# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Agent types: complete, with sizes that make sense, or a clear error."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from aurora_core.errors import ConfigError
from aurora_core.knowledge.agent_types import load_agent_types
from aurora_core.knowledge.config_files import config_path
from aurora_core.spec.vocabulary import AgentType


def _use(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, change: Any) -> None:
    table = json.loads(config_path('knowledge', 'agent_types.json').read_text(encoding='utf-8'))
    change(table)
    _write(tmp_path, monkeypatch, json.dumps(table).encode())


def _write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, data: bytes) -> None:
    (tmp_path / 'knowledge').mkdir()
    (tmp_path / 'knowledge' / 'agent_types.json').write_bytes(data)
    monkeypatch.setenv('AURORA_CONFIG_DIR', str(tmp_path))


def test_every_type_of_the_vocabulary_has_a_record() -> None:
    types = load_agent_types()
    assert set(types) == {t.value for t in AgentType}
    assert list(types) == sorted(types)
    assert types['bus'].length_m > types['car'].length_m > types['motorcycle'].length_m
    assert [n for n, record in types.items() if record.is_person] == ['pedestrian', 'rsu']


@pytest.mark.parametrize(
    ('change', 'named'),
    [
        (lambda t: t['types'][0].update(length_m=0.0), 'length_m'),
        (lambda t: t['types'][0].update(width_m='wide'), 'width_m'),
        (lambda t: t['types'][0].pop('vclass'), 'vclass'),
        (lambda t: t['types'][0].update(height_m=float('inf')), 'height_m'),
        (lambda t: t.pop('types'), 'types'),
        (lambda t: t.update(types=3), 'types'),
        (lambda t: t['types'].append(t['types'][0]), 'types repeats a name'),
        (
            lambda t: t.update(types=[r for r in t['types'] if r['name'] != 'bus']),
            'types lacks bus',
        ),
    ],
)
def test_a_bad_record_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, change: Any, named: str
) -> None:
    _use(tmp_path, monkeypatch, change)
    with pytest.raises(ConfigError) as caught:
        load_agent_types()
    assert named in caught.value.message
    assert 'agent_types.json' in caught.value.message


@pytest.mark.parametrize('data', [b'', b'[]', b'null', b'\xff'])
def test_what_is_no_table_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, data: bytes
) -> None:
    _write(tmp_path, monkeypatch, data)
    with pytest.raises(ConfigError, match='is not valid'):
        load_agent_types()


def test_a_file_that_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / 'knowledge' / 'agent_types.json').mkdir(parents=True)
    monkeypatch.setenv('AURORA_CONFIG_DIR', str(tmp_path))
    with pytest.raises(ConfigError, match='cannot be read'):
        load_agent_types()
