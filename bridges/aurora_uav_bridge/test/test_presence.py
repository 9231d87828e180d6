# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Pings: answered beside a session, and a simulator that is gone is named."""

from __future__ import annotations

from collections.abc import Hashable

import numpy as np
import pytest

from aurora_core.ports.simulators import AirLoad, UavHome
from aurora_uav_bridge.errors import SimulatorSilentError
from aurora_uav_bridge.mavlink_client import MavlinkClient
from aurora_uav_bridge.presence import Presence
from aurora_uav_bridge.testing.lossy_transport import LossyTransport
from aurora_uav_bridge.transports import LoopbackTransport
from aurora_uav_sim.mavlink_server import SimServer


class Nobody:
    def handle(self, datagram: bytes, source: Hashable) -> list[bytes]:
        return []


def test_a_simulator_that_lives_answers_again_and_again() -> None:
    presence = Presence(LoopbackTransport(SimServer()))
    for _ in range(3):
        presence.check(1.0)
    presence.close()


def test_a_bad_link_does_not_make_it_absent() -> None:
    link = LossyTransport(LoopbackTransport(SimServer()), np.random.default_rng(1))
    presence = Presence(link)
    for _ in range(50):
        presence.check(2.0)


def test_a_session_of_another_client_goes_on_undisturbed() -> None:
    server = SimServer()
    client = MavlinkClient(LoopbackTransport(server))
    home = UavHome(uav_id='uav1', system_id=1, x_m=0.0, y_m=0.0, yaw_enu_rad=0.0)
    client.load(
        AirLoad(
            dt_s=0.05, seed=1, homes=(home,), origin_lat_deg=48.0, origin_lon_deg=11.0,
            origin_alt_m=0.0, wind_mean_east_mps=0.0, wind_mean_north_mps=0.0, wind_gust_mps=0.0,
        )
    )  # fmt: skip
    before = client.state()
    Presence(LoopbackTransport(server)).check(1.0)
    assert server.in_lockstep
    assert (client.state() == before).all()
    client.close()


def test_a_simulator_that_is_gone_is_named() -> None:
    with pytest.raises(SimulatorSilentError, match='did not answer a ping within 1 s') as caught:
        Presence(LoopbackTransport(Nobody())).check(1.0)
    assert caught.value.component == 'uav_sim'
