# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Parameter files: every node's own is complete, and damage is named."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import ConfigError
from aurora_ros.parameters import read_parameters, require_positive


@dataclass(frozen=True, kw_only=True)
class Settings:
    enabled: bool
    count: int
    limit_s: float
    name: str
    topics: tuple[str, ...]


GOOD = """/**:
  ros__parameters:
    enabled: true
    count: 3
    limit_s: 2.5
    name: "x"
    topics: ["a", "b"]
"""


def write(tmp_path: Path, text: str) -> Path:
    path = tmp_path / 'n.param.yaml'
    path.write_text(text, encoding='utf-8')
    return path


def test_values_by_type(tmp_path: Path) -> None:
    assert read_parameters(write(tmp_path, GOOD), Settings) == {
        'enabled': True,
        'count': 3,
        'limit_s': 2.5,
        'name': 'x',
        'topics': ('a', 'b'),
    }


@pytest.mark.parametrize(
    ('old', 'new', 'match'),
    [
        ('    count: 3\n', '', 'expected the parameters'),
        ('    count: 3\n', '    count: 3\n    more: 1\n', 'more'),
        ('count: 3', 'count: true', 'count in'),
        ('count: 3', 'count: 3.0', 'count in'),
        ('limit_s: 2.5', 'limit_s: 2', 'limit_s in'),
        ('enabled: true', 'enabled: "true"', 'enabled in'),
        ('topics: ["a", "b"]', 'topics: "a"', 'topics in'),
        ('ros__parameters', 'parameters', 'expected parameters under'),
        ('/**:', '/**: [', 'expected parameters under'),
    ],
)
def test_a_damaged_file_is_named(tmp_path: Path, old: str, new: str, match: str) -> None:
    assert old in GOOD
    path = write(tmp_path, GOOD.replace(old, new))
    with pytest.raises(ConfigError, match=match) as caught:
        read_parameters(path, Settings)
    assert str(path) in caught.value.message


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r'gone\.param\.yaml'):
        read_parameters(tmp_path / 'gone.param.yaml', Settings)


@pytest.mark.parametrize('count', [0, -1])
def test_numbers_that_must_be_positive(count: int) -> None:
    settings = Settings(enabled=True, count=count, limit_s=1.0, name='', topics=())
    with pytest.raises(ValueError, match=f'count must be above 0, found {count}'):
        require_positive(settings, 'limit_s', 'count')
