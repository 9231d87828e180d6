# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Measure a map and the vehicle models, and write what came of it, all or nothing."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from aurora_cli.installed import forget
from aurora_cli.interrupts import Interrupts
from aurora_cli.map_measure.flights import measure_multirotor
from aurora_cli.map_measure.write import write_records
from aurora_core.errors import ConfigError
from aurora_core.geometry.prism import Prism
from aurora_core.grounding.airspace import building_prisms
from aurora_core.knowledge import agent_types, uav_record
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.height_lattice import height_lattice
from aurora_core.knowledge.lane_samples import LaneSamples, sample_lanes
from aurora_core.knowledge.limits import load_limits
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import (
    ARRAYS_NAME,
    NAMED,
    NOT_ALLOWED,
    RECORDS_NAME,
    REFUSED,
    STANDS,
    Failure,
    MapRecords,
    PartRecord,
    SpawnRecord,
    SpawnTable,
    WalkRecord,
    arrays_file,
    map_basis,
    packed,
    records_folder,
    records_text,
)
from aurora_core.knowledge.measured_on import ground_basis, uav_basis, vtypes_path
from aurora_core.knowledge.reach import edge_parts
from aurora_core.knowledge.settings import load_settings
from aurora_core.knowledge.sight_shares import CornerShare, SightShare, corner_shares, sight_shares
from aurora_core.knowledge.uav_record import (
    UavRecord,
    limits_in_force,
    load_uav_record,
    planned_clearance_m,
)
from aurora_core.spec.vocabulary import AgentType
from aurora_sumo_bridge.drive_probe import measure_types
from aurora_sumo_bridge.spawn_probe import Spot, probe_spawns
from aurora_sumo_bridge.walk_probe import Walk, probe_walks

Tell = Callable[[str], None]
_SCHEMA = 1


@dataclass(kw_only=True)
class Measured:
    """What was measured, where it was written, and how long each step took.

    Attributes:
        lower_limits: Limits that the multirotor does not reach, in sentences.
    """

    model: MapModel
    types: tuple[AgentTypeRecord, ...]
    multirotor: UavRecord
    records: MapRecords
    lower_limits: tuple[str, ...]
    files: tuple[Path, ...] = ()
    seconds: dict[str, float] = field(default_factory=dict)


def measure(model: MapModel, tell: Tell, *, again: bool = True) -> Measured:
    """Measure the vehicle models and a map, and write their records.

    Nothing is written before all is measured, so that Ctrl-C leaves what was there.

    Args:
        model: Map.
        tell: Is told each step before it is done.
        again: Fly the multirotor whether or not its record is of what is installed.

    Raises:
        AuroraError: A simulator fails, or a record cannot be written.
    """
    seconds: dict[str, float] = {}
    dt_s = load_settings().run.dt_s
    limits = load_limits(config_path('limits.json'))
    with _timed(seconds, 'vehicles', tell):
        names = sorted(kind.value for kind in AgentType)
        types = measure_types(vtypes_path(), names, dt_s, lambda _: None)
    with _timed(seconds, 'multirotor', tell):
        known = None if again else _known_multirotor()
        multirotor = known or measure_multirotor(dt_s, limits)
    clearance_m = planned_clearance_m(load_settings(), limits, multirotor)
    with _timed(seconds, 'lane samples', tell):
        samples = sample_lanes(model)
        lattice = height_lattice(model, clearance_m)
    with _timed(seconds, 'spawn points', tell):
        spawns, spawn_records = _spawns(model, samples, types, dt_s, tell)
    with _timed(seconds, 'walks', tell):
        along, over = probe_walks(
            model.net_path,
            vtypes_path(),
            [lane.id for lane in model.network.sidewalks],
            [crossing.id for crossing in model.network.crossings],
            dt_s,
        )
    with _timed(seconds, 'connectivity and sight', tell):
        parts = _parts(model, types)
        prisms = building_prisms(model.buildings)
        sight, corners = _sight(model, samples, prisms)
    arrays = packed(samples, spawns, lattice, _seconds(along), _seconds(over))
    data, digest = arrays_file(arrays)
    records = MapRecords(
        schema_version=_SCHEMA,
        map_name=model.name,
        made_of=map_basis(model, dt_s, clearance_m),
        arrays_sha256=digest,
        samples=len(samples),
        spawns=spawn_records,
        sidewalks=_walk_record(along),
        crossings=_walk_record(over),
        parts=parts,
        sight=sight,
        corners=corners,
    )
    done = Measured(
        model=model,
        types=types,
        multirotor=multirotor,
        records=records,
        lower_limits=limits_in_force(limits, multirotor),
        seconds=seconds,
    )
    folder = records_folder(model.name)
    with Interrupts():
        # The records last: until they are there, their digests refuse the new arrays.
        done.files = write_records(
            {
                config_path().joinpath(*agent_types.RECORDS): _types_text(types, dt_s),
                config_path().joinpath(*uav_record.RECORDS): _text(
                    {
                        'schema_version': _SCHEMA,
                        'made_of': uav_basis(dt_s, limits),
                        'multirotor': multirotor.model_dump(mode='json'),
                    }
                ),
                folder / ARRAYS_NAME: data,
                folder / RECORDS_NAME: records_text(records).encode('utf-8'),
            }
        )
    forget()
    return done


def _known_multirotor() -> UavRecord | None:
    """Return the record of the multirotor where it is of what is installed."""
    try:
        return load_uav_record()
    except ConfigError:
        return None


@contextmanager
def _timed(seconds: dict[str, float], step: str, tell: Tell) -> Iterator[None]:
    tell(step)
    start_s = time.monotonic()
    yield
    seconds[step] = time.monotonic() - start_s


def _spawns(
    model: MapModel,
    samples: LaneSamples,
    types: Sequence[AgentTypeRecord],
    dt_s: float,
    tell: Tell,
) -> tuple[SpawnTable, tuple[SpawnRecord, ...]]:
    """Insert every vehicle type at every sample of the lanes that it may use."""
    lanes = [model.network.lane(lane_id) for lane_id in samples.lane_ids]
    drivers = [record for record in types if not record.is_person]
    table = np.full((len(drivers), len(samples)), NOT_ALLOWED, dtype=np.uint8)
    rows = []
    for number, record in enumerate(drivers):
        tell(f'spawn points: {record.name}')
        may = np.array([record.vclass in lane.allows for lane in lanes], dtype=bool)
        tried = np.flatnonzero(may[samples.lane]) if len(lanes) else np.zeros(0, dtype=int)
        spots = [Spot(samples.lane_ids[samples.lane[s]], float(samples.arc_m[s])) for s in tried]
        answers = probe_spawns(model.net_path, vtypes_path(), record.name, spots, dt_s)
        wrong = [
            Failure(place=f'{spot.lane_id} at {spot.arc_m:.1f} m', why=answer)
            for spot, answer in zip(spots, answers, strict=True)
            if answer
        ]
        table[number, tried] = [REFUSED if answer else STANDS for answer in answers]
        rows.append(
            SpawnRecord(
                type_name=record.name,
                tried=len(spots),
                stands=len(spots) - len(wrong),
                failures=tuple(wrong[:NAMED]),
            )
        )
    names = tuple(record.name for record in drivers)
    return SpawnTable(type_names=names, samples=samples, table=table), tuple(rows)


def _seconds(walks: Sequence[Walk]) -> Mapping[str, float]:
    return {walk.id: walk.seconds for walk in walks}


def _walk_record(walks: Sequence[Walk]) -> WalkRecord:
    wrong = [Failure(place=walk.id, why=walk.why) for walk in walks if not walk.walked]
    return WalkRecord(
        tried=len(walks), walked=len(walks) - len(wrong), failures=tuple(wrong[:NAMED])
    )


def _parts(model: MapModel, types: Sequence[AgentTypeRecord]) -> tuple[PartRecord, ...]:
    rows = []
    for vclass in sorted({record.vclass for record in types if not record.is_person}):
        parts = edge_parts(model.network, vclass)
        lengths_m = [sum(model.network.edge(edge).length_m for edge in part) for part in parts]
        total_m = sum(lengths_m)
        rows.append(
            PartRecord(
                vehicle_class=vclass,
                length_km=round(total_m / 1000.0, 3),
                largest_share=round(lengths_m[0] / total_m, 4) if total_m else 0.0,
                parts=len(parts),
            )
        )
    return tuple(rows)


def _sight(
    model: MapModel, samples: LaneSamples, prisms: Sequence[Prism]
) -> tuple[tuple[SightShare, ...], tuple[CornerShare, ...]]:
    network = model.network
    ends_at = [network.edge(network.lane(i).edge_id).to_junction for i in samples.lane_ids]
    return sight_shares(samples, prisms), corner_shares(samples, ends_at, prisms)


def _types_text(types: Sequence[AgentTypeRecord], dt_s: float) -> bytes:
    rows = [record.model_dump(mode='json', exclude_none=True) for record in types]
    return _text({'schema_version': _SCHEMA, 'made_of': ground_basis(dt_s), 'types': rows})


def _text(document: Mapping[str, object]) -> bytes:
    return (json.dumps(document, indent=1, ensure_ascii=False) + '\n').encode('utf-8')
