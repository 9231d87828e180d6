# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What every command would compile anew is compiled when it changes, and only then."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

import prepared
from console import SetupError
from layout import Layout


class _Runs:
    """Stands for running a command."""

    def __init__(self, code: int = 0) -> None:
        self.code = code
        self.commands: list[Sequence[str]] = []

    def __call__(
        self, command: Sequence[str], log: Path, *, label: str, environment: Mapping[str, str]
    ) -> int:
        assert environment['PYTHONPATH'].startswith(str(log.parents[2] / 'build' / 'words'))
        log.parent.mkdir(parents=True, exist_ok=True)
        log.write_text('told')
        self.commands.append(command)
        return self.code


@pytest.fixture
def layout(tmp_path: Path) -> Layout:
    package = tmp_path / 'ros_ws' / 'src' / 'words'
    (package / 'words').mkdir(parents=True)
    (package / 'test').mkdir()
    (package / 'package.xml').write_text('<package><name>words</name></package>')
    (package / 'words' / 'words.yaml').write_text('one')
    (package / 'words' / 'read.py').write_text('pass')
    (package / 'test' / 'test_words.py').write_text('pass')
    (tmp_path / 'ros_ws' / 'build' / 'words').mkdir(parents=True)
    made = Layout(root=tmp_path, ros='wheels', python_tag='3.11')
    made.run_lock.parent.mkdir()
    made.run_lock.write_text('lock')
    return made


def test_modules_and_data_count_and_tests_do_not(layout: Layout) -> None:
    assert [path.name for path in prepared.sources(layout)] == ['read.py', 'words.yaml']


def test_it_is_done_again_when_a_source_changes(
    layout: Layout, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs = _Runs()
    monkeypatch.setattr(prepared, 'run_logged', runs)
    for text, count in (('one', 1), ('one', 1), ('two', 2)):
        (layout.workspace / 'src' / 'words' / 'words' / 'words.yaml').write_text(text)
        prepared.ensure_prepared(layout)
        assert len(runs.commands) == count


def test_what_cannot_be_compiled_is_told_and_tried_again(
    layout: Layout, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs = _Runs(code=1)
    monkeypatch.setattr(prepared, 'run_logged', runs)
    for count in (1, 2):
        with pytest.raises(SetupError, match='told'):
            prepared.ensure_prepared(layout)
        assert len(runs.commands) == count
