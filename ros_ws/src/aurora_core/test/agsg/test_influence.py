# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From a condition to the parameters behind it, in order; and back."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.agsg.influence import conditions_affected, parameters_affecting
from aurora_core.errors import SpecError
from aurora_core.outcomes.agsg import Agsg, NodeType
from aurora_core.spec.scenario import ScenarioSpec


def test_a_lost_message_is_traced_to_link_event_sender_and_placement(
    full: Callable[[str], Agsg],
) -> None:
    found = parameters_affecting(full('tailgate'), 'e1.delivered')
    assert [(i.parameter, i.distance, i.provenance.value) for i in found] == [
        # What the condition is about: free ones, then what the prompt states.
        ('links/link1/latency_s', 0, 'default'),
        ('links/link1/loss', 0, 'default'),
        ('links/link1/retransmission_interval_s', 0, 'default'),
        ('links/link1/retransmissions', 0, 'default'),
        ('events/e1/trigger/value_m', 0, 'explicit'),
        # The sender, then who is seen from it.
        ('missions/m1/altitude_m', 1, 'default'),
        ('missions/m1/duration_s', 1, 'default'),
        ('missions/m1/standoff_m', 1, 'default'),
        ('agents/van1/behaviors/0/closing_from_m', 3, 'explicit'),
        ('agents/van1/placements/0/distance_m', 3, 'explicit'),
    ]
    assert found[-1].way == ('van1', 'uav1', 'e1.delivered')
    assert found[0].owner == 'link1'


def test_an_edge_of_the_own_family_is_nearer(full: Callable[[str], Agsg]) -> None:
    """The bus is seen (perceptual); its place before the ego is spatial."""
    agsg = full('convoy')
    near = {i.parameter: i.distance for i in parameters_affecting(agsg, 'm1.visible')}
    far = {i.parameter: i.distance for i in parameters_affecting(agsg, 'm1.completed')}
    place = 'agents/bus1/placements/0/distance_m'
    assert (near[place], far[place]) == (1, 3)
    # The ambulance drives behind: nothing leads from it to what the drone sees.
    assert 'agents/ambulance1/placements/0/distance_m' not in near


@pytest.mark.parametrize('name', ['survey', 'motorcycle', 'convoy', 'tailgate'])
def test_both_directions_say_the_same(name: str, full: Callable[[str], Agsg]) -> None:
    agsg = full(name)
    conditions = [n.id for n in agsg.nodes if n.type is NodeType.CONDITION]
    forth = {i for c in conditions for i in parameters_affecting(agsg, c)}
    back = [conditions_affected(agsg, p.path) for p in agsg.parameters]
    assert forth == {i for found in back for i in found}
    for found in back:
        assert [(i.distance, i.condition) for i in found] == sorted(
            (i.distance, i.condition) for i in found
        )


def test_what_is_not_there_is_refused(
    full: Callable[[str], Agsg], read_prompt: Callable[..., ScenarioSpec]
) -> None:
    with pytest.raises(SpecError, match='no condition') as missing:
        parameters_affecting(full('survey'), 'm9.tracked')
    assert 'm1.waypoints' in missing.value.hint
    with pytest.raises(SpecError, match='ground it first'):
        parameters_affecting(build_agsg(read_prompt('survey')), 'm1.waypoints')
    with pytest.raises(SpecError, match='no parameter'):
        conditions_affected(full('survey'), 'missions/m1/colour')


def test_a_condition_without_causes_has_no_parameters() -> None:
    forbidden = {'id': 'p1', 'forbids': 'world', 'weather': 'rain'}
    spec = ScenarioSpec.model_validate({'prompt': 'x', 'prohibitions': [forbidden]})
    assert parameters_affecting(build_agsg(spec), 'p1') == ()
