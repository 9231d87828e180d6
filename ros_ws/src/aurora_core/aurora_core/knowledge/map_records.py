# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`MapRecords`: what was measured on a map, and the arrays that belong to it.

Two files: `records.json` says what was measured, of what, and what came of it in numbers;
`arrays.npz` has the lane samples, where each vehicle type stands, the walks and the lattice.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from pydantic import ValidationError

from aurora_core.document import Document, first_problem
from aurora_core.errors import MapError
from aurora_core.files import MAP_BYTES, read_json
from aurora_core.knowledge.array_file import Arrays, arrays_bytes, arrays_digest, read_arrays
from aurora_core.knowledge.config_files import config_root
from aurora_core.knowledge.height_lattice import HeightLattice
from aurora_core.knowledge.lane_samples import LaneSamples, sample_lanes
from aurora_core.knowledge.map_folders import bundled_maps, own_maps_folder
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.measured_on import check_made_of, ground_basis
from aurora_core.knowledge.sight_shares import CornerShare, SightShare

RECORDS_NAME = 'records.json'
ARRAYS_NAME = 'arrays.npz'
NOT_ALLOWED, STANDS, REFUSED = 0, 1, 2

_LANES, _LATTICE, _SPAWNS, _WALKS = 'lanes.', 'lattice.', 'spawns.', 'walks.'
# So many places that failed are named.
NAMED = 5


class Failure(Document):
    """A place at which something did not work."""

    place: str
    why: str


class SpawnRecord(Document):
    """How many of the samples that a vehicle type may use it really stands at."""

    type_name: str
    tried: int
    stands: int
    failures: tuple[Failure, ...]


class WalkRecord(Document):
    """How many of the sidewalks, or of the crossings, were walked."""

    tried: int
    walked: int
    failures: tuple[Failure, ...]


class PartRecord(Document):
    """How much of the streets for a vehicle class hangs together.

    Attributes:
        length_km: Of all its streets, each direction counted.
        largest_share: Share of that in the largest part in which each leads to each.
        parts: Number of parts.
    """

    vehicle_class: str
    length_km: float
    largest_share: float
    parts: int


class MapRecords(Document):
    """What was measured on a map; see the attributes of its parts.

    Attributes:
        made_of: Digests and numbers that it depends on.
        arrays_sha256: Digest over names and values of the arrays.
    """

    schema_version: int
    map_name: str
    made_of: dict[str, str | float]
    arrays_sha256: str
    samples: int
    spawns: tuple[SpawnRecord, ...]
    sidewalks: WalkRecord
    crossings: WalkRecord
    parts: tuple[PartRecord, ...]
    sight: tuple[SightShare, ...]
    corners: tuple[CornerShare, ...]


@dataclass(frozen=True, kw_only=True)
class SpawnTable:
    """Where vehicle types stand: `NOT_ALLOWED`, `STANDS` or `REFUSED` by type and sample."""

    type_names: tuple[str, ...]
    samples: LaneSamples
    table: npt.NDArray[np.uint8]

    def accepts(self, type_name: str, lane_id: str, arc_m: float) -> bool:
        """Tell whether a type can be put on a lane: its nearest sample was not refused.

        A type or a lane that was not measured is not held to be refused.
        """
        sample = self.samples.nearest(lane_id, arc_m)
        if sample is None or type_name not in self.type_names:
            return True
        return bool(self.table[self.type_names.index(type_name), sample] != REFUSED)


def not_measured(map_model: MapModel) -> SpawnTable:
    """Return the lane samples of a map that was not measured: nothing is refused there."""
    samples = sample_lanes(map_model)
    table = np.zeros((0, len(samples)), dtype=np.uint8)
    return SpawnTable(type_names=(), samples=samples, table=table)


def may_stand(spawns: SpawnTable | None, type_name: str, lane_id: str, arc_m: float) -> bool:
    """Tell whether a type can be put on a lane; on a map that was not measured it may be."""
    return spawns is None or spawns.accepts(type_name, lane_id, arc_m)


@dataclass(frozen=True, kw_only=True)
class WalkTable:
    """Which sidewalks and crossings were walked from one end to the other.

    Attributes:
        sidewalk_s: Seconds along each sidewalk, 0 where it was not walked.
        crossing_s: Seconds over each crossing, 0 where it was not walked.
    """

    sidewalk_s: Mapping[str, float]
    crossing_s: Mapping[str, float]

    def walks(self, lane_id: str) -> bool:
        """Tell whether somebody gets along a sidewalk; one that was not tried is not refused."""
        return self.sidewalk_s.get(lane_id, 1.0) > 0.0

    def crosses(self, crossing_id: str) -> bool:
        """Tell whether somebody gets over a crossing; one not tried is not refused."""
        return self.crossing_s.get(crossing_id, 1.0) > 0.0


@dataclass(frozen=True, kw_only=True)
class MeasuredMap:
    """The records of a map with their arrays.

    Attributes:
        records: What was measured.
        samples: Lane samples.
        spawns: Where vehicle types stand.
        lattice: Above which height the air is free.
        walks: Which sidewalks and crossings were walked.
    """

    records: MapRecords
    samples: LaneSamples
    spawns: SpawnTable
    lattice: HeightLattice
    walks: WalkTable


def packed(
    samples: LaneSamples,
    spawns: SpawnTable,
    lattice: HeightLattice,
    sidewalk_s: Mapping[str, float],
    crossing_s: Mapping[str, float],
) -> dict[str, npt.NDArray[Any]]:
    """Return all arrays of a map by name."""
    return {
        **{_LANES + name: array for name, array in samples.arrays().items()},
        **{_LATTICE + name: array for name, array in lattice.arrays().items()},
        _SPAWNS + 'type_names': np.array(spawns.type_names, dtype=np.str_),
        _SPAWNS + 'table': spawns.table,
        **_walks('sidewalk', sidewalk_s),
        **_walks('crossing', crossing_s),
    }


def records_text(records: MapRecords) -> str:
    """Return the text of `records.json`."""
    return json.dumps(records.model_dump(mode='json'), indent=1, ensure_ascii=False) + '\n'


def arrays_file(arrays: Arrays) -> tuple[bytes, str]:
    """Return the bytes of `arrays.npz` and the digest for the records."""
    return arrays_bytes(arrays), arrays_digest(arrays)


def records_folder(name: str) -> Path:
    """Return the folder for the records of a map, whether it exists or not.

    Raises:
        ConfigError: There is no configuration folder.
    """
    if name in bundled_maps():
        return config_root() / 'knowledge' / 'maps' / name
    return own_maps_folder() / name / 'measured'


def map_basis(model: MapModel, dt_s: float, clearance_m: float) -> dict[str, str | float]:
    """Return what the records of a map are made of here.

    Args:
        model: Map.
        dt_s: Step of the simulators.
        clearance_m: What the lattice keeps from obstacles.
    """
    return {'map_digest': model.digest, 'clearance_m': clearance_m, **ground_basis(dt_s)}


def load_measured_map(model: MapModel, dt_s: float, clearance_m: float) -> MeasuredMap | None:
    """Return the records of a map, None where it was not measured.

    Args:
        model: Map.
        dt_s: Step at which they are to be used.
        clearance_m: Clearance in force.

    Raises:
        MapError: They are damaged.
        ConfigError: They were made of another map, simulator or settings.
    """
    folder = records_folder(model.name)
    path = folder / RECORDS_NAME
    if not path.exists():
        return None
    again = f'measure again: aurora map measure {model.name}'
    try:
        records = MapRecords.model_validate(read_json(path, MAP_BYTES))
    except ValidationError as err:
        raise MapError(f'{path} is not valid: {first_problem(err)}', hint=again) from err
    except (OSError, ValueError) as err:
        raise MapError(f'{path} cannot be read: {err}', hint=again) from err
    check_made_of(path, records.made_of, map_basis(model, dt_s, clearance_m), model.name)
    try:
        arrays = read_arrays(folder / ARRAYS_NAME)
        if arrays_digest(arrays) != records.arrays_sha256:
            raise MapError(f'{folder / ARRAYS_NAME} is not the one that {path} belongs to')
        return _unpacked(records, arrays)
    except MapError as err:
        raise MapError(err.message, hint=again) from err


def _unpacked(records: MapRecords, arrays: Arrays) -> MeasuredMap:
    samples = LaneSamples.of_arrays(_below(arrays, _LANES))
    spawns = _below(arrays, _SPAWNS)
    walks = _below(arrays, _WALKS)
    try:
        table = SpawnTable(
            type_names=tuple(str(name) for name in spawns['type_names']),
            samples=samples,
            table=spawns['table'],
        )
        seconds = [
            dict(zip(walks[f'{kind}_ids'].tolist(), walks[f'{kind}_s'].tolist(), strict=True))
            for kind in ('sidewalk', 'crossing')
        ]
    except (KeyError, ValueError) as err:
        raise MapError(f'the arrays of a map lack {err}') from err
    if table.table.shape != (len(table.type_names), len(samples)):
        raise MapError('the table of spawn points has another size than the samples')
    return MeasuredMap(
        records=records,
        samples=samples,
        spawns=table,
        lattice=HeightLattice.of_arrays(_below(arrays, _LATTICE)),
        walks=WalkTable(sidewalk_s=seconds[0], crossing_s=seconds[1]),
    )


def _walks(kind: str, seconds: Mapping[str, float]) -> dict[str, npt.NDArray[Any]]:
    return {
        f'{_WALKS}{kind}_ids': np.array(sorted(seconds), dtype=np.str_),
        f'{_WALKS}{kind}_s': np.array([seconds[k] for k in sorted(seconds)], dtype=np.float32),
    }


def _below(arrays: Arrays, prefix: str) -> dict[str, npt.NDArray[Any]]:
    return {k.removeprefix(prefix): v for k, v in arrays.items() if k.startswith(prefix)}
