# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a map lacks is said once, for all vehicle classes that it touches alike."""

from __future__ import annotations

import pytest

from aurora_core.knowledge.map_model import MapModel, load_map
from aurora_core.knowledge.map_records import MapRecords, PartRecord, load_measured_map
from aurora_core.knowledge.sight_shares import SightShare
from aurora_core.report.map_gaps import map_gaps


@pytest.fixture(scope='module')
def model() -> MapModel:
    return load_map('downtown')


@pytest.fixture(scope='module')
def measured(model: MapModel) -> MapRecords:
    found = load_measured_map(model, 0.05, 5.0)
    assert found is not None
    return found.records


def test_classes_that_share_unconnected_roads_share_a_line(
    model: MapModel, measured: MapRecords
) -> None:
    shares = {'bus': 0.8, 'passenger': 0.93, 'truck': 0.93, 'bicycle': 1.0}
    parts = tuple(
        PartRecord(vehicle_class=name, length_km=10.0, largest_share=share, parts=2)
        for name, share in shares.items()
    )
    records = measured.model_copy(update={'parts': parts})
    said = [gap.lacks for gap in map_gaps(model, records) if 'unconnected' in gap.lacks]
    assert said == [
        'unconnected roads, 20% of the length for bus',
        'unconnected roads, 7% of the length for passenger, truck',
    ]


@pytest.mark.parametrize(('share', 'told'), [(0.49, 1), (0.5, 0)])
def test_streets_that_are_hardly_seen_are_told(
    model: MapModel, measured: MapRecords, share: float, told: int
) -> None:
    view = SightShare(height_m=40.0, distance_m=50.0, free_share=share)
    records = measured.model_copy(update={'sight': (view,)})
    said = [gap.text for gap in map_gaps(model, records)]
    assert sum('narrow streets' in text for text in said) == told


def test_one_way_streets_alone_are_told(model: MapModel, monkeypatch: pytest.MonkeyPatch) -> None:
    assert 'no street with two directions' not in {gap.lacks for gap in map_gaps(model)}
    monkeypatch.setattr(type(model.network), 'opposite_edge', lambda *_: None)
    assert 'no street with two directions' in {gap.lacks for gap in map_gaps(model)}
