# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One peer: frame counters per vehicle, and which telemetry it gets how often."""

from __future__ import annotations

from aurora_uav_sim.plan_transfer import Uploads, ask_again
from aurora_uav_sim.protocol import AUTOPILOT_COMPONENT
from aurora_uav_sim.telemetry import STREAMS
from aurora_uav_sim.vehicle import Vehicle
from aurora_uav_sim.wire import Sequence

# Fastest stream that a peer may ask for.
MIN_INTERVAL_S = 0.01


class Link:
    """What the server keeps per peer.

    Attributes:
        permanent: Configured, never dropped for silence.
        heard: A frame came since the last poll.
        heard_s: Steady time of the last poll that found it so.
        sequences: Frame counters by system id.
        uploads: Plans on their way, by system id.
    """

    __slots__ = (
        '_due_s', '_intervals_s', 'heard', 'heard_s', 'permanent', 'sequences', 'uploads',
    )  # fmt: skip

    def __init__(self, *, permanent: bool) -> None:
        self.permanent = permanent
        self.heard = False
        self.heard_s = 0.0
        self.sequences: dict[int, Sequence] = {}
        self._intervals_s: dict[tuple[int, int], float] = {}
        self.uploads: Uploads = {}
        self._due_s: dict[tuple[int, int], float] = {}

    def sequence(self, system_id: int) -> Sequence:
        """Return the frame counter of a vehicle on this link."""
        found = self.sequences.get(system_id)
        if found is None:
            found = self.sequences[system_id] = Sequence(system_id, AUTOPILOT_COMPONENT)
        return found

    def interval_s(self, system_id: int, message_id: int) -> float:
        """Return the interval of a stream, 0 when it is off."""
        return self._intervals_s.get((system_id, message_id), STREAMS[message_id][1])

    def set_interval(self, system_id: int, message_id: int, interval_s: float | None) -> None:
        """Set the interval of a stream; 0 turns it off, None restores the default."""
        key = (system_id, message_id)
        self._due_s.pop(key, None)
        if interval_s is None:
            self._intervals_s.pop(key, None)
        else:
            self._intervals_s[key] = max(interval_s, MIN_INTERVAL_S) if interval_s > 0.0 else 0.0

    def due(self, vehicle: Vehicle, wall_time_s: float) -> list[bytes]:
        """Return the frames of a vehicle that are due now, what its pilot has to say first."""
        system_id = vehicle.system_id
        sequence = self.sequence(system_id)
        frames = [sequence.encode(message) for message in vehicle.pilot.outbox]
        again = ask_again(vehicle, self.uploads, wall_time_s)
        if again is not None:
            frames.append(sequence.encode(again))
        for message_id, (builder, _) in STREAMS.items():
            key = (system_id, message_id)
            due_s = self._due_s.get(key, wall_time_s)
            if wall_time_s < due_s:
                continue
            interval_s = self.interval_s(system_id, message_id)
            if interval_s == 0.0:
                continue
            # Keep the rhythm; after a stall start a new one.
            following_s = due_s + interval_s
            self._due_s[key] = (
                following_s if following_s > wall_time_s else wall_time_s + interval_s
            )
            frames.append(sequence.encode(builder(vehicle)))
        return frames
