# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph as text: nothing is lost, and nothing in it breaks the language it is written in."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from xml.etree import ElementTree

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from aurora_core.agsg.build import build_agsg
from aurora_core.agsg.document import agsg_from_json
from aurora_core.agsg.export import (
    dot_text,
    graphml_text,
    json_text,
    mermaid_text,
    parameter_name,
    spec_from_graphml,
    value_text,
)
from aurora_core.errors import SpecError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import ScenarioSpec

PROPERTY = settings(
    max_examples=40,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


def test_json_is_the_document_of_a_run_folder(full: Callable[[str], Agsg]) -> None:
    agsg = full('tailgate')
    assert agsg_from_json(json_text(agsg)) == agsg


@PROPERTY
@given(data=st.data())
def test_graphml_gives_any_specification_back(
    data: st.DataObject, specifications: SearchStrategy[ScenarioSpec]
) -> None:
    spec = data.draw(specifications)
    assert spec_from_graphml(graphml_text(build_agsg(spec))) == spec


def test_graphml_has_every_node_and_edge_with_ids_of_their_own(
    full: Callable[[str], Agsg],
) -> None:
    agsg = full('tailgate')
    root = ElementTree.fromstring(graphml_text(agsg))
    space = '{http://graphml.graphdrawing.org/xmlns}'
    assert len(root.findall(f'.//{space}node')) == len(agsg.nodes)
    assert len(root.findall(f'.//{space}edge')) == len(agsg.edges)
    keys = [key.get('id') for key in root.iter(f'{space}key')]
    assert len(keys) == len(set(keys))


@pytest.mark.parametrize('text', ['', '<graphml/>', 'no xml', '{}'])
def test_what_is_no_graphml_is_refused(text: str) -> None:
    with pytest.raises(SpecError):
        spec_from_graphml(text)


def test_dot_has_a_line_for_every_node_and_edge(full: Callable[[str], Agsg]) -> None:
    agsg = full('tailgate')
    lines = dot_text(agsg).splitlines()
    assert sum(' -> ' in line for line in lines) == len(agsg.edges)
    assert sum('[shape=' in line for line in lines) == len(agsg.nodes)
    assert any('"uav1"' in line and 'altitude 30 m (default)' in line for line in lines)
    assert (lines[0], lines[-1]) == ('digraph agsg {', '}')


def test_mermaid_has_a_line_for_every_node_and_edge(full: Callable[[str], Agsg]) -> None:
    agsg = full('tailgate')
    lines = mermaid_text(agsg).splitlines()
    assert sum(':::' in line for line in lines) == len(agsg.nodes)
    assert sum('|' in line for line in lines) == len(agsg.edges)
    assert '  n3{{"uav1<br/>track<br/>' in mermaid_text(agsg)


@PROPERTY
@given(data=st.data())
def test_no_text_of_a_request_ends_a_string_early(
    data: st.DataObject, specifications: SearchStrategy[ScenarioSpec]
) -> None:
    agsg = build_agsg(data.draw(specifications))
    for line in dot_text(agsg).splitlines()[3:-1]:
        bare = re.sub(r'"(\\.|[^"\\])*"', '""', line)
        assert re.fullmatch(r'  ""( -> "")? \[[a-z]+=\w+, [a-z]+="", label=""\];', bare), line
    for line in mermaid_text(agsg).splitlines():
        assert line.count('"') in (0, 2), line


def test_quotes_and_backslashes_in_a_name() -> None:
    spec = ScenarioSpec.model_validate({'prompt': 'x', 'world': {'map_name': 'a"b\\c\n<d>&#'}})
    agsg = build_agsg(spec)
    assert r'label="world\na\"b\\c <d>&#, clear, noon"' in dot_text(agsg)
    assert 'a#quot;b\\c #lt;d#gt;#amp;#35;, clear' in mermaid_text(agsg)


@pytest.mark.parametrize(
    ('path', 'name'),
    [
        ('missions/m1/altitude_m', 'altitude'),
        ('missions/m1/size_m/0', 'length'),
        ('missions/m1/size_m/1', 'width'),
        ('agents/van1/behaviors/0/closing_from_m', 'closing from'),
        ('events/e1/trigger/value_m', 'trigger value'),
        ('links/link1/retransmission_interval_s', 'retransmission interval'),
        ('world/duration_s', 'duration'),
        ('missions/m1/speed_mps', 'speed'),
        ('missions/m1/bearing_deg', 'bearing'),
    ],
)
def test_parameters_have_names_for_people(path: str, name: str) -> None:
    assert parameter_name(path) == name


def test_values_have_units() -> None:
    assert value_text(0.1, Unit.SECOND) == '0.1 s'
    assert value_text(44.99999999999994, Unit.METRE) == '45 m'
    assert value_text(3.0, Unit.ONE) == '3'
    assert json.loads(json_text(build_agsg(ScenarioSpec(prompt='x'))))['stage'] == 'parsed'
