# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import ProposalOutcome, ValueEdit, with_values
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.propose import propose
from aurora_core.repair.settings import load_repair_settings

Failing = Callable[..., Verdict]
SETTINGS = load_repair_settings()


def with_link(agsg: Agsg, name: str, value: float) -> Agsg:
    [row] = [r for r in agsg.parameters if r.path.startswith('links/') and r.path.endswith(name)]
    edit = ValueEdit(
        path=row.path, requested=row.requested, realised=value, provenance=row.provenance
    )
    return agsg.model_copy(update={'spec': with_values(agsg.spec, (edit,))})


@pytest.mark.parametrize(('name', 'value'), [('latency_s', 7.0), ('loss', 1.0)])
def test_a_link_that_cannot_do_it_ends_repair_with_the_true_reason(
    agsg: Agsg, failing: Failing, name: str, value: float
) -> None:
    verdict = failing(e1__delivered=None, m1__visible=-0.4)
    found = propose(with_link(agsg, name, value), verdict, (), SETTINGS)
    assert found.outcome is ProposalOutcome.OUT_OF_SCOPE
    assert [item.field.rpartition('/')[2] for item in found.implicated] == [name]
    assert 'is locked' in found.reason


@pytest.mark.parametrize(('name', 'value'), [('latency_s', 0.5), ('loss', 0.9)])
def test_a_link_that_may_do_it_is_no_reason_to_end(
    agsg: Agsg, failing: Failing, name: str, value: float
) -> None:
    verdict = failing(e1__delivered=None, m1__visible=-0.4)
    assert propose(with_link(agsg, name, value), verdict, (), SETTINGS).plan.values


def test_a_slow_link_is_no_matter_while_its_messages_arrive(agsg: Agsg, failing: Failing) -> None:
    verdict = failing(m1__visible=-0.4)
    assert propose(with_link(agsg, 'latency_s', 7.0), verdict, (), SETTINGS).plan.values
