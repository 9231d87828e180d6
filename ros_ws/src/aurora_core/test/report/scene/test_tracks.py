# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from aurora_core.report.scene.style import BACKGROUND_AGENT, EGO_COLOUR, colours_of
from aurora_core.report.scene.tracks import (
    Box,
    beside,
    mission_end_tick,
    region_of,
    tracks_of,
)
from aurora_core.trace.layout import GroundColumn


def test_an_agent_that_is_gone_leaves_a_gap(make: SimpleNamespace) -> None:
    trace = make.trace()
    ground = trace.ground.copy()
    ground[100:, 0, GroundColumn.PRESENT] = 0.0
    track = tracks_of(replace(trace, ground=ground))[0]
    assert track.at(99) is not None
    assert track.at(100) is None
    assert track.at(10_000) is None


def test_the_region_holds_every_flight_and_nearby_agents(make: SimpleNamespace) -> None:
    trace = make.trace()
    tracks = tracks_of(trace)
    region = region_of(tracks)
    assert all(region.holds(x, y) for x, y, _ in tracks[1].position_m)
    assert region.width >= 140.0


def test_an_agent_that_drives_away_does_not_widen_the_region(make: SimpleNamespace) -> None:
    trace = make.trace()
    ground = trace.ground.copy()
    ground[:, 0, GroundColumn.X] = np.arange(trace.ticks) * 100.0
    far = region_of(tracks_of(replace(trace, ground=ground)))
    assert far.east < 500.0


def test_missions_end_with_the_first_landing_command_of_the_last_uav(
    make: SimpleNamespace,
) -> None:
    assert mission_end_tick(tracks_of(make.trace(300))) == 200


def test_a_box_grows_to_an_aspect_ratio_around_its_centre() -> None:
    wide = Box(west=0.0, south=0.0, east=10.0, north=10.0).with_aspect(2.0)
    assert (wide.west, wide.east, wide.south, wide.north) == (-5.0, 15.0, 0.0, 10.0)
    tall = Box(west=0.0, south=0.0, east=10.0, north=10.0).with_aspect(0.5)
    assert (tall.south, tall.north, tall.width) == (-5.0, 15.0, 10.0)


def test_colours_are_told_apart_and_the_ego_keeps_its_own(make: SimpleNamespace) -> None:
    trace = make.trace()
    entry = trace.roster.agents[0]
    roles = ('other', 'ego', 'background', 'other')
    agents = tuple(replace(entry, body_id=f'a{k}', role=role) for k, role in enumerate(roles))
    ground = np.repeat(trace.ground, 4, axis=1)
    many = replace(trace, roster=replace(trace.roster, agents=agents), ground=ground)
    colours = colours_of(tracks_of(many))
    assert colours['a1'] == EGO_COLOUR
    assert colours['a2'] == BACKGROUND_AGENT
    assert len({colours[name] for name in ('a0', 'a1', 'a3')}) == 3


def test_a_way_is_shifted_to_its_left() -> None:
    east = np.column_stack((np.linspace(0.0, 100.0, 101), np.zeros(101)))
    shifted = beside(east, 3.0)
    assert shifted[:, 1] == pytest.approx(3.0)
    assert shifted[:, 0] == pytest.approx(east[:, 0])
    assert np.array_equal(beside(east, 0.0), east)


def test_standing_still_keeps_the_side_of_the_way_to_come() -> None:
    way = np.column_stack((np.maximum(0.0, np.arange(100.0) - 50.0), np.zeros(100)))
    assert beside(way, 2.0)[0] == pytest.approx((0.0, 2.0))
