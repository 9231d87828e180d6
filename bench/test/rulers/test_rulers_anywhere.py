# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Prompts for any map: none that names a landmark or a street of a bundled one."""

from __future__ import annotations

from aurora_bench.rulers.anywhere import place_names, places_of_maps


def test_landmarks_and_streets_of_every_bundled_map_are_places() -> None:
    places = places_of_maps()
    assert {'city hall', 'meridian parkway', 'annankatu'} <= places
    assert 'intersection' not in places


def test_a_place_is_found_wherever_an_annotation_names_it() -> None:
    places = places_of_maps()
    missions = [{'kind': 'mission', 'target': 'landmark:City Hall'}]
    counts = [{'kind': 'placement', 'of': ['ego', 'Meridian Parkway'], 'distance_m': 10}]
    anywhere = [{'kind': 'mission', 'target': 'intersection', 'altitude_m': 35}]
    assert not places.isdisjoint(place_names(missions))
    assert not places.isdisjoint(place_names(counts))
    assert places.isdisjoint(place_names(anywhere))
