# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Finished runs as the folder of runs holds them: also those of an earlier process."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from aurora_core.files import DOCUMENT_BYTES, read_text
from aurora_core.report.run_folder import REPORT, is_run_id
from aurora_nodes.jobs import FINISHED


@dataclass(frozen=True, kw_only=True)
class FinishedRun:
    """A run with a report."""

    run_id: str
    run_dir: Path
    status: str
    prompt: str
    report_json: str
    state: str = FINISHED


def read_finished(root: Path, run_id: str) -> FinishedRun | None:
    """Return a finished run, None when there is none.

    Nor is there one when its report cannot be read, or is of another run.
    """
    if not is_run_id(run_id):
        return None
    folder = root / run_id
    try:
        text = read_text(folder / REPORT, DOCUMENT_BYTES)
        report = json.loads(text)
        if report['run_id'] != run_id:
            return None
        return FinishedRun(
            run_id=run_id,
            run_dir=folder,
            status=str(report['status']),
            prompt=str(report['prompt']),
            report_json=text,
        )
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return None


def list_finished(root: Path) -> Iterator[FinishedRun]:
    """Yield the finished runs of a folder, the newest first; each is read when its turn comes."""
    if not root.is_dir():
        return
    for name in sorted((path.name for path in root.iterdir()), reverse=True):
        run = read_finished(root, name)
        if run is not None:
            yield run
