# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.text import Text

from aurora_core.knowledge.map_model import load_map
from aurora_core.report.build import build_report
from aurora_core.report.picture.draw import draw_picture, png_bytes, svg_bytes
from aurora_core.report.picture.map_picture import draw_map, ground_of_map
from aurora_core.report.scene.caption import Caption
from aurora_core.trace.layout import GroundColumn


def _texts(figure: Figure) -> str:
    found = figure.findobj(Text)
    return '\n'.join(item.get_text() for item in found if isinstance(item, Text))


def _draw(make: SimpleNamespace) -> Figure:
    caption = Caption.of_report(build_report(make.facts()))
    return draw_picture(make.trace(), make.world(), caption, spec=make.spec())


def test_the_same_run_gives_the_same_bytes(make: SimpleNamespace) -> None:
    assert png_bytes(_draw(make)) == png_bytes(_draw(make))
    assert svg_bytes(_draw(make)) == svg_bytes(_draw(make))


def test_no_date_and_no_version_is_in_the_file(make: SimpleNamespace) -> None:
    png = png_bytes(_draw(make))
    for chunk in (b'tEXt', b'iTXt', b'tIME', b'zTXt'):
        assert chunk not in png
    svg = svg_bytes(_draw(make))
    assert b'<dc:date>' not in svg
    assert b'Matplotlib v' not in svg


def test_a_newcomer_finds_who_what_when_and_the_verdict(make: SimpleNamespace) -> None:
    text = _texts(_draw(make))
    for word in (
        'VERIFIED',
        make.prompt,
        '1 of 1 conditions hold',
        'motorcycle1',
        'uav1 take-off',
        'uav1 landing',
        ['uav1', 'tracks motorcycle1'][1],
        'What happened',
        'Tightest margins',
        'simulated time [s]',
        'NO FLY',
        '70 m',
        'Assembly Street',
        'N',
    ):
        assert word in text, word


def test_the_picture_is_not_empty(make: SimpleNamespace) -> None:
    pixels = imread(io.BytesIO(png_bytes(_draw(make), dpi=50)))
    assert pixels.shape[:2] == (480, 700)
    assert len(np.unique(pixels.reshape(-1, pixels.shape[-1]), axis=0)) > 200


def test_a_run_with_gaps_and_a_vanished_agent_can_be_drawn(make: SimpleNamespace) -> None:
    trace = make.trace()
    uav, ground = trace.uav.copy(), trace.ground.copy()
    uav[50:60] = np.nan
    ground[300:, :, GroundColumn.PRESENT] = 0.0
    figure = draw_picture(
        replace(trace, uav=uav, ground=ground), make.world(), Caption(prompt=make.prompt)
    )
    assert png_bytes(figure, dpi=40).startswith(b'\x89PNG')
    assert 'VERIFIED' not in _texts(figure)


@pytest.mark.parametrize('ticks', [1, 2, 40])
def test_a_run_that_broke_off_at_once_can_be_drawn(make: SimpleNamespace, ticks: int) -> None:
    figure = draw_picture(make.trace(ticks), make.world(), Caption(prompt='x' * 4000))
    assert png_bytes(figure, dpi=40).startswith(b'\x89PNG')


def test_a_run_without_uavs_shows_speeds(make: SimpleNamespace) -> None:
    trace = make.trace()
    grounded = replace(
        trace,
        roster=replace(trace.roster, uavs=()),
        uav=trace.uav[:, :0],
        uav_commands=trace.uav_commands[:, :0],
        events=(),
    )
    figure = draw_picture(grounded, make.world(), Caption(prompt=make.prompt))
    assert 'speed' in _texts(figure)
    assert png_bytes(figure, dpi=40).startswith(b'\x89PNG')


def test_a_map_can_be_drawn_by_itself() -> None:
    model = load_map('junction')
    figure = draw_map(model)
    assert model.description in _texts(figure)
    assert png_bytes(figure, dpi=40).startswith(b'\x89PNG')
    assert {s.kind.name for s in ground_of_map(model).surfaces} >= {'DRIVING', 'CROSSING'}
