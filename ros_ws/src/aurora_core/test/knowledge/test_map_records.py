# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Records of a map: those of the bundled maps are there, fit, and others are refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aurora_core.errors import ConfigError
from aurora_core.knowledge.array_file import arrays_bytes
from aurora_core.knowledge.height_lattice import height_lattice
from aurora_core.knowledge.lane_samples import sample_lanes
from aurora_core.knowledge.map_folders import bundled_maps
from aurora_core.knowledge.map_model import MapModel, load_map
from aurora_core.knowledge.map_records import (
    ARRAYS_NAME,
    RECORDS_NAME,
    REFUSED,
    STANDS,
    MeasuredMap,
    SpawnTable,
    load_measured_map,
    records_folder,
)

DT_S = 0.05
CLEARANCE_M = 5.0  # that planned ways keep


def _loaded(model: MapModel) -> MeasuredMap:
    found = load_measured_map(model, DT_S, CLEARANCE_M)
    assert found is not None
    return found


def _records(config: Path) -> Path:
    return config / 'knowledge' / 'maps' / 'junction' / RECORDS_NAME


def test_every_bundled_map_is_measured() -> None:
    for name in bundled_maps():
        model = load_map(name)
        found = _loaded(model)
        assert arrays_bytes(found.samples.arrays()) == arrays_bytes(sample_lanes(model).arrays())
        lattice = height_lattice(model, CLEARANCE_M)
        assert (found.lattice.free_above_dm == lattice.free_above_dm).all()
        for row in found.records.spawns:
            number = found.spawns.type_names.index(row.type_name)
            assert (found.spawns.table[number] == STANDS).sum() == row.stands
        assert set(found.walks.sidewalk_s) == {lane.id for lane in model.network.sidewalks}
        assert set(found.walks.crossing_s) == {crossing.id for crossing in model.network.crossings}
        assert (
            sum(map(found.walks.crosses, found.walks.crossing_s)) == found.records.crossings.walked
        )


def test_all_records_together_are_small() -> None:
    files = [path for path in records_folder('downtown').parents[1].rglob('*') if path.is_file()]
    assert sum(path.stat().st_size for path in files) < 300_000


def test_on_the_shipped_maps_every_vehicle_stands_and_every_walk_is_walked() -> None:
    for name in ('downtown', 'junction'):
        records = _loaded(load_map(name)).records
        assert all(row.stands == row.tried > 0 for row in records.spawns)
        assert records.sidewalks.walked == records.sidewalks.tried
        assert records.crossings.walked == records.crossings.tried
        assert all(part.largest_share == 1.0 for part in records.parts)


def test_a_map_without_records_is_not_measured(config: Path, junction: MapModel) -> None:
    _records(config).unlink()
    assert load_measured_map(junction, DT_S, CLEARANCE_M) is None


@pytest.mark.parametrize(
    ('name', 'value'),
    [('map_digest', 'f' * 64), ('clearance_m', 9.0), ('simulator', '1.0'), ('dt_s', 0.1)],
)
def test_records_of_something_else_are_refused(
    config: Path, junction: MapModel, name: str, value: object
) -> None:
    path = _records(config)
    table = json.loads(path.read_text())
    table['made_of'][name] = value
    path.write_text(json.dumps(table))
    with pytest.raises(ConfigError, match=f'measured with {name} ') as caught:
        load_measured_map(junction, DT_S, CLEARANCE_M)
    assert caught.value.hint == 'measure again: aurora map measure junction'


def test_a_changed_clearance_is_refused(junction: MapModel) -> None:
    with pytest.raises(ConfigError, match=r'measured with clearance_m 5\.0, here is 4\.0'):
        load_measured_map(junction, DT_S, 4.0)


@pytest.mark.parametrize(
    ('change', 'named'),
    [
        (lambda t: t.pop('samples'), 'samples'),
        (lambda t: t.update(arrays_sha256='0'), 'is not the one that'),
    ],
)
def test_damaged_records_are_refused(
    config: Path, junction: MapModel, change: Any, named: str
) -> None:
    path = _records(config)
    table = json.loads(path.read_text())
    change(table)
    path.write_text(json.dumps(table))
    with pytest.raises(ConfigError, match=named) as caught:
        load_measured_map(junction, DT_S, CLEARANCE_M)
    assert caught.value.hint == 'measure again: aurora map measure junction'


@pytest.mark.parametrize('name', [RECORDS_NAME, ARRAYS_NAME])
def test_files_that_break_off_are_refused(config: Path, junction: MapModel, name: str) -> None:
    path = _records(config).with_name(name)
    path.write_bytes(path.read_bytes()[:100])
    with pytest.raises(ConfigError) as caught:
        load_measured_map(junction, DT_S, CLEARANCE_M)
    assert caught.value.hint == 'measure again: aurora map measure junction'


def test_a_refused_sample_refuses_its_surroundings(junction: MapModel) -> None:
    samples = sample_lanes(junction)
    table = np.full((1, len(samples)), STANDS, dtype=np.uint8)
    lane_id = samples.lane_ids[0]
    table[0, samples.first[lane_id][0]] = REFUSED
    spawns = SpawnTable(type_names=('car',), samples=samples, table=table)
    assert not spawns.accepts('car', lane_id, 3.0)
    assert spawns.accepts('car', lane_id, 14.0)
    assert spawns.accepts('bus', lane_id, 3.0)
    assert spawns.accepts('car', 'no lane', 3.0)
