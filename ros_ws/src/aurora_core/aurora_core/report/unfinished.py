# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Close the runs that a crash left without a report: they end as `error`, never silently."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from pydantic import ValidationError

from aurora_core.errors import ReportError
from aurora_core.files import DOCUMENT_BYTES, MANIFEST_BYTES, read_bytes, read_text
from aurora_core.report.build import build_report
from aurora_core.report.facts import RunFacts
from aurora_core.report.finished import with_finished
from aurora_core.report.manifest import Manifest
from aurora_core.report.process import ProcessIdentity, process_lives
from aurora_core.report.run_folder import MANIFEST, PROMPT, REPORT, RunFolder, is_run_id


def close_unfinished(
    root: Path, lives: Callable[[ProcessIdentity], bool] = process_lives
) -> tuple[str, ...]:
    """Write a report with status `error` into every run that nobody will finish.

    Args:
        root: Folder of all runs; there need not be one.
        lives: Tells whether the process of a manifest may still live; those runs, and runs
            without a readable manifest, are left alone.

    Returns:
        Ids of the runs that were closed, sorted.

    Raises:
        ReportError: A report cannot be written.
    """
    closed = []
    for path in sorted(root.glob(f'*/{MANIFEST}')):
        folder = path.parent
        if not is_run_id(folder.name) or (folder / REPORT).exists():
            continue
        manifest = _read_manifest(path)
        if manifest is None or lives(manifest.process):
            continue
        _close(RunFolder(root, folder.name), manifest)
        closed.append(folder.name)
    return tuple(closed)


def _read_manifest(path: Path) -> Manifest | None:
    try:
        return Manifest.model_validate_json(read_bytes(path, MANIFEST_BYTES))
    except (OSError, ValidationError):
        return None


def _close(folder: RunFolder, manifest: Manifest) -> None:
    try:
        prompt = read_text(folder.file(PROMPT), DOCUMENT_BYTES, 'replace')
    except OSError:
        prompt = ''
    request = manifest.request
    facts = RunFacts(
        run_id=folder.run_id,
        prompt=prompt,
        engine=request.engine,
        model=request.model,
        map_name=request.map_name,
        seed=request.seed,
        versions=manifest.versions,
        faults=request.faults,
        error=ReportError(
            f'the process {manifest.process.pid} that ran it is gone and left no report',
            hint='the stages that were finished are in the run folder; run the prompt again',
        ),
    )
    folder.write_json(REPORT, build_report(with_finished(facts, folder)))
