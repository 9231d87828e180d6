# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Text

from aurora_core.report.build import build_report
from aurora_core.report.picture.paper import (
    WIDTHS_IN,
    draw_paper,
    looks_of,
    moment_lines,
    numbers,
    paper_bytes,
    piles,
    way_widths,
)
from aurora_core.report.scene.caption import Caption
from aurora_core.report.scene.tracks import Box, tracks_of


def _caption(make: SimpleNamespace) -> Caption:
    return Caption.of_report(build_report(make.facts()))


def _draw(make: SimpleNamespace, columns: int = 1) -> Figure:
    return draw_paper(
        make.trace(), make.world(), _caption(make), spec=make.spec(), columns=columns
    )


def _texts(figure: Figure) -> list[str]:
    found = figure.findobj(Text)
    return [item.get_text() for item in found if isinstance(item, Text)]


@pytest.mark.parametrize('suffix', ['.pdf', '.svg'])
def test_the_same_run_gives_the_same_bytes(make: SimpleNamespace, suffix: str) -> None:
    first = paper_bytes(_draw(make), suffix)
    assert first == paper_bytes(_draw(make), suffix)
    assert b'CreationDate' not in first
    assert b'<dc:date>' not in first
    # A vector: no pixels inside.
    assert b'/Subtype /Image' not in first
    assert b'<image' not in first


@pytest.mark.parametrize('columns', [1, 2])
def test_it_is_as_wide_as_the_columns_and_has_no_title(
    make: SimpleNamespace, columns: int
) -> None:
    figure = _draw(make, columns)
    assert figure.get_size_inches()[0] == pytest.approx(WIDTHS_IN[columns])
    text = '\n'.join(_texts(figure))
    assert make.prompt not in text
    assert 'VERIFIED' not in text
    for word in ('altitude [m]', 'simulated time [s]', 'uav1', 'motorcycle1', 'N'):
        assert word in text


def test_every_body_has_a_look_of_its_own(make: SimpleNamespace) -> None:
    looks = looks_of(tracks_of(make.trace()))
    assert len(set(looks.values())) == len(looks)
    ours = {colour for colour, _ in looks.values()}
    lines = [line for line in _draw(make).findobj(Line2D) if isinstance(line, Line2D)]
    drawn = {to_hex(line.get_color()) for line in lines if np.size(line.get_xdata()) > 100}
    assert ours <= drawn


def test_the_numbers_are_those_of_the_lines(make: SimpleNamespace) -> None:
    lines = moment_lines(make.trace(), make.world(), _caption(make), make.spec())
    last = lines[-1].split()[0]
    shown = [n for text in _texts(_draw(make)) for n in text.replace('–', ',').split(',')]
    assert last in shown
    assert '1' in shown
    assert any('uav1' in line for line in lines)


def test_nobody_is_hidden_under_who_goes_the_same_way(make: SimpleNamespace) -> None:
    trace = make.trace()
    uav = next(track for track in tracks_of(trace) if track.is_uav)
    below = replace(uav, entry=replace(uav.entry, body_id='below'), is_uav=False)
    aside = replace(below, entry=replace(uav.entry, body_id='aside'))
    aside = replace(aside, position_m=aside.position_m + np.array([0.0, 500.0, 0.0]))
    widths = way_widths([aside, below, uav], 2.0)
    assert widths['below'] > widths[uav.name] + 0.5
    assert widths['aside'] == widths[uav.name]


def test_it_shows_what_happens_and_no_empty_end(make: SimpleNamespace) -> None:
    trace = make.trace()
    still = [np.repeat(part[-1:], 4000, axis=0) for part in (trace.uav, trace.uav_commands)]
    ground = np.concatenate([trace.ground, np.repeat(trace.ground[-1:], 4000, axis=0)])
    commands = np.repeat(trace.ground_commands[-1:], 4000, axis=0)
    long = replace(
        trace,
        ground=ground,
        ground_commands=np.concatenate([trace.ground_commands, commands]),
        uav=np.concatenate([trace.uav, still[0]]),
        uav_commands=np.concatenate([trace.uav_commands, still[1]]),
    )
    figure = draw_paper(long, make.world(), _caption(make), spec=make.spec())
    strip = figure.axes[1]
    assert strip.get_xlim()[1] == pytest.approx(trace.ticks * trace.roster.dt_s, rel=0.1)


def test_the_map_reaches_to_what_happens_beside_the_flights() -> None:
    box = Box(west=0.0, south=0.0, east=100.0, north=100.0)
    wider = box.with_places([(150.0, 50.0), (900.0, 50.0)], 2.5)
    assert wider.holds(150.0, 50.0)
    assert not wider.holds(900.0, 50.0)
    assert (wider.west, wider.south, wider.north) == (0.0, 0.0, 100.0)


def test_markers_do_not_pile_up() -> None:
    near = [(0.0, 0.0), (5.0, 5.0), (100.0, 0.0), (3.0, -4.0), (100.0, 30.0)]
    assert piles(near, 10.0) == [[0, 1, 3], [2], [4]]
    assert piles([], 10.0) == []


@pytest.mark.parametrize(
    ('members', 'text'),
    [([4], '4'), ([1, 2], '1,2'), ([1, 2, 3, 5], '1–3,5'), ([2, 9, 10, 11], '2,9–11')],
)
def test_numbers_are_short(members: list[int], text: str) -> None:
    assert numbers(members) == text
