# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is proposed for open clauses is understood itself, and fits the clause."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.report.run_report import ClauseReport
from aurora_core.report.wordings import sayings, wordings
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import ClauseStatus

CONTEXT = ParseContext(landmark_names=('City Hall', 'Mercy Hospital'))


def _clause(text: str, status: ClauseStatus, note: str = '') -> ClauseReport:
    return ClauseReport(text=text, span=Span(start=0, end=len(text)), status=status, note=note)


@pytest.mark.parametrize('say', sayings())
def test_a_proposed_request_is_read_as_a_whole(say: str) -> None:
    outcome = parse_offline(say, CONTEXT)
    assert outcome.question is None
    assert outcome.refusals == ()
    assert {c.status for c in outcome.clauses} == {ClauseStatus.ENCODED}


def test_a_clause_gets_the_row_of_its_words() -> None:
    clauses = [
        _clause('then RTL', ClauseStatus.NOT_ENCODED),
        _clause('tilt the gimbal down', ClauseStatus.NOT_ENCODED),
        _clause('RTL again', ClauseStatus.NOT_ENCODED),
    ]
    found = wordings(clauses)
    assert [one.text for one in found] == ['then RTL', 'tilt the gimbal down']
    assert 'returns home' in found[0].say
    assert found[1].say == ''


@pytest.mark.parametrize('text', ['takes a photo of a bus', 'shoots pictures', 'one snapshot'])
def test_who_asks_for_a_photo_learns_what_to_say(text: str) -> None:
    (found,) = wordings([_clause(text, ClauseStatus.NOT_ENCODED)])
    assert 'films' in found.say


def test_a_row_about_a_note_looks_at_the_note() -> None:
    text = 'follows a cyclist at 5 m/s'
    noted = _clause(text, ClauseStatus.NOT_JUDGED, 'no condition depends on speed_mps = 5 m/s')
    assert 'speed of a target' in wordings([noted])[0].so
    assert wordings([_clause(text, ClauseStatus.NOT_JUDGED)]) == ()


def test_what_was_read_needs_no_other_words() -> None:
    assert wordings([_clause('then RTL', ClauseStatus.ENCODED)]) == ()
