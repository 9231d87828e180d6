# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What can go wrong between the bridge and the simulator."""

from __future__ import annotations

from aurora_core.errors import AirSimulatorError


class SimulatorSilentError(AirSimulatorError):
    """The simulator did not answer within the time limit."""

    default_code = 421
    default_component = 'uav_sim'


class CommandRefusedError(AirSimulatorError):
    """The simulator answered a command with something else than ACCEPTED."""

    default_code = 422
    default_component = 'uav_sim'


class SimulatorHeldError(CommandRefusedError):
    """The simulator is in lockstep with another client, which still speaks."""

    default_code = 425


class CommandRangeError(AirSimulatorError):
    """A number that must not reach the simulator: not finite or out of range."""

    default_code = 423


class SessionLostError(AirSimulatorError):
    """The simulator restarted or another client took it over."""

    default_code = 424
    default_component = 'uav_sim'
