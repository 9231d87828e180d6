# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph as text that other tools read: JSON, GraphML, DOT, Mermaid.

JSON is the document of a run folder (`agsg.<k>.json`, schema in `config/schema`). GraphML holds
the whole specification too and can be read back. DOT and Mermaid are for people: nodes, edges and
the values of the parameters.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from types import MappingProxyType

import networkx as nx

from aurora_core.agsg.network import network, spec_of
from aurora_core.errors import SpecError
from aurora_core.outcomes.agsg import Agsg, AgsgNode, AgsgParameter, EdgeType, NodeType
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import ScenarioSpec

# Colour-blind safe (Okabe and Ito): fill of a node type, line of an edge family. The picture
# uses the same.
NODE_COLOURS: Mapping[NodeType, str] = MappingProxyType(
    {
        NodeType.ENVIRONMENT: '#e8e4d8',
        NodeType.GROUND_AGENT: '#cfe3f3',
        NodeType.UAV: '#d3ece2',
        NodeType.COMMUNICATION: '#fbe3cc',
        NodeType.EVENT: '#efd9ea',
        NodeType.CONDITION: '#f6f0c4',
    }
)
EDGE_COLOURS: Mapping[EdgeType, str] = MappingProxyType(
    {
        EdgeType.SPATIAL: '#0072b2',
        EdgeType.TEMPORAL: '#a3337f',
        EdgeType.PERCEPTUAL: '#00805f',
        EdgeType.COMMUNICATION: '#d55e00',
        EdgeType.BEHAVIORAL: '#3a4350',
    }
)
_DOT_SHAPES = {
    NodeType.ENVIRONMENT: 'box',
    NodeType.GROUND_AGENT: 'box',
    NodeType.UAV: 'hexagon',
    NodeType.COMMUNICATION: 'parallelogram',
    NodeType.EVENT: 'octagon',
    NodeType.CONDITION: 'ellipse',
}
_DOT_STYLES = {
    EdgeType.SPATIAL: 'solid',
    EdgeType.TEMPORAL: 'dashed',
    EdgeType.PERCEPTUAL: 'dotted',
    EdgeType.COMMUNICATION: 'bold',
    EdgeType.BEHAVIORAL: 'solid',
}
# Opening and closing of a node.
_MERMAID_SHAPES = {
    NodeType.ENVIRONMENT: ('[', ']'),
    NodeType.GROUND_AGENT: ('(', ')'),
    NodeType.UAV: ('{{', '}}'),
    NodeType.COMMUNICATION: ('[/', '/]'),
    NodeType.EVENT: ('>', ']'),
    NodeType.CONDITION: ('([', '])'),
}
_MERMAID_ARROWS = {
    EdgeType.SPATIAL: '-->',
    EdgeType.TEMPORAL: '-.->',
    EdgeType.PERCEPTUAL: '-.->',
    EdgeType.COMMUNICATION: '==>',
    EdgeType.BEHAVIORAL: '-->',
}
_INDEX = re.compile(r'\d+')
_SIZES = {'0': 'length', '1': 'width'}
_UNIT_ENDS = ('_mps', '_deg', '_m', '_s')


def json_text(agsg: Agsg) -> str:
    """Return the graph's own document, as run folders hold it."""
    return json.dumps(agsg.model_dump(mode='json'), indent=2, ensure_ascii=False) + '\n'


def graphml_text(agsg: Agsg) -> str:
    """Return the graph as GraphML, with elements and parameters as attributes of the nodes."""
    graph = network(agsg)
    for _, attributes in graph.nodes(data=True):
        attributes['label'] = _plain(attributes['label'])
    return '\n'.join(nx.generate_graphml(graph)) + '\n'


def spec_from_graphml(text: str) -> ScenarioSpec:
    """Return the specification that a GraphML text holds.

    Raises:
        SpecError: The text is not GraphML, or holds no specification.
    """
    try:
        graph = nx.parse_graphml(text, force_multigraph=True)
    except Exception as err:
        raise SpecError(f'the text is not GraphML: {err}', hint='export the graph again') from err
    return spec_of(graph)


def dot_text(agsg: Agsg) -> str:
    """Return the graph in the language of Graphviz."""
    lines = ['digraph agsg {', '  rankdir=LR;', '  node [style=filled, fontname="Helvetica"];']
    rows = _rows(agsg)
    for node in agsg.nodes:
        text = r'\n'.join(_dot_escaped(line) for line in _node_lines(node, rows))
        lines.append(
            f'  "{_dot_escaped(node.id)}" [shape={_DOT_SHAPES[node.type]}, '
            f'fillcolor="{NODE_COLOURS[node.type]}", label="{text}"];'
        )
    for edge in agsg.edges:
        lines.append(
            f'  "{_dot_escaped(edge.source)}" -> "{_dot_escaped(edge.target)}" '
            f'[style={_DOT_STYLES[edge.type]}, color="{EDGE_COLOURS[edge.type]}", '
            f'label="{_dot_escaped(edge.label)}"];'
        )
    return '\n'.join([*lines, '}']) + '\n'


def mermaid_text(agsg: Agsg) -> str:
    """Return the graph as a Mermaid flow chart, which GitHub draws inside Markdown."""
    lines = ['flowchart LR']
    rows = _rows(agsg)
    # Ids of conditions have dots, which Mermaid takes for syntax.
    names = {node.id: f'n{index}' for index, node in enumerate(agsg.nodes)}
    for node in agsg.nodes:
        opening, closing = _MERMAID_SHAPES[node.type]
        text = '<br/>'.join(_mermaid_escaped(line) for line in _node_lines(node, rows))
        lines.append(f'  {names[node.id]}{opening}"{text}"{closing}:::{node.type.value}')
    for index, edge in enumerate(agsg.edges):
        label = _mermaid_escaped(edge.label)
        arrow = _MERMAID_ARROWS[edge.type]
        lines.append(f'  {names[edge.source]} {arrow}|"{label}"| {names[edge.target]}')
        lines.append(f'  linkStyle {index} stroke:{EDGE_COLOURS[edge.type]}')
    for kind, colour in NODE_COLOURS.items():
        lines.append(f'  classDef {kind.value} fill:{colour},stroke:#66707d,color:#1c2430')
    return '\n'.join(lines) + '\n'


# By the end of a file's name, without the dot.
TEXT_WRITERS: Mapping[str, Callable[[Agsg], str]] = MappingProxyType(
    {'json': json_text, 'graphml': graphml_text, 'dot': dot_text, 'mmd': mermaid_text}
)


def parameter_name(path: str) -> str:
    """Return what a parameter is called in its node: `altitude`, `trigger value`, `length`."""
    parts = path.split('/')
    if parts[-2] == 'size_m':
        return _SIZES[parts[-1]]
    words = [part for part in parts[2 if len(parts) > 2 else 1 :] if not _INDEX.fullmatch(part)]
    kept = [word for word in words if word not in ('placements', 'behaviors')]
    name = kept[-1]
    name = next((name.removesuffix(end) for end in _UNIT_ENDS if name.endswith(end)), name)
    return ' '.join([*kept[:-1], name]).replace('_', ' ')


def value_text(value: float, unit: Unit) -> str:
    """Return a number with its unit as people write it."""
    shown = f'{round(value, 3):g}'
    return shown if unit is Unit.ONE else f'{shown} {unit.value}'


def _rows(agsg: Agsg) -> dict[str, list[AgsgParameter]]:
    rows: dict[str, list[AgsgParameter]] = {}
    for row in agsg.parameters:
        rows.setdefault(row.owner, []).append(row)
    return rows


def _node_lines(node: AgsgNode, rows: Mapping[str, list[AgsgParameter]]) -> list[str]:
    """Return id, label and one line per parameter: value, provenance."""
    lines = [node.id, node.label]
    for row in rows.get(node.id, []):
        value = value_text(row.requested, row.unit)
        lines.append(f'{parameter_name(row.path)} {value} ({row.provenance.value})')
    return [_plain(line) for line in lines]


def _plain(text: str) -> str:
    """Return a text without control characters, for which these formats have no place."""
    return ''.join(c if c.isprintable() else ' ' for c in text)


def _dot_escaped(text: str) -> str:
    return text.replace('\\', r'\\').replace('"', r'\"')


def _mermaid_escaped(text: str) -> str:
    escaped = text.replace('#', '#35;').replace('&', '#amp;').replace('"', '#quot;')
    return escaped.replace('<', '#lt;').replace('>', '#gt;')
