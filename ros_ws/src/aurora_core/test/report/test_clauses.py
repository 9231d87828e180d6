# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from types import SimpleNamespace

from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.report.clauses import clause_reports
from aurora_core.spec.vocabulary import ClauseStatus


def test_only_the_clauses_of_the_element_are_lost(make: SimpleNamespace) -> None:
    grounding = GroundingOutcome(agsg=make.graph(), unsupported=('motorcycle1: overtaking',))
    first, second = clause_reports(make.facts(grounding=grounding))
    assert (first.status, first.note) == (ClauseStatus.NOT_ENCODED, 'overtaking')
    assert second.status is ClauseStatus.ENCODED


def test_several_missing_capabilities_are_all_named_once(make: SimpleNamespace) -> None:
    grounding = GroundingOutcome(agsg=make.graph(), unsupported=('m1: a', 'm1: b', 'm1: a'))
    assert {clause.note for clause in clause_reports(make.facts(grounding=grounding))} == {'a; b'}


def test_an_element_that_no_clause_claims_cannot_get_lost(make: SimpleNamespace) -> None:
    grounding = GroundingOutcome(agsg=make.graph(), unsupported=('link9: a second link', 'odd'))
    added = clause_reports(make.facts(grounding=grounding))[2:]
    assert [(c.ids, c.note, c.text) for c in added] == [
        (('link9',), 'a second link', make.prompt),
        ((), 'odd', make.prompt),
    ]
    assert all(clause.status is ClauseStatus.NOT_ENCODED for clause in added)


def test_without_a_parse_there_are_no_clauses(make: SimpleNamespace) -> None:
    assert clause_reports(make.facts(parse=None, grounding=None)) == ()
