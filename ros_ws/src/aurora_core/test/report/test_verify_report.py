# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The first line of `aurora verify` and its exit code are one decision."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from aurora_core.outcomes.verdict import Finding, VerdictStatus
from aurora_core.report.comparison import compare
from aurora_core.report.doubts import Doubt, altered, unknown
from aurora_core.report.run_check import RunCheck
from aurora_core.report.status import Status
from aurora_core.report.verify_report import AsRecorded, VerifyOutcome, verify_report
from aurora_core.spec.vocabulary import ClauseStatus
from aurora_core.trace.trace import Integrity

FINDING = Finding(kind='sight', subject='uav1', tick=3, time_s=0.15, text='not seen at all')
INCONCLUSIVE = VerdictStatus.INCONCLUSIVE
# Code, then the first words of the line.
EXIT = {
    VerifyOutcome.VERIFIED: 0,
    VerifyOutcome.MARGINS_HOLD: 0,
    VerifyOutcome.VIOLATED: 1,
    VerifyOutcome.INCONCLUSIVE: 4,
    VerifyOutcome.HOLDS_AS_RECORDED: 0,
    VerifyOutcome.VIOLATED_AS_RECORDED: 1,
}


def of_run(status: Status | None, *doubts: Doubt) -> RunCheck:
    return RunCheck(run_id='r', status=status, doubts=doubts)


def test_each_outcome_has_one_code_and_a_heading_that_does_not_claim_more() -> None:
    assert {outcome: int(outcome.exit_code) for outcome in VerifyOutcome} == EXIT
    claiming = [outcome for outcome in VerifyOutcome if outcome.heading == 'verified']
    assert claiming == [VerifyOutcome.VERIFIED]


@pytest.mark.parametrize(
    ('verdict', 'run', 'wanted', 'said'),
    [
        ({}, None, 'verified', 'No run folder: the bag was judged by itself.'),
        ({}, of_run(Status.VERIFIED), 'verified', '1 of 1 conditions hold'),
        ({}, of_run(Status.INCOMPLETE), 'margins_hold', 'The run itself ended incomplete.'),
        ({}, of_run(Status.CANCELLED), 'margins_hold', 'The run itself ended cancelled.'),
        ({}, of_run(None, unknown('no report')), 'inconclusive', 'Nothing is claimed: no report.'),
        (
            {},
            of_run(Status.VERIFIED, altered('a'), altered('b')),
            'inconclusive',
            'a (and 1 more)',
        ),
        ({'margin': -1.0}, of_run(Status.VIOLATED), 'violated', '0 of 1 conditions hold'),
        ({'margin': -1.0}, None, 'violated', 'No run folder'),
        ({'margin': -1.0}, of_run(Status.VIOLATED, altered('a')), 'inconclusive', 'claimed: a.'),
        ({'status': INCONCLUSIVE, 'cross_check': (FINDING,)}, None, 'inconclusive', 'not seen'),
        # A status that says more than the findings beside it is not believed.
        ({'cross_check': (FINDING,)}, None, 'inconclusive', 'not seen at all'),
        ({'integrity': Integrity.ALTERED}, None, 'inconclusive', 'the recording is altered'),
        ({'results': ()}, None, 'inconclusive', 'no condition was judged'),
    ],
)
def test_the_first_line_says_what_the_exit_code_says(
    make: SimpleNamespace, verdict: dict[str, Any], run: RunCheck | None, wanted: str, said: str
) -> None:
    changes = dict(verdict)
    margin = changes.pop('margin', 0.2)
    bag = make.judged(make.verdict(make.result(margin=margin), **changes))
    report = verify_report('bag.0', bag, run=run)
    assert report.outcome.value == wanted
    assert said in report.summary
    assert report.verdict.status.value == {'margins_hold': 'verified'}.get(wanted, wanted) or (
        wanted == 'inconclusive'
    )


def test_clauses_that_nobody_encoded_are_quoted_and_keep_it_from_being_verified(
    make: SimpleNamespace,
) -> None:
    read = make.judged(make.verdict()).clauses[0]
    lost = read.model_copy(update={'status': ClauseStatus.NOT_ENCODED})
    bag = make.judged(make.verdict(), read, lost)
    for run in (None, of_run(Status.INCOMPLETE), of_run(Status.VERIFIED)):
        report = verify_report('bag.0', bag, run=run)
        assert report.outcome is VerifyOutcome.MARGINS_HOLD
        assert '“at 40 meters”' in report.summary
        assert report.unread == (lost,)


def test_another_verdict_of_the_same_run_is_no_pass(make: SimpleNamespace) -> None:
    ours, theirs = make.verdict(), make.verdict(make.result(margin=0.25))
    same = verify_report('b', make.judged(ours), recorded=compare(ours, ours, 'v'))
    assert same.outcome is VerifyOutcome.VERIFIED
    other = verify_report('b', make.judged(ours), recorded=compare(theirs, ours, 'v'))
    assert other.outcome is VerifyOutcome.INCONCLUSIVE
    assert 'v differs from the recomputation' in other.summary


def test_what_was_judged_as_recorded_says_so_first(make: SimpleNamespace) -> None:
    differs = ('limits.clearance_min_m 0.1 (here 5.0)', *(f'x{k} 1 (here 2)' for k in range(4)))
    foreign = AsRecorded(version='0.0.9', differs=differs, otherwise=2)
    held = verify_report('b', make.judged(make.verdict()), as_recorded=foreign)
    assert held.outcome is VerifyOutcome.HOLDS_AS_RECORDED
    assert held.summary.startswith(
        'Judged under version 0.0.9 with what is another here: limits.clearance_min_m 0.1'
    )
    assert 'and 2 more; 2 of its conditions' in held.summary
    failed = make.verdict(make.result(margin=-1.0))
    bad = verify_report('b', make.judged(failed), as_recorded=foreign)
    assert bad.outcome is VerifyOutcome.VIOLATED_AS_RECORDED
    run = of_run(Status.VERIFIED, altered('of another run'))
    doubtful = verify_report('b', make.judged(make.verdict()), run=run, as_recorded=foreign)
    assert doubtful.outcome is VerifyOutcome.INCONCLUSIVE
