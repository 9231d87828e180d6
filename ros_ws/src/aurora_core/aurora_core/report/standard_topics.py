# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A recorded run as a second bag of ROS's own message types (`standard_messages`).

Made from the bag of a run, so that the record a verdict needs stays as small as it is.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import numpy as np
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from aurora_core.errors import BagError
from aurora_core.knowledge.world import WorldModel
from aurora_core.report.export.thinning import kept_samples
from aurora_core.report.standard_messages import Moment, Point, StandardMessages
from aurora_core.trace.layout import UavColumn
from aurora_core.trace.records import LinkEventKind
from aurora_core.trace.trace import Trace

# Every second tick of 0.05 s: what a viewer shows smoothly.
EVERY_TICKS = 2
_VERSION: Literal[9] = 9
# The lines of flights are off by no more than this, m.
_FLIGHT_TOLERANCE_M = 0.5


def write_standard_bag(folder: Path, trace: Trace, world: WorldModel) -> dict[str, int]:
    """Write the bag and return its messages by topic.

    Args:
        folder: To create; it must not exist.
        trace: The run; who is absent at a tick, or has no sample there, is left out of it.
        world: Its world.

    Raises:
        BagError: The folder exists or cannot be written.
    """
    if folder.exists():
        raise BagError(f'{folder} exists', hint='name another folder')
    try:
        writer = Writer(folder, version=_VERSION, storage_plugin=StoragePlugin.MCAP)
        # Chunks of the file: poses ten times a second are much alike.
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        with writer:
            return dict(_Recorder(writer, trace, world).record())
    except OSError as err:
        raise BagError(
            f'cannot write the bag {folder}: {err}', hint='free some space or name another folder'
        ) from err


class _Recorder:
    """Turns ticks into messages of a bag."""

    def __init__(self, writer: Writer, trace: Trace, world: WorldModel) -> None:
        self._writer, self._trace = writer, trace
        self._store: Any = get_typestore(Stores.ROS2_JAZZY)
        self._connections: dict[str, Any] = {}
        self._counts: Counter[str] = Counter()
        arrived = {r.message for r in trace.links if r.kind is LinkEventKind.DELIVERED}
        self._said = StandardMessages(
            self._make,
            trace.roster,
            world,
            shown_ns=round(3 * EVERY_TICKS * trace.roster.dt_s * 1e9),
            lost={record.message for record in trace.links} - arrived,
        )

    def record(self) -> Counter[str]:
        self._send(0, *self._said.scene(self._flights()))
        for moment in self._moments():
            for said in self._said.at(moment):
                self._send(moment.time_ns, *said)
        return self._counts

    def _make(self, kind: str, /, **fields: Any) -> Any:
        return self._store.types[kind](**fields)

    def _send(self, time_ns: int, topic: str, type_name: str, message: Any) -> None:
        found = self._connections.get(topic)
        if found is None:
            found = self._writer.add_connection(topic, type_name, typestore=self._store)
            self._connections[topic] = found
        self._writer.write(found, time_ns, self._store.serialize_cdr(message, type_name))
        self._counts[topic] += 1

    def _moments(self) -> Iterator[Moment]:
        trace = self._trace
        seen: dict[tuple[str, str], bool] = {}
        for tick in range(0, trace.ticks, EVERY_TICKS):
            since = range(tick - EVERY_TICKS + 1, tick + 1)
            for sight in trace.sights:
                if sight.tick in since:
                    seen[(sight.observer, sight.target)] = sight.visible
            yield Moment(
                time_ns=round(tick * trace.roster.dt_s * 1e9),
                ground=trace.ground[tick],
                uav=trace.uav[tick],
                sent=[r for r in trace.links if r.kind is LinkEventKind.SENT and r.tick in since],
                seen=seen,
                happened=[r for r in trace.events if r.tick in since],
            )

    def _flights(self) -> dict[str, list[Point]]:
        """Return the ways that the UAVs flew."""
        trace = self._trace
        flights = {}
        for row, entry in enumerate(trace.roster.uavs):
            points = trace.uav[:, row, UavColumn.X : UavColumn.VX]
            here = np.flatnonzero(np.isfinite(points).all(axis=1))
            times_s = here.astype(np.float64) * trace.roster.dt_s
            kept = kept_samples(times_s, points[here], _FLIGHT_TOLERANCE_M)
            flights[entry.body_id] = [
                (float(x), float(y), float(z)) for x, y, z in points[here][kept]
            ]
        return flights
