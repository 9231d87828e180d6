# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How vehicles drive that keep a stated time headway."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import pytest

from aurora_core.grounding.headways import headway_style, stated_headway
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Make = Callable[..., Parameter]


@pytest.mark.parametrize(
    ('own', 'other', 'asked_s', 'bound', 'aims_s'),
    [
        ('car', 'van', 1.5, Bound.EXACTLY, 1.5),
        ('truck', 'car', 2.0, Bound.EXACTLY, 2.0),  # which needs longer to brake
        ('truck', 'bus', 2.0, Bound.AT_LEAST, 2.5),
        ('car', 'car', 1.0, Bound.AT_MOST, 0.7),
    ],
)
def test_gap_and_time_gap_together_are_the_headway(
    own: str,
    other: str,
    asked_s: float,
    bound: Bound,
    aims_s: float,
    parameter: Make,
    agent_types: Mapping[str, AgentTypeRecord],
) -> None:
    asked = parameter(asked_s, 's', bound=bound)
    one, ahead = agent_types[own], agent_types[other]
    style = headway_style(asked, one, ahead, 10.0)
    # The simulator keeps free what the one behind needs longer to brake, too.
    longer_m = 50.0 * (1.0 / one.decel_mps2 - 1.0 / max(one.decel_mps2, ahead.decel_mps2))
    gap_m = style['min_gap_m'] + 10.0 * style['time_gap_s'] + longer_m
    assert gap_m / 10.0 == pytest.approx(aims_s)


def test_nobody_follows_in_no_time(
    parameter: Make, agent_types: Mapping[str, AgentTypeRecord]
) -> None:
    style = headway_style(parameter(0.1, 's'), agent_types['car'], agent_types['car'], 5.0)
    assert style['time_gap_s'] == 0.05


def test_a_following_and_a_condition_state_it(read_prompt: Read, parameter: Make) -> None:
    spec = read_prompt('A car follows a van with a 1.5 s gap.')
    found = stated_headway(spec, spec.agents[0])
    assert found is not None
    assert (found[0], found[1].value) == ('van1', 1.5)
    assert stated_headway(spec, spec.agents[1]) is None
