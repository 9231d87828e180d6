# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every way in which a run can miss has its own cause, and the words that many share."""

from __future__ import annotations

from typing import Any

import pytest

from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.rulers.causes import cause_of
from aurora_bench.rulers.runs import refusal_cause
from aurora_bench.rulers.trial import Cause
from aurora_core.outcomes.grounding import GroundingFailure, GroundingOutcome, Unjudged
from aurora_core.report.run_report import RunReport

Doc = dict[str, Any]
REFUSED: Doc = {
    'result': 'infeasible',
    'certificates': [
        {'kind': 'limit', 'reason': 'altitude_limit', 'path': 'missions/m1', 'sentence': 'No.'}
    ],
}  # fmt: skip


def row(ident: str, *, implied: bool = True) -> Doc:
    """Return a condition that does not hold."""
    return {
        'id': ident, 'sentence': 'It does.', 'formula': 'x >= 0', 'implied': implied,
        'provenance': 'default', 'op': '>=', 'threshold': 0.0, 'unit': 'm', 'satisfied': False,
        'exercised': True, 'margin': -1.0,
    }  # fmt: skip


def report(status: str, **changes: Any) -> RunReport:
    """Return the report of a run that ended so."""
    return RunReport.model_validate(
        {
            'run_id': '20260101T000000Z-000001', 'status': status, 'summary': '', 'prompt': 'any',
            'engine': 'local', 'model': 'offline', 'map': 'downtown', 'seed': 1,
            'digests': {'prompt': 'ab'}, **changes,
        }
    )  # fmt: skip


NOWHERE = GroundingOutcome(
    failure=GroundingFailure(reason='clearance', tried=9, rejected_by={'clearance': 9})
)
MISSING = GroundingOutcome(unsupported=('car1: behaviour turn_left', 'van1: behaviour turn_left'))
UNJUDGED = GroundingOutcome(
    unjudged=(Unjudged(element='m1', path='missions/m1', what='radius_m = 50 m'),)
)
ERROR: Doc = {'error': {'code': 4, 'component': 'sumo', 'message': 'no route\nat edge 7'}}
FAILED: Doc = {
    'conditions': [
        row('m1.tracked'), row('m2.tracked'), row('car1.placed2'), row('safety.clearance.uav1'),
        row('c1.altitude', implied=False),
    ]
}  # fmt: skip
UNREAD: Doc = {
    'clauses': [{'text': 'any', 'span': {'start': 0, 'end': 3}, 'status': 'not_encoded'}]
}


@pytest.mark.parametrize(
    ('status', 'fields', 'grounding', 'cause', 'words'),
    [
        ('error', ERROR, None, Cause.ERROR, ('sumo: no route',)),
        ('not_understood', {}, None, Cause.READING, ('question',)),
        (
            'infeasible',
            {'feasibility': REFUSED},
            None,
            Cause.GROUNDING,
            ('refused: altitude_limit',),
        ),
        ('inconclusive', {}, NOWHERE, Cause.GROUNDING, ('clearance',)),
        ('incomplete', UNREAD, MISSING, Cause.CAPABILITY, ('behaviour turn_left',)),
        ('incomplete', UNREAD, UNJUDGED, Cause.CAPABILITY, ('not judged: radius_m',)),
        # What is missing comes before what failed because of it.
        ('violated', FAILED, MISSING, Cause.CAPABILITY, ('behaviour turn_left',)),
        (
            'violated',
            FAILED,
            GroundingOutcome(),
            Cause.CONDITION,
            ('tracked', 'placed', 'safety clearance', 'stated condition'),
        ),
        ('incomplete', UNREAD, GroundingOutcome(), Cause.READING, ('clause not encoded',)),
    ],
)
def test_a_run_has_the_cause_that_applies_first(
    status: str, fields: Doc, grounding: GroundingOutcome | None, cause: Cause, words: Any
) -> None:
    assert cause_of(report(status, **fields), grounding) == (cause, words)


@pytest.mark.parametrize(
    ('wanted', 'status', 'fields', 'cause'),
    [
        (['altitude_limit'], 'infeasible', {'feasibility': REFUSED}, None),
        (['speed_limit', 'altitude_limit'], 'infeasible', {'feasibility': REFUSED}, None),
        (['speed_limit'], 'infeasible', {'feasibility': REFUSED}, Cause.OTHER_REASON),
        (['altitude_limit'], 'verified', {}, Cause.ACCEPTED),
        (['altitude_limit'], 'violated', {}, Cause.NOT_REFUSED),
        (['altitude_limit'], 'not_understood', {}, Cause.NOT_REFUSED),
        (['altitude_limit'], 'error', ERROR, Cause.ERROR),
    ],
)
def test_a_refusal_needs_an_annotated_reason(
    wanted: list[str], status: str, fields: Doc, cause: Cause | None
) -> None:
    readings = [{'id': f'r{k}', 'kind': 'reject', 'because': b} for k, b in enumerate(wanted, 2)]
    asked: Doc = readings[0] if len(readings) == 1 else {
        'id': 'r1', 'kind': 'any_of', 'any_of': readings,
    }  # fmt: skip
    prompt = AnnotatedPrompt.model_validate(
        {
            'id': 'infeasible-901', 'category': 'infeasible', 'prompt': 'any',
            'feasibility': 'infeasible', 'paraphrase_group': None, 'end_to_end': False,
            'requirements': [asked],
        }
    )  # fmt: skip
    found = refusal_cause(prompt, report(status, **fields))
    assert (found[0] if found is not None else None) == cause
