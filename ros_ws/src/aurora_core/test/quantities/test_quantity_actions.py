# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Speeds that actions end with: a stated bound is one, for who drives and for who judges."""

from __future__ import annotations

import pytest

from aurora_core.knowledge.limits import Tolerances
from aurora_core.quantities.actions import action_rules, commanded_mps, is_complete
from aurora_core.spec.parameter import Bound
from aurora_core.spec.scenario import AgentAction


def _action(do: str, value_mps: float, bound: Bound) -> AgentAction:
    stated = {
        'value': value_mps, 'unit': 'm/s', 'low': 0.0, 'high': 50.0, 'provenance': 'explicit',
        'span': {'start': 0, 'end': 1}, 'bound': bound.value,
    }  # fmt: skip
    return AgentAction.model_validate({'do': do, 'agent': 'car1', 'value_mps': stated})


@pytest.mark.parametrize(
    ('do', 'bound', 'before_mps', 'reached', 'not_reached'),
    [
        ('slow', Bound.AT_MOST, 10.0, 4.1, 4.9),
        ('accelerate', Bound.AT_LEAST, 1.0, 4.3, 3.4),
        ('slow', Bound.EXACTLY, 10.0, 4.9, 5.4),
    ],
)
def test_who_slows_to_below_a_speed_gets_below_it(
    tolerances: Tolerances,
    do: str,
    bound: Bound,
    before_mps: float,
    reached: float,
    not_reached: float,
) -> None:
    rules, action = action_rules(tolerances), _action(do, 4.2, bound)
    assert is_complete(action, before_mps, reached, rules)
    assert not is_complete(action, before_mps, not_reached, rules)
    commanded = commanded_mps(action, before_mps, rules)
    assert commanded is not None
    assert is_complete(action, before_mps, commanded, rules)
    assert (commanded == 4.2) is (bound is Bound.EXACTLY)


def test_who_is_told_to_go_below_next_to_nothing_stands(tolerances: Tolerances) -> None:
    rules = action_rules(tolerances)
    assert commanded_mps(_action('slow', 0.2, Bound.AT_MOST), 10.0, rules) == 0.0
