# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`VerifyReport`: margins recomputed from a bag, and whether it is believed to be its run's."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from typing import Literal

from aurora_core.document import Document
from aurora_core.outcomes.verdict import Reason, Verdict, VerdictStatus
from aurora_core.report.comparison import Comparison
from aurora_core.report.doubts import Doubt, doubted
from aurora_core.report.run_check import JudgedBag, RunCheck, unread
from aurora_core.report.run_report import ClauseReport
from aurora_core.report.signed_run import SignatureCheck
from aurora_core.report.status import ExitCode, Status
from aurora_core.trace.trace import Integrity

_SHOWN = 3


class VerifyOutcome(StrEnum):
    """What `aurora verify` says in its first line and with its exit code."""

    VERIFIED = 'verified'
    MARGINS_HOLD = 'margins_hold'  # but the run is not verified, or not all of it was encoded
    VIOLATED = 'violated'
    INCONCLUSIVE = 'inconclusive'
    HOLDS_AS_RECORDED = 'holds_as_recorded'
    VIOLATED_AS_RECORDED = 'violated_as_recorded'

    @property
    def exit_code(self) -> ExitCode:
        """Exit code: 0 only for margins that hold on an intact bag."""
        return _EXIT_CODES[self]

    @property
    def heading(self) -> str:
        """First words of the first line."""
        return _HEADINGS.get(self, self.value.replace('_', ' '))


_EXIT_CODES = {
    VerifyOutcome.VERIFIED: ExitCode.OK,
    VerifyOutcome.MARGINS_HOLD: ExitCode.OK,
    VerifyOutcome.VIOLATED: ExitCode.VIOLATED,
    VerifyOutcome.INCONCLUSIVE: ExitCode.BROKEN,
    VerifyOutcome.HOLDS_AS_RECORDED: ExitCode.OK,
    VerifyOutcome.VIOLATED_AS_RECORDED: ExitCode.VIOLATED,
}
_HEADINGS = {
    VerifyOutcome.HOLDS_AS_RECORDED: 'as recorded: margins hold',
    VerifyOutcome.VIOLATED_AS_RECORDED: 'as recorded: violated',
}


class AsRecorded(Document):
    """By what a recording was judged that is another here, or cannot be worked out here.

    Attributes:
        version: Of AURORA, '' when the recording does not tell.
        differs: Versions, limits, tolerances, settings, map: every value, for people.
        otherwise: How much of conditions, bodies and world this version derives otherwise.
    """

    version: str
    differs: tuple[str, ...]
    otherwise: int = 0


class VerifyReport(Document):
    """What a bag shows, and whether it can be believed to be the one of its run.

    Attributes:
        bag: Folder of the bag.
        outcome: What the first line and the exit code say.
        summary: Rest of the first line.
        prompt: In the bag.
        verdict: Margins from the bag; inconclusive when the run folder contradicts it.
        recorded: The verdict of the run beside it, None when there is none.
        run: What the run folder says, None for a bag that lies alone.
        unread: Clauses of the prompt that are not encoded, or not judged.
        as_recorded: Set when it was judged by something else than is installed.
        signature: Of the run, None unless trusted keys were named.
    """

    schema_version: Literal[1] = 1
    bag: str
    outcome: VerifyOutcome
    summary: str
    prompt: str
    ticks: int
    trace_sha256: str
    motion_sha256: str
    verdict: Verdict
    recorded: Comparison | None = None
    run: RunCheck | None = None
    unread: tuple[ClauseReport, ...] = ()
    as_recorded: AsRecorded | None = None
    signature: SignatureCheck | None = None

    @property
    def doubts(self) -> tuple[Doubt, ...]:
        """Why the bag cannot be believed to be the one of its run: signature, then folder."""
        signature = self.signature.doubts if self.signature is not None else ()
        return (*signature, *(self.run.doubts if self.run is not None else ()))


def verify_report(
    name: str,
    bag: JudgedBag,
    *,
    run: RunCheck | None = None,
    recorded: Comparison | None = None,
    as_recorded: AsRecorded | None = None,
    signature: SignatureCheck | None = None,
) -> VerifyReport:
    """Return the report about a bag.

    Args:
        name: Folder of the bag.
        bag: What was found out about it from itself alone.
        run: What its run folder says, None when it lies alone.
        recorded: Another verdict about the same run.
        as_recorded: By what it was judged, when not by what is installed.
        signature: Of its run, where trusted keys were named.
    """
    doubts = signature.doubts if signature is not None else ()
    verdict = doubted(bag.verdict, (*doubts, *(run.doubts if run is not None else ())))
    report = VerifyReport(
        bag=name,
        outcome=_outcome(verdict, recorded, run, bag.clauses, as_recorded),
        summary='',
        prompt=bag.agsg.spec.prompt,
        ticks=bag.content.trace.ticks,
        trace_sha256=bag.hashes.trace_sha256,
        motion_sha256=bag.hashes.motion_sha256,
        verdict=verdict,
        recorded=recorded,
        run=run,
        unread=unread(bag.clauses),
        as_recorded=as_recorded,
        signature=signature,
    )
    return VerifyReport.model_validate({**dict(report), 'summary': _summary(report)})


def _outcome(
    verdict: Verdict,
    recorded: Comparison | None,
    run: RunCheck | None,
    clauses: Sequence[ClauseReport],
    as_recorded: AsRecorded | None,
) -> VerifyOutcome:
    differs = recorded is not None and not recorded.equal
    undecided = verdict.status is VerdictStatus.INCONCLUSIVE or bool(verdict.cross_check)
    if differs or undecided or verdict.integrity is not Integrity.INTACT or not verdict.results:
        return VerifyOutcome.INCONCLUSIVE
    if verdict.status is VerdictStatus.VIOLATED:
        if as_recorded is not None:
            return VerifyOutcome.VIOLATED_AS_RECORDED
        return VerifyOutcome.VIOLATED
    if as_recorded is not None:
        return VerifyOutcome.HOLDS_AS_RECORDED
    whole = bool(clauses) and not unread(clauses)
    if not whole or (run is not None and run.status is not Status.VERIFIED):
        return VerifyOutcome.MARGINS_HOLD
    return VerifyOutcome.VERIFIED


def _summary(report: VerifyReport) -> str:
    verdict = report.verdict
    held = sum(result.satisfied for result in verdict.results)
    text = (
        f'{held} of {len(verdict.results)} conditions hold, recomputed from the bag alone '
        f'({report.ticks} ticks, {verdict.integrity.value}).'
    )
    said = [text]
    if report.outcome is VerifyOutcome.INCONCLUSIVE:
        said.insert(0, f'Nothing is claimed: {_why(report)}.')
    if report.as_recorded is not None:
        said.insert(0, _judged_by(report.as_recorded))
    if report.signature is not None and not report.signature.doubts:
        signature = report.signature
        said.insert(0, f'Signed by {signature.key}, {signature.files} files as signed.')
    said += _limits_of(report)
    if report.run is None:
        said.append('No run folder: the bag was judged by itself.')
    return ' '.join(said)


def _limits_of(report: VerifyReport) -> list[str]:
    """Return what keeps margins that hold from being a verified run."""
    said = []
    run = report.run
    holds = report.outcome in (VerifyOutcome.MARGINS_HOLD, VerifyOutcome.HOLDS_AS_RECORDED)
    ended = run.status if run is not None and holds else None
    if ended not in (None, Status.VERIFIED):
        said.append(f'The run itself ended {ended.value.replace("_", " ")}.')
    if report.unread:
        quoted = _some([f'“{clause.text}”' for clause in report.unread])
        said.append(f'Not all of the prompt is encoded and judged: {quoted}.')
    elif report.outcome is VerifyOutcome.MARGINS_HOLD and run is None:
        said.append('The prompt was not divided into clauses.')
    return said


def _judged_by(foreign: AsRecorded) -> str:
    if not foreign.version:
        return f'Judged as recorded: {foreign.differs[0]}.'
    text = f'Judged under version {foreign.version} with what is another here: '
    text += _some(foreign.differs)
    if foreign.otherwise:
        text += f'; {foreign.otherwise} of its conditions, bodies or world differ from what '
        text += 'this version derives'
    return f'{text}.'


def _why(report: VerifyReport) -> str:
    """Return the first thing that keeps a verdict from being one, and how many there are."""
    verdict = report.verdict
    reasons = [doubt.text for doubt in report.doubts]
    if verdict.integrity is not Integrity.INTACT and not reasons:
        reasons += verdict.notes or (f'the recording is {verdict.integrity.value}',)
    reasons += [finding.text for finding in verdict.cross_check]
    if report.recorded is not None and not report.recorded.equal:
        reasons.append(f'{report.recorded.file} differs from the recomputation')
    undecided = [r for r in verdict.results if r.reason is not None and r.reason.undecided]
    reasons += [f'{r.sentence} {_UNDECIDED.get(r.reason, "")}' for r in undecided]
    if not reasons:
        return 'no condition was judged'
    more = f' (and {len(reasons) - 1} more)' if len(reasons) > 1 else ''
    return f'{reasons[0]}{more}'


_UNDECIDED: dict[Reason | None, str] = {
    Reason.SAMPLES_MISSING: 'cannot be decided: samples are missing',
    Reason.TRACE_SHORT: 'cannot be decided: the recording is too short',
}


def _some(texts: Sequence[str]) -> str:
    more = f', and {len(texts) - _SHOWN} more' if len(texts) > _SHOWN else ''
    return ', '.join(texts[:_SHOWN]) + more
