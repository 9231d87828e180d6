# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Surfaces: what is carriageway, what is sidewalk, and that they do not overlap."""

from __future__ import annotations

import shapely

from aurora_core.knowledge.map_model import MapModel


def test_points_lie_on_the_right_surface(junction: MapModel) -> None:
    network = junction.network
    cases = {
        (-100.0, -1.6): 'carriageway',
        (-100.0, -6.4): 'carriageway',
        (-100.0, -8.0): 'sidewalk',
        (0.0, 0.0): 'carriageway',
        (-100.0, -10.0): 'none',
    }
    for (x, y), expected in cases.items():
        point = shapely.Point(x, y)
        on_road = network.carriageway.covers(point)
        on_walk = network.sidewalk_area.covers(point)
        found = 'carriageway' if on_road else 'sidewalk' if on_walk else 'none'
        assert found == expected, (x, y)


def test_crossings_are_on_the_carriageway_between_sidewalks(junction: MapModel) -> None:
    network = junction.network
    assert len(network.crossings) == 4
    for crossing in network.crossings:
        middle = shapely.LineString(crossing.centre_line).interpolate(0.5, normalized=True)
        assert network.carriageway.covers(middle)
        for end in (crossing.centre_line[0], crossing.centre_line[-1]):
            assert network.sidewalk_area.distance(shapely.Point(end)) < 0.5
        assert crossing.has_signal


def test_carriageway_sidewalk_and_parking_are_apart(downtown: MapModel) -> None:
    network = downtown.network
    total = network.carriageway.area + network.sidewalk_area.area + network.parking_area.area
    # Lanes meet sidewalks along their edges; what overlaps is slivers at bends.
    assert total - network.street_surface.area < 0.001 * total
    assert network.parking_area.area > 2000.0
