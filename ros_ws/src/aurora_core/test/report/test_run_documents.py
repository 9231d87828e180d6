# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A document of a run folder that is none is told of, whatever it holds."""

from __future__ import annotations

from pathlib import Path

import pytest

from aurora_core.report.run_documents import Unreadable, read_document
from aurora_core.report.run_report import RunReport

BAD = {
    'null': 'null',
    'empty': '',
    'list': '[1]',
    'object': '{}',
    'deep': '[' * 100_000,
    'deep object': '{"prompt":' * 50_000,
    'version': '{"schema_version": 99}',
    'long number': '{"seed": ' + '9' * 100_000 + '}',
    'not UTF-8': '\udcff',
}


@pytest.mark.parametrize('name', BAD)
def test_what_is_no_report_is_told(tmp_path: Path, name: str) -> None:
    path = tmp_path / 'report.json'
    path.write_bytes(BAD[name].encode('utf-8', 'surrogateescape'))
    found = read_document(path, RunReport)
    assert isinstance(found, Unreadable)
    assert not found.missing
    assert found.why.startswith('report.json is not what a run writes')
    assert len(found.why) < 300


def test_a_file_that_is_not_there_is_missing(tmp_path: Path) -> None:
    found = read_document(tmp_path / 'report.json', RunReport)
    assert found == Unreadable(missing=True, why='report.json is missing')
    (tmp_path / 'folder').mkdir()
    found = read_document(tmp_path / 'folder', RunReport)
    assert isinstance(found, Unreadable)
    assert not found.missing
