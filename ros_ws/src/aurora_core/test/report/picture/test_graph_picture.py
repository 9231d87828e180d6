# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of the graph says everything once, covers nothing, and is the same every time."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

from aurora_core.agsg.build import build_agsg
from aurora_core.conditions.derive import derive_conditions
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.agsg import Agsg, Stage
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.report.picture.draw import png_bytes, svg_bytes
from aurora_core.report.picture.graph_picture import draw_graph
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.schedule import plan_time

NAMES = ['survey', 'motorcycle', 'convoy', 'tailgate']


@pytest.fixture(scope='session')
def grounded(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    limits: Limits,
    tolerances: Tolerances,
) -> Callable[[str], Agsg]:
    """Build the grounded graph of a prompt, once."""

    @cache
    def build(name: str) -> Agsg:
        spec = read_prompt(name)
        placed = ground(spec)
        facts = plan_time(spec, placed, limits, tolerances).facts
        conditions = derive_conditions(spec, facts, limits, tolerances).conditions
        return build_agsg(
            spec,
            stage=Stage.GROUNDED,
            grounding=placed,
            conditions=conditions,
        )

    return build


def _texts(figure: Figure) -> list[Text]:
    return [text for text in figure.axes[0].texts if text.get_text().strip()]


@pytest.mark.parametrize('name', NAMES)
def test_no_words_lie_over_other_words_or_beyond_the_paper(
    name: str, grounded: Callable[[str], Agsg]
) -> None:
    figure = draw_graph(grounded(name))
    canvas: Any = FigureCanvasAgg(figure)  # matplotlib's own methods have no types
    canvas.draw()
    paper, pen = figure.bbox, canvas.get_renderer()
    words = [text.get_text() for text in _texts(figure)]
    rooms = np.array([text.get_window_extent(pen).extents for text in _texts(figure)])
    left, low, right, high = rooms.T
    assert left.min() >= paper.x0, words[left.argmin()]
    assert right.max() <= paper.x1, words[right.argmax()]
    assert low.min() >= paper.y0, words[low.argmin()]
    # Each with each other one: how wide and high the room is that they share.
    wide = np.minimum.outer(right, right) - np.maximum.outer(left, left)
    tall = np.minimum.outer(high, high) - np.maximum.outer(low, low)
    # Half a line: the boxes of letters reach above and below what is black.
    least = 0.5 * np.minimum.outer(high - low, high - low)
    over = np.argwhere(np.triu((wide >= 1.0) & (tall >= least), 1))
    assert [(words[a], words[b]) for a, b in over] == []


def test_every_node_edge_and_number_is_there(grounded: Callable[[str], Agsg]) -> None:
    agsg = grounded('tailgate')
    written = [text.get_text() for text in _texts(draw_graph(agsg))]
    for node in agsg.nodes:
        assert node.id in written
    for word in ('behind', 'tailgate', 'track', 'distance below', 'sends over', 'delivers to'):
        assert word in written, word
    assert written.count('45 m') == 2
    assert written.count('●') == 1 + sum(p.provenance == 'explicit' for p in agsg.parameters)


def test_a_value_that_grounding_moved_shows_both(grounded: Callable[[str], Agsg]) -> None:
    agsg = grounded('convoy')
    rows = tuple(
        row if row.realised is None else row.model_copy(update={'realised': row.requested + 1.5})
        for row in agsg.parameters
    )
    moved = agsg.model_copy(update={'parameters': rows})
    assert '35 m → 36.5 m' in [text.get_text() for text in _texts(draw_graph(moved))]


def test_the_same_bytes_every_time(grounded: Callable[[str], Agsg]) -> None:
    agsg = grounded('survey')
    for writer in (png_bytes, svg_bytes):
        assert writer(draw_graph(agsg)) == writer(draw_graph(agsg))


def test_a_graph_with_nothing_in_it_can_be_drawn() -> None:
    figure = draw_graph(build_agsg(ScenarioSpec(prompt='x \n\t y' + ' word' * 200)))
    written = ' '.join(text.get_text() for text in _texts(figure))
    assert 'world' in written
    assert '…' in written
    assert 'success conditions' not in written
