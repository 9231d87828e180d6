# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

from aurora_core.report.build import build_report
from aurora_core.report.outputs import write_outputs
from aurora_core.report.run_folder import RunFolder
from aurora_core.report.run_report import RunReport


def _folder(tmp_path: Path, make: SimpleNamespace) -> RunFolder:
    folder = RunFolder(tmp_path, make.run_id)
    folder.create()
    return folder


def test_a_run_without_a_bag_has_report_and_page(tmp_path: Path, make: SimpleNamespace) -> None:
    folder = _folder(tmp_path, make)
    report = build_report(make.facts(execution=None, verdict=None))
    write_outputs(report, folder)
    assert sorted(path.name for path in folder.path.iterdir()) == ['report.html', 'report.json']
    assert RunReport.model_validate_json(folder.file('report.json').read_bytes()) == report


def test_a_bag_that_cannot_be_read_costs_the_picture_only(
    tmp_path: Path, make: SimpleNamespace
) -> None:
    folder = _folder(tmp_path, make)
    folder.bag_path(0).mkdir()
    (folder.bag_path(0) / 'bag.0_0.mcap').write_bytes(b'not a recording')
    write_outputs(build_report(make.facts()), folder)
    assert folder.file('report.html').exists()
    assert not folder.file('picture.png').exists()
