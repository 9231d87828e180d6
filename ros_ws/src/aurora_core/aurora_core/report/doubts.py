# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Doubts about a recording that do not come from the recording itself."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.document import Document
from aurora_core.outcomes.verdict import Verdict, VerdictStatus
from aurora_core.trace.bag_content import worst
from aurora_core.trace.trace import Integrity

# More say nothing more.
_NOTES = 12


class Doubt(Document):
    """Why a recording cannot be believed to be the one of its run.

    Attributes:
        kind: `altered` for what contradicts it, `unknown` where nobody vouches for it.
        text: For people.
    """

    kind: Integrity
    text: str


def altered(text: str) -> Doubt:
    """Return a doubt about something that contradicts the recording."""
    return Doubt(kind=Integrity.ALTERED, text=text)


def unknown(text: str) -> Doubt:
    """Return a doubt about something that is not there to vouch for the recording."""
    return Doubt(kind=Integrity.UNKNOWN, text=text)


def trace_doubts(verdict: Verdict, sha256: str, reported: str, where: str) -> tuple[Doubt, ...]:
    """Return the doubt of a trace that is not the one that a run reported.

    It finds what no digest inside of a bag can: a bag that was rewritten as a whole.

    Args:
        verdict: Of the trace.
        sha256: Trace hash.
        reported: The one in the report.
        where: Name of the report.
    """
    # A bag that lost ticks has another hash too; it says itself that it is cut.
    if sha256 == reported or verdict.integrity is not Integrity.INTACT:
        return ()
    return (altered(f'the trace is not the one of {where} ({reported[:12]} there)'),)


def doubted(verdict: Verdict, doubts: Sequence[Doubt]) -> Verdict:
    """Return a verdict with what doubts leave of it: its margins, and no claim."""
    if not doubts:
        return verdict
    integrity = worst([(verdict.integrity, ''), *((doubt.kind, '') for doubt in doubts)])
    notes = [f'the recording is {doubt.kind.value}: {doubt.text}' for doubt in doubts[:_NOTES]]
    if len(doubts) > _NOTES:
        notes.append(f'and {len(doubts) - _NOTES} more')
    changes = {
        'status': VerdictStatus.INCONCLUSIVE,
        'integrity': integrity,
        'notes': (*verdict.notes, *notes),
    }
    return Verdict.model_validate({**dict(verdict), **changes})
