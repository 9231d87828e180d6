# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Why a run was violated: what happened instead, and what may be the reason."""

from __future__ import annotations

from aurora_core.report.run_report import RunReport
from aurora_core.report.status import Status
from aurora_core.report.summary import worst_first

_MOST_ROWS, _MOST_SUSPECTS = 3, 2


def happened_instead(report: RunReport) -> tuple[str, ...]:
    """Return what happened where the worst of the violated conditions were asked for.

    Args:
        report: Of any status; () where nothing is violated.
    """
    if report.status is not Status.VIOLATED:
        return ()
    told = (row.explanation for row in worst_first(report.conditions) if row.explanation)
    return tuple(dict.fromkeys(told))[:_MOST_ROWS]


def suspects(report: RunReport) -> tuple[str, ...]:
    """Return what may be the reason, the likeliest first: a fault that was injected, or else what
    the last attempt of repair found.

    Args:
        report: Of any status; () where nothing is violated, and where nobody looked.
    """
    if report.status is not Status.VIOLATED:
        return ()
    if report.faults:
        return tuple(
            f'injected fault {fault.kind} on {fault.subject} from {fault.at_s:g} s'
            for fault in report.faults
        )
    found = next((r.implicated for r in reversed(report.repairs) if r.implicated), ())
    told = (f'{item.reason} ({item.field})' for item in found)
    return tuple(dict.fromkeys(told))[:_MOST_SUSPECTS]
