# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Shares of free views: all of them without buildings, fewer with, more from higher up."""

from __future__ import annotations

import pytest

from aurora_core.geometry.prism import Prism
from aurora_core.grounding.airspace import building_prisms
from aurora_core.knowledge.lane_samples import LaneSamples, sample_lanes
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.sight_shares import corner_shares, sight_shares


@pytest.fixture(scope='module')
def samples(downtown: MapModel) -> LaneSamples:
    return sample_lanes(downtown)


@pytest.fixture(scope='module')
def prisms(downtown: MapModel) -> tuple[Prism, ...]:
    return building_prisms(downtown.buildings)


def _ends(model: MapModel, samples: LaneSamples) -> list[str]:
    network = model.network
    return [network.edge(network.lane(i).edge_id).to_junction for i in samples.lane_ids]


def test_without_buildings_everything_is_seen(downtown: MapModel, samples: LaneSamples) -> None:
    assert {row.free_share for row in sight_shares(samples, ())} == {1.0}
    corners = corner_shares(samples, _ends(downtown, samples), ())
    assert {row.hidden_share for row in corners} == {0.0}
    assert all(row.pairs > 0 for row in corners)


def test_from_higher_up_and_nearer_more_is_seen(
    samples: LaneSamples, prisms: tuple[Prism, ...]
) -> None:
    share = {
        (row.height_m, row.distance_m): row.free_share for row in sight_shares(samples, prisms)
    }
    heights = sorted({height for height, _ in share})
    distances = sorted({distance for _, distance in share})
    for distance in distances:
        of_height = [share[height, distance] for height in heights]
        assert of_height == sorted(of_height)
    for height in heights:
        of_distance = [share[height, distance] for distance in distances]
        assert of_distance == sorted(of_distance, reverse=True)
    assert 0.0 < min(share.values()) < max(share.values()) <= 1.0


def test_farther_from_a_corner_more_is_hidden(
    downtown: MapModel, samples: LaneSamples, prisms: tuple[Prism, ...]
) -> None:
    near, far = corner_shares(samples, _ends(downtown, samples), prisms)
    assert near.before_m < far.before_m
    assert 0.0 < near.hidden_share < far.hidden_share < 1.0
