# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sketches are where things are, and figures of single runs are written whole."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from aurora_bench.campaign.gallery import draw_gallery
from aurora_bench.campaign.sketch import (
    Camera,
    area_patch,
    box_ring,
    draw_view,
    faces_of,
    looks_at,
    streets_of,
)
from aurora_bench.plotting import new_figure
from aurora_bench.results import ResultsError
from aurora_bench.rulers.runs import run_into
from aurora_bench.rulers.watched import WatchedStages
from aurora_core.pipeline.stages import RunRequest
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.layout import UavCommandColumn

NORTH = np.array([0.0, 1.0])


def seen(camera: Camera, *point: float) -> tuple[float, float]:
    """Return where a small triangle round a point is in the picture."""
    around = np.array(point) + np.array([[0.01, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.0, 0.01]])
    found = camera.project(around)
    assert found is not None
    x, y = found.mean(axis=0)
    return float(x), float(y)


def colour_at(figure: Figure, ax: Axes, x: float, y: float) -> str:
    """Return the colour of a drawn figure at a point of a panel."""
    pixels = np.asarray(figure.canvas.buffer_rgba())  # type: ignore[attr-defined]
    column, row = ax.transData.transform((x, y))
    return '#' + bytes(pixels[len(pixels) - int(row), int(column), :3].tolist()).hex()


def test_what_is_right_of_the_camera_is_right_in_the_picture() -> None:
    level = Camera.towards(np.array([0.0, 0.0, 10.0]), np.array([0.0, 50.0, 10.0]), NORTH)
    assert seen(level, 0.0, 50.0, 10.0) == pytest.approx((0.0, 0.0), abs=1e-3)
    assert seen(level, 5.0, 50.0, 10.0) == pytest.approx((0.1, 0.0), abs=1e-3)
    assert seen(level, 0.0, 50.0, 0.0) == pytest.approx((0.0, -0.2), abs=1e-3)


def test_who_looks_straight_down_has_its_course_up() -> None:
    """A target right below may lie a little off: the picture does not turn with it."""
    for off_m in (-0.5, 0.0, 0.5):
        down = Camera.towards(np.array([0.0, 0.0, 20.0]), np.array([off_m, off_m, 0.0]), NORTH)
        x, y = seen(down, 0.0, 4.0, 0.0)
        assert (x, y) == pytest.approx((0.0, 0.2), abs=0.06)


def test_what_is_behind_the_camera_is_not_seen_and_what_reaches_behind_is_cut() -> None:
    level = Camera.towards(np.array([0.0, 0.0, 2.0]), np.array([0.0, 9.0, 2.0]), NORTH)
    behind = np.array([[0.0, -5.0, 0.0], [1.0, -5.0, 0.0], [0.0, -6.0, 0.0]])
    assert level.project(behind) is None
    street = np.array([[-1.0, -50.0, 0.0], [1.0, -50.0, 0.0], [1.0, 50.0, 0.0], [-1.0, 50.0, 0.0]])
    cut = level.project(street)
    assert cut is not None
    assert np.isfinite(cut).all()
    assert cut[:, 1].max() == pytest.approx(-2.0 / 50.0)


def test_a_body_is_as_long_as_it_is_and_points_where_it_heads() -> None:
    state = np.array([10.0, 20.0, 0.0, 1.0, 0.0, 0.0, 1.0])
    ring = box_ring(state, 4.0, 2.0)
    assert (np.ptp(ring[:, 0]), np.ptp(ring[:, 1])) == (2.0, 4.0)
    assert shapely.Polygon(ring).exterior.is_ccw


def test_blocks_between_streets_stay_open() -> None:
    area = shapely.Point(0, 0).buffer(10.0) - shapely.Point(0, 0).buffer(5.0)
    figure, (ax,) = new_figure(2.0, 2.0)
    ax.set(xlim=(-11, 11), ylim=(-11, 11))
    ax.grid(visible=False)
    ax.add_patch(area_patch(area, '#000000'))
    figure.canvas.draw()
    assert colour_at(figure, ax, 7.0, 0.0) == '#000000'
    assert colour_at(figure, ax, 0.0, 0.0) == '#ffffff'


def test_the_figures_of_a_run_are_written_whole(tmp_path: Path) -> None:
    request = RunRequest(
        prompt='A drone tracks the ego car from 20 m at 30 m altitude for 10 seconds.',
        map_name='downtown', seed=1,
    )  # fmt: skip
    _, folder = run_into(tmp_path, request, WatchedStages())
    written = draw_gallery([folder.path], tmp_path / 'out')
    assert {p.name for p in written} == {
        f'{name}.{kind}'
        for name in ('views', 'maps', 'graphs', 'missions', 'example')
        for kind in ('pdf', 'svg', 'png', 'txt')
    }
    assert all(p.stat().st_size for p in written)
    # While it is tracked, the car is in the middle of what its UAV has before it, on its street.
    content = read_bag(folder.path / 'bag.0', message_definitions())
    tracks = np.flatnonzero(content.trace.uav_commands[:, 0, UavCommandColumn.PHASE] == 2)
    tick = int(tracks[-1])
    camera = looks_at(content.trace, 0, 0, tick)
    figure, (ax,) = new_figure(2.0, 1.4)
    faces = faces_of(content.world, content.trace, tick, camera.eye)
    draw_view(ax, camera, faces, streets_of(content.world))
    figure.canvas.draw()
    assert colour_at(figure, ax, 0.0, 0.0) in ('#0072b2', '#d55e00')


def test_a_folder_without_a_run_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ResultsError, match='is no run folder'):
        draw_gallery([tmp_path], tmp_path / 'out')
