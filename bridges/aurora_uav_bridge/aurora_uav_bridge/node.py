# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `uav_bridge` node: `MavlinkClient` as a participant of the lockstep."""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.errors import AirSimulatorError, ConfigError
from aurora_core.ports.simulators import FloatArray
from aurora_core.trace.layout import UAV_COMMAND_WIDTH
from aurora_msgs.msg import UavCommand
from aurora_msgs.srv import LoadUav
from aurora_ros import interfaces as on
from aurora_ros.bridge import BridgeInterfaces, LockstepBridge
from aurora_ros.conversions.loads import air_load
from aurora_ros.conversions.states import unpack
from aurora_ros.main import run_node
from aurora_ros.parameters import declare, require_positive
from aurora_uav_bridge.mavlink_client import MavlinkClient
from aurora_uav_bridge.presence import Presence
from aurora_uav_bridge.transports import SignedTransport, Transport, UdpTransport
from aurora_uav_sim.protocol import mavlink_port
from aurora_uav_sim.signing import KEY_FILE_VARIABLE, KeyFileError, signer_from


@dataclass(frozen=True, kw_only=True)
class UavBridgeSettings:
    """See `config/uav_bridge.param.yaml`."""

    autostart: bool
    host: str
    port: int
    first_system_id: int
    answer_limit_s: float
    presence_limit_s: float

    def __post_init__(self) -> None:
        require_positive(self, 'first_system_id', 'answer_limit_s', 'presence_limit_s')


class UavBridgeNode(LockstepBridge):
    """Flying vehicles."""

    def __init__(self) -> None:
        super().__init__(
            'uav_bridge',
            BridgeInterfaces(
                load=on.UAV_LOAD,
                digest=on.UAV_DIGEST,
                command=on.UAV_COMMAND,
                state=on.UAV_STATE,
            ),
        )
        self._settings = declare(self, 'uav_bridge', UavBridgeSettings)
        self.wants_autostart = self._settings.autostart
        self._client: MavlinkClient | None = None
        self._presence: Presence | None = None
        try:
            self._signer = signer_from()
        except KeyFileError as err:
            raise ConfigError(str(err), hint=f'unset {KEY_FILE_VARIABLE}, or mend it') from err

    def check_presence(self) -> None:
        """Answer a roll call for the simulator too; in a run each tick asks it anyway.

        Raises:
            SimulatorSilentError: The simulator does not answer.
        """
        super().check_presence()
        if self._client is not None:
            return
        if self._presence is None:
            self._presence = Presence(self._transport())
        self._presence.check(self._settings.presence_limit_s)

    def cleanup(self) -> None:
        """Free the socket."""
        presence, self._presence = self._presence, None
        if presence is not None:
            presence.close()

    def open_run(self, request: LoadUav.Request) -> None:
        """Open a lockstep session with the simulator."""
        self.close_run()
        self._client = MavlinkClient(self._transport(), timeout_s=self._settings.answer_limit_s)
        self._client.load(air_load(request))

    def state(self) -> FloatArray:
        """Return the spawned state."""
        return self._loaded.state()

    def advance(self, tick: int, command: UavCommand) -> FloatArray:
        """Advance the vehicles by one tick."""
        return self._loaded.advance(tick, unpack(command.data, UAV_COMMAND_WIDTH, 'UAV command'))

    def stand_by(self) -> None:
        """Keep the session while the run stands still."""
        if self._client is not None:
            self._client.stand_by()

    def close_run(self) -> None:
        """Leave the session, so that the simulator runs in real time again."""
        client, self._client = self._client, None
        if client is not None:
            client.close()

    def _transport(self) -> Transport:
        settings = self._settings
        port = settings.port or mavlink_port(
            self.context.get_domain_id(), settings.first_system_id
        )
        plain = UdpTransport(port, settings.host)
        return plain if self._signer is None else SignedTransport(plain, self._signer)

    @property
    def _loaded(self) -> MavlinkClient:
        if self._client is None:
            raise AirSimulatorError('no vehicle is loaded', hint='call uav/load first')
        return self._client


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(UavBridgeNode)
