# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a map lacks is said once, for all vehicle classes that it touches alike."""

from __future__ import annotations

from aurora_core.knowledge.map_model import load_map
from aurora_core.knowledge.map_records import PartRecord, load_measured_map
from aurora_core.report.map_gaps import map_gaps


def test_classes_that_share_unconnected_roads_share_a_line() -> None:
    model = load_map('downtown')
    found = load_measured_map(model, 0.05, 5.0)
    assert found is not None
    shares = {'bus': 0.8, 'passenger': 0.93, 'truck': 0.93, 'bicycle': 1.0}
    parts = tuple(
        PartRecord(vehicle_class=name, length_km=10.0, largest_share=share, parts=2)
        for name, share in shares.items()
    )
    records = found.records.model_copy(update={'parts': parts})
    said = [gap.lacks for gap in map_gaps(model, records) if 'unconnected' in gap.lacks]
    assert said == [
        'unconnected roads, 20% of the length for bus',
        'unconnected roads, 7% of the length for passenger, truck',
    ]
