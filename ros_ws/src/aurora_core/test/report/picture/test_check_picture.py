# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of a grounding names what the request is about, and hides none of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import pytest
from matplotlib.figure import Figure

from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.report.picture import check_picture
from aurora_core.report.picture.check_picture import _between, draw_check
from aurora_core.report.scene.tracks import Box
from aurora_core.spec.scenario import ScenarioSpec

_TWICE = (
    'A drone hovers over Meadow Park at 50 m for 30 seconds, then it hovers over Ridge School at '
    '60 m for 20 seconds. Please draw all of this so that everybody can see where it is going to '
    'be, from the beginning to the end, with the names of the places.'
)

_Ground = Callable[[ScenarioSpec], GroundedScenario | GroundingFailure]


def _drawn(
    prompt: str, read: Callable[..., ScenarioSpec], ground: _Ground, model: MapModel
) -> tuple[Figure, list[str]]:
    spec = read(prompt)
    grounded = ground(spec)
    assert isinstance(grounded, GroundedScenario)
    figure = draw_check(spec, grounded, model)
    texts = [*figure.texts, *figure.axes[0].texts]
    return figure, [text.get_text() for text in texts]


def test_each_mission_has_its_height_and_each_place_its_name_once(
    read_prompt: Callable[..., ScenarioSpec],
    ground: _Ground,
    map_of: Callable[[str], MapModel],
) -> None:
    _, texts = _drawn(_TWICE, read_prompt, ground, map_of('downtown'))
    assert {'uav1 50 m', 'uav1 60 m'} <= set(texts)
    assert [t for t in texts if 'Meadow Park' in t and 'drone' not in t] == ['Meadow Park']
    assert len([t for t in texts if t.startswith('Ridge School')]) == 1
    [heading] = [t for t in texts if 'drone' in t]
    assert heading.count('\n') == 1
    assert heading.endswith('…”')


def test_uavs_above_each_other_are_named_above_each_other(
    read_prompt: Callable[..., ScenarioSpec],
    ground: _Ground,
    map_of: Callable[[str], MapModel],
) -> None:
    asked = 'Two drones follow the ego car, one at 30 m and one at 50 m altitude.'
    figure, _ = _drawn(asked, read_prompt, ground, map_of('downtown'))
    figure.canvas.draw()
    names = [t for t in figure.axes[0].texts if t.get_text().startswith('uav')]
    assert {t.get_text() for t in names} == {'uav1 30 m', 'uav2 50 m'}
    one, other = (t.get_window_extent() for t in names)
    assert not one.overlaps(other)


def test_names_of_streets_keep_clear_of_long_straight_ways() -> None:
    points = list(_between([(0.0, 0.0), (0.0, 100.0), (30.0, 100.0)]))
    gaps = [abs(a[0] - b[0]) + abs(a[1] - b[1]) for a, b in pairwise(points)]
    assert max(gaps) <= 2.0
    assert points[0] == (0.0, 0.0)
    assert points[-1] == (30.0, 100.0)


@dataclass(frozen=True)
class _Anchor:
    x_m: float
    y_m: float
    joint: float | None


@pytest.mark.parametrize(('more_m', 'axes'), [(-20.0, 3), (0.0, 2)])
def test_a_picture_of_the_whole_map_has_no_smaller_one_of_it(
    more_m: float,
    axes: int,
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario | GroundingFailure],
    map_of: Callable[[str], MapModel],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    spec, model = read_prompt('A drone tracks a bus at 40 m.', 'junction'), map_of('junction')
    grounded = ground(spec, 'junction')
    assert isinstance(grounded, GroundedScenario)
    west, south, east, north = model.bounds_m
    shown = Box(west=west, south=south, east=east + more_m, north=north)
    monkeypatch.setattr(check_picture, '_box', lambda *_: shown)
    figure = draw_check(spec, grounded, model, [_Anchor(0.0, 0.0, 0.5)])
    assert len(figure.axes) == axes  # the map, the scores, and where it lies
