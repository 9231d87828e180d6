# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The trace hash that a run reported, against the trace that its bag holds now.

It finds what no digest inside of a bag can: a bag that was rewritten as a whole.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from pydantic import ValidationError

from aurora_core.files import DOCUMENT_BYTES, read_bytes
from aurora_core.report.run_folder import REPORT
from aurora_core.report.run_report import RunReport, TraceReport
from aurora_core.trace.trace import Integrity, Trace


def recorded_trace(run: Path, bag: str) -> TraceReport | None:
    """Return what a run reported about a bag, None when it reported nothing that can be read.

    Args:
        run: Run folder.
        bag: Name of the bag's folder.
    """
    try:
        report = RunReport.model_validate_json(read_bytes(run / REPORT, DOCUMENT_BYTES))
    except (OSError, ValidationError):
        return None
    return report.trace if report.trace is not None and report.trace.bag == bag else None


def believed(trace: Trace, sha256: str, recorded: TraceReport | None) -> Trace:
    """Return the trace, marked as altered when it is not the one that was reported.

    Args:
        trace: As it was read.
        sha256: Its trace hash.
        recorded: What the run reported; None leaves the trace as it is.
    """
    # A bag that lost ticks has another hash too; it says itself that it is cut.
    if recorded is None or recorded.sha256 == sha256 or trace.integrity is not Integrity.INTACT:
        return trace
    note = f'the trace is not the one of {REPORT} ({recorded.sha256[:12]} there)'
    return replace(trace, integrity=Integrity.ALTERED, integrity_note=note)
