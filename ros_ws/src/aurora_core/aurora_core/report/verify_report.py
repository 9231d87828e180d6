# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`VerifyReport`: margins recomputed from a bag alone, beside what the run recorded."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import FiniteFloat, ValidationError

from aurora_core.errors import ReportError
from aurora_core.files import DOCUMENT_BYTES, read_bytes
from aurora_core.monitor.verdict import ConditionResult, Verdict, VerdictStatus
from aurora_core.report.status import ExitCode
from aurora_core.spec.parameter import Document
from aurora_core.trace.trace import Integrity


class Difference(Document):
    """A condition whose recomputed result is not the recorded one.

    Attributes:
        recorded: Margin in the run's file, None when there is none.
        recomputed: Margin from the bag, None when there is none.
        what: Which fields differ, or that the condition is in one of them only.
    """

    condition: str
    recorded: FiniteFloat | None
    recomputed: FiniteFloat | None
    what: str


class Comparison(Document):
    """The run's own verdict file against the recomputation.

    Attributes:
        file: Name of the verdict file.
        equal: Every value is the same to the last bit.
        differences: Where it is not.
    """

    file: str
    equal: bool
    differences: tuple[Difference, ...] = ()


class VerifyReport(Document):
    """What a bag shows.

    Attributes:
        bag: Folder of the bag.
        recorded: None when the bag lies alone, without the run's verdict.
    """

    schema_version: Literal[1] = 1
    bag: str
    ticks: int
    trace_sha256: str
    verdict: Verdict
    recorded: Comparison | None = None


def read_recorded(path: Path) -> Verdict | None:
    """Return the verdict that a run wrote, None when there is no such file.

    Raises:
        ReportError: The file is damaged.
    """
    try:
        return Verdict.model_validate_json(read_bytes(path, DOCUMENT_BYTES))
    except FileNotFoundError:
        return None
    except (OSError, ValidationError) as err:
        raise ReportError(
            f'{path} cannot be read as a verdict: {err}',
            hint='name the bag itself to verify it without the record',
        ) from err


def compare(recorded: Verdict, recomputed: Verdict, file: str) -> Comparison:
    """Compare two verdicts bit by bit (JSON keeps every bit of a float).

    Notes are left out: they tell of the installation that judged, not of the run.
    """
    ours = {result.id: result for result in recomputed.results}
    theirs = {result.id: result for result in recorded.results}
    differences = []
    for name in dict.fromkeys((*theirs, *ours)):
        a, b = theirs.get(name), ours.get(name)
        what = _difference(a, b)
        if what:
            differences.append(
                Difference(
                    condition=name,
                    recorded=a.margin if a is not None else None,
                    recomputed=b.margin if b is not None else None,
                    what=what,
                )
            )
    return Comparison(
        file=file,
        equal=_judged(recorded) == _judged(recomputed),
        differences=tuple(differences),
    )


def _judged(verdict: Verdict) -> str:
    return Verdict.model_validate(dict(verdict) | {'notes': ()}).canonical_json()


def _difference(recorded: ConditionResult | None, recomputed: ConditionResult | None) -> str:
    if recorded is None:
        return 'not in the record'
    if recomputed is None:
        return 'not in the bag'
    a, b = recorded.model_dump(mode='json'), recomputed.model_dump(mode='json')
    return ', '.join(name for name in a if a[name] != b[name])


def verify_exit_code(report: VerifyReport) -> ExitCode:
    """Return the exit code of `aurora verify`: 0 only for margins that hold on an intact bag."""
    verdict = report.verdict
    if report.recorded is not None and not report.recorded.equal:
        return ExitCode.BROKEN
    if verdict.status is VerdictStatus.INCONCLUSIVE or verdict.integrity is not Integrity.INTACT:
        return ExitCode.BROKEN
    if verdict.status is VerdictStatus.VIOLATED:
        return ExitCode.VIOLATED
    return ExitCode.OK if verdict.results else ExitCode.BROKEN
