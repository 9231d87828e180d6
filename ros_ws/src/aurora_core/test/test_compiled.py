# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What set-up makes from files stands for them only as long as it was made from these files."""

from __future__ import annotations

from pathlib import Path

import pytest

from aurora_core.compiled import Compiled


@pytest.fixture
def source(tmp_path: Path) -> Path:
    path = tmp_path / 'words.yaml'
    path.write_text('one')
    return path


def _compiled(source: Path, made: list[str]) -> Compiled:
    def make() -> dict[str, str]:
        made.append(source.read_text())
        return {'text': made[-1]}

    return Compiled(name='words', sources=(source,), make=make)


def test_a_value_is_made_once_and_then_read(source: Path) -> None:
    made: list[str] = []
    _compiled(source, made).write()
    assert _compiled(source, made).value() == {'text': 'one'}
    assert made == ['one']


def test_without_set_up_it_is_made_and_nothing_is_written(source: Path) -> None:
    made: list[str] = []
    assert _compiled(source, made).value() == {'text': 'one'}
    assert list(source.parent.iterdir()) == [source]


def test_a_changed_source_counts_at_once(source: Path) -> None:
    made: list[str] = []
    _compiled(source, made).write()
    source.write_text('two')
    assert _compiled(source, made).value() == {'text': 'two'}


@pytest.mark.parametrize('cut', [0, 10, 40, -1])
def test_a_cut_file_is_made_anew(source: Path, cut: int) -> None:
    made: list[str] = []
    path = _compiled(source, made).write()
    path.write_bytes(path.read_bytes()[:cut])
    assert _compiled(source, made).value() == {'text': 'one'}
    assert len(made) == 2


def test_a_damaged_file_is_made_anew(source: Path) -> None:
    made: list[str] = []
    path = _compiled(source, made).write()
    data = bytearray(path.read_bytes())
    data[-1] ^= 1
    path.write_bytes(data)
    assert _compiled(source, made).value() == {'text': 'one'}


def test_a_folder_that_may_not_be_written_leaves_nothing_behind(source: Path) -> None:
    made: list[str] = []
    compiled = _compiled(source, made)
    compiled.path.parent.write_text('in the way')
    with pytest.raises(OSError, match='exist'):
        compiled.write()
    assert compiled.value() == {'text': 'one'}


def test_what_else_decides_it_counts_too(source: Path) -> None:
    one = Compiled(name='words', sources=(source,), key='one map', make=lambda: 'made of one')
    one.write()
    other = Compiled(
        name='words', sources=(source,), key='another', make=lambda: 'made of another'
    )
    assert other.path == one.path
    assert (one.value(), other.value()) == ('made of one', 'made of another')
