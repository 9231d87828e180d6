# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `sumo_bridge` node: `SumoClient` as a participant of the lockstep."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from aurora_core.ports.simulators import FloatArray
from aurora_core.trace.layout import UAV_WIDTH
from aurora_core.trace.messages import read_ground_commands, read_rows
from aurora_msgs.msg import GroundCommand, UavState
from aurora_msgs.srv import LoadGround
from aurora_ros import interfaces as on
from aurora_ros.bridge import BridgeInterfaces, LockstepBridge
from aurora_ros.conversions.loads import ground_load
from aurora_ros.main import run_node
from aurora_ros.parameters import declare
from aurora_sumo_bridge.sumo_client import SumoClient


@dataclass(frozen=True, kw_only=True)
class SumoBridgeSettings:
    """See `config/sumo_bridge.param.yaml`."""

    autostart: bool
    shows_uavs: bool


class SumoBridgeNode(LockstepBridge):
    """Ground traffic."""

    def __init__(self) -> None:
        super().__init__(
            'sumo_bridge',
            BridgeInterfaces(
                load=on.GROUND_LOAD,
                digest=on.GROUND_DIGEST,
                command=on.GROUND_COMMAND,
                state=on.GROUND_STATE,
            ),
        )
        settings = declare(self, 'sumo_bridge', SumoBridgeSettings)
        self.wants_autostart = settings.autostart
        self._shows_uavs = settings.shows_uavs

    @cached_property
    def _client(self) -> SumoClient:
        return SumoClient()

    def configure(self) -> None:
        """Create the endpoints, one more where UAVs are to be shown."""
        super().configure()
        if self._shows_uavs:
            self.subscription(on.UAV_STATE, self._on_uav_state)

    def _on_uav_state(self, message: UavState) -> None:
        """Show where the UAVs are; no tick waits for it, and a damaged state ends no run here."""
        if self.is_in_run(message.run_number) and len(message.data) % UAV_WIDTH == 0:
            self._client.show_uavs(read_rows(message, UAV_WIDTH))

    def open_run(self, request: LoadGround.Request) -> None:
        """Load map and agents."""
        self._client.load(ground_load(request))

    def state(self) -> FloatArray:
        """Return the spawned state."""
        return self._client.state()

    def advance(self, tick: int, command: GroundCommand) -> FloatArray:
        """Advance the traffic by one tick."""
        return self._client.advance(tick, read_ground_commands(command))

    def cleanup(self) -> None:
        """Free the simulation."""
        self._client.close()


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(SumoBridgeNode)
