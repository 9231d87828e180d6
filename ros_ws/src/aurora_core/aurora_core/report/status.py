# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The one status of a run, and its exit code."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum, StrEnum


class Status(StrEnum):
    """What a run may claim; see `status_of`."""

    VERIFIED = 'verified'
    VERIFIED_AS_EDITED = 'verified_as_edited'
    INCOMPLETE = 'incomplete'
    VIOLATED = 'violated'
    INCONCLUSIVE = 'inconclusive'
    INFEASIBLE = 'infeasible'
    NOT_UNDERSTOOD = 'not_understood'
    ERROR = 'error'
    CANCELLED = 'cancelled'


class ExitCode(IntEnum):
    """Exit codes of the command."""

    OK = 0
    VIOLATED = 1
    NOT_DONE = 3  # not_understood, incomplete
    BROKEN = 4  # error, inconclusive
    INFEASIBLE = 5
    UNKNOWN = 6  # check: neither proved feasible nor infeasible
    USAGE = 64
    CANCELLED = 130


# A run that ended so claims nothing of what it was to show.
CLAIMS_NOTHING = (Status.ERROR, Status.CANCELLED, Status.INCONCLUSIVE)

_EXIT_CODES = {
    Status.VERIFIED: ExitCode.OK,
    Status.VERIFIED_AS_EDITED: ExitCode.OK,
    Status.INCOMPLETE: ExitCode.NOT_DONE,
    Status.VIOLATED: ExitCode.VIOLATED,
    Status.INCONCLUSIVE: ExitCode.BROKEN,
    Status.INFEASIBLE: ExitCode.INFEASIBLE,
    Status.NOT_UNDERSTOOD: ExitCode.NOT_DONE,
    Status.ERROR: ExitCode.BROKEN,
    Status.CANCELLED: ExitCode.CANCELLED,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class StatusFacts:
    """All that the status depends on.

    Attributes:
        error: Something broke.
        cancelled: By the user.
        understood: There is a valid specification (or what it lacks is proven not to exist).
        infeasible: Refused with a certificate.
        judged: There is a verdict over at least one condition.
        undecided: The verdict lacks what it needs, or record and recomputation disagree.
        violated: A condition does not hold.
        encoded: Every clause of the prompt is encoded or needs nothing.
        edited: The request was changed with the user's leave.
    """

    error: bool = False
    cancelled: bool = False
    understood: bool = True
    infeasible: bool = False
    judged: bool = False
    undecided: bool = False
    violated: bool = False
    encoded: bool = True
    edited: bool = False


def status_of(facts: StatusFacts) -> Status:
    """Return the first status that applies; without a verdict nothing better than inconclusive."""
    ladder = (
        (facts.error, Status.ERROR),
        (facts.cancelled, Status.CANCELLED),
        (not facts.understood, Status.NOT_UNDERSTOOD),
        (facts.infeasible, Status.INFEASIBLE),
        (facts.undecided or not facts.judged, Status.INCONCLUSIVE),
        (facts.violated, Status.VIOLATED),
        (not facts.encoded, Status.INCOMPLETE),
        (facts.edited, Status.VERIFIED_AS_EDITED),
    )
    for applies, status in ladder:
        if applies:
            return status
    return Status.VERIFIED


def exit_code(status: Status) -> ExitCode:
    """Return the exit code of `aurora run` for a status."""
    return _EXIT_CODES[status]
