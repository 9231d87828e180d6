# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Lanes of a route are chosen with the fewest changes, ties to the right."""

from __future__ import annotations

import pytest

from aurora_core.knowledge.lane_plan import LanePlan, LanePlanner
from aurora_core.knowledge.map_model import MapModel


def _plan(
    model: MapModel, edge_ids: tuple[str, ...], vclass: str, start: str | None = None
) -> LanePlan | None:
    network = model.network
    links = {lane_id: network.connections_from(lane_id) for lane_id in network.lanes}
    edges = tuple(network.edge(edge_id) for edge_id in edge_ids)
    return LanePlanner(network.lanes, links).plan(edges, vclass, start)


@pytest.mark.parametrize(
    ('route', 'lane_id'),
    [
        (('long_street_1_eb', 'long_street_2_eb'), 'long_street_1_eb_1'),
        (('long_street_1_eb', 'cross_street_1_sb'), 'long_street_1_eb_1'),
        (('long_street_1_eb', 'cross_street_2_nb'), 'long_street_1_eb_2'),
    ],
)
def test_takes_the_lane_that_needs_no_change(
    junction: MapModel, route: tuple[str, ...], lane_id: str
) -> None:
    plan = _plan(junction, route, 'passenger')
    assert plan is not None
    assert plan.entry == plan.exit
    assert plan.entry[0] == lane_id


def test_counts_changes_over_the_whole_route(downtown: MapModel) -> None:
    route = downtown.network.shortest_route(
        'meridian_parkway_1_eb', 'grand_boulevard_3_nb', 'passenger'
    )
    assert route is not None
    plan = _plan(downtown, route, 'passenger')
    assert plan is not None
    # The left turn onto the boulevard is known from the first edge on.
    assert plan.entry == plan.exit
    assert plan.entry[0] == 'meridian_parkway_1_eb_2'


def test_bicycles_use_the_bike_lane(downtown: MapModel) -> None:
    plan = _plan(downtown, ('market_street_4_eb', 'market_street_5_eb'), 'bicycle')
    assert plan is not None
    assert plan.entry == ('market_street_4_eb_1', 'market_street_5_eb_1')


def test_never_slides_over_a_lane_that_is_closed_to_the_class(downtown: MapModel) -> None:
    # From the sidewalk over the closed parking strip to the traffic lane: no way.
    start = 'cannery_street_6_eb_0'
    assert 'pedestrian' in downtown.network.lane(start).allows
    route = ('cannery_street_6_eb', 'cannery_street_7_eb')
    assert _plan(downtown, route, 'passenger', start) is None


def test_unconnected_edges_have_no_plan(junction: MapModel) -> None:
    assert _plan(junction, ('long_street_1_eb', 'long_street_1_wb'), 'passenger') is None
