# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Specification, graph, specification: nothing is lost, and nothing is made up."""

from __future__ import annotations

import json
import os
from collections.abc import Callable

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from aurora_core.agsg.build import build_agsg
from aurora_core.agsg.network import network, spec_of
from aurora_core.errors import SpecError
from aurora_core.spec.scenario import ScenarioSpec

# Seconds; set it to 10000 (a quarter of an hour) before a change of the
# specification is published.
ROUND_TRIPS = int(os.environ.get('AURORA_ROUND_TRIPS', '100'))


@settings(
    max_examples=ROUND_TRIPS,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
@given(data=st.data())
@pytest.mark.timeout(3600)
def test_a_specification_comes_back_out_of_its_graph(
    data: st.DataObject, specifications: SearchStrategy[ScenarioSpec]
) -> None:
    spec = data.draw(specifications)
    agsg = build_agsg(spec)
    ids = {node.id for node in agsg.nodes}
    assert len(ids) == len(agsg.nodes)
    assert {p.owner for p in agsg.parameters} <= ids
    assert {end for e in agsg.edges for end in (e.source, e.target)} <= ids
    again = spec_of(network(agsg))
    assert again == spec
    assert again.canonical_json() == spec.canonical_json()
    assert build_agsg(again) == agsg


def test_numbers_stand_with_their_node_only(read_prompt: Callable[..., ScenarioSpec]) -> None:
    graph = network(build_agsg(read_prompt('tailgate')))
    uav = graph.nodes['uav1']
    assert '"theta":"missions/m1/altitude_m"' in uav['elements']
    assert '"value"' not in uav['elements']
    assert json.loads(uav['parameters'])['missions/m1/altitude_m']['value'] == 30.0


@pytest.mark.parametrize('damage', ['node', 'parameters', 'elements', 'prompt', 'value'])
def test_a_network_that_lacks_something_is_refused(
    read_prompt: Callable[..., ScenarioSpec], damage: str
) -> None:
    graph = network(build_agsg(read_prompt('tailgate')))
    uav = graph.nodes['uav1']
    if damage == 'node':
        graph.remove_node('uav1')
    elif damage == 'prompt':
        del graph.graph['prompt']
    elif damage == 'value':
        uav['parameters'] = uav['parameters'].replace('"unit":"m"', '"unit":"s"', 1)
    else:
        uav[damage] = '{}' if damage == 'parameters' else '['
    with pytest.raises(SpecError, match='does not hold a specification'):
        spec_of(graph)
