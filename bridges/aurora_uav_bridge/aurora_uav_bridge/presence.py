# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ask outside of a run whether the simulator is there."""

from __future__ import annotations

from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_bridge.errors import SimulatorSilentError
from aurora_uav_bridge.lockstep_link import OWN_COMPONENT, OWN_SYSTEM
from aurora_uav_bridge.transports import Transport
from aurora_uav_sim.wire import Decoder, Sequence, split

_REPEAT_S = 0.05
_MAX_SEQUENCE = 2**32 - 1


class Presence:
    """Pings the simulator, beside any lockstep session and without disturbing it.

    Args:
        transport: Way to the simulator, for this purpose alone; closed by `close`.
    """

    def __init__(self, transport: Transport) -> None:
        self._transport = transport
        self._sequence = Sequence(OWN_SYSTEM, OWN_COMPONENT)
        self._decoder = Decoder()
        self._number = 0

    def check(self, limit_s: float) -> None:
        """Return once the simulator has answered.

        Raises:
            SimulatorSilentError: It did not within the limit.
        """
        transport = self._transport
        self._number = self._number % _MAX_SEQUENCE + 1
        deadline_s = transport.steady_time_s() + limit_s
        while (now_s := transport.steady_time_s()) < deadline_s:
            message = mavlink.MAVLink_ping_message(0, self._number, 0, 0)
            transport.send(self._sequence.encode(message))
            if self._answered(min(now_s + _REPEAT_S, deadline_s)):
                return
        raise SimulatorSilentError(
            f'{transport.peer} did not answer a ping within {limit_s:g} s',
            hint='is uav_sim running in this ROS_DOMAIN_ID? see its log',
        )

    def close(self) -> None:
        """Free the transport; safe to call twice."""
        self._transport.close()

    def _answered(self, until_s: float) -> bool:
        """Take what arrives, telemetry too, until the answer is among it or the time is over."""
        while (left_s := until_s - self._transport.steady_time_s()) > 0.0:
            datagram = self._transport.receive(left_s)
            for frame in split(datagram or b''):
                message = self._decoder.decode(frame)
                if message is None or message.get_type() != 'PING':
                    continue
                if message.seq == self._number and message.target_system == OWN_SYSTEM:
                    return True
        return False
