# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Commands that exist only in lockstep: who flies in a session, and how it is prepared."""

from __future__ import annotations

from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.autopilot import ACCEPTED, Answer, Result
from aurora_uav_sim.commands import Request, home_of, whole
from aurora_uav_sim.lockstep import MAX_TICK_US, MIN_TICK_US
from aurora_uav_sim.protocol import CMD_SEED, CMD_WIND, MAX_FLEET, fleet_from_masks
from aurora_uav_sim.vehicle import Vehicle
from aurora_uav_sim.wind import wind_stream

_MAX_WIND_MPS = 50.0
_SET_HOME = int(mavlink.MAV_CMD_DO_SET_HOME)
_REBOOT = int(mavlink.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN)

# Only at tick 0.
PREPARATIONS = frozenset({_SET_HOME, _REBOOT, CMD_WIND, CMD_SEED})


def read_session(request: Request) -> tuple[int, tuple[int, ...]] | Answer:
    """Return (tick length in us, system ids) of a request to enter, or the refusal."""
    tick_us = whole(request.p3)
    if tick_us is None or not MIN_TICK_US <= tick_us <= MAX_TICK_US:
        return Answer(Result.DENIED, 'Lockstep denied: tick length')
    masks = [whole(p) for p in (request.p4, request.latitude_deg, request.longitude_deg)]
    masks.append(whole(request.p7))
    if any(m is None or not 0 <= m <= 0xFFFF for m in masks):
        return Answer(Result.DENIED, 'Lockstep denied: fleet')
    system_ids = fleet_from_masks(tuple(m for m in masks if m is not None))
    if not 1 <= len(system_ids) <= MAX_FLEET:
        return Answer(Result.DENIED, 'Lockstep denied: fleet size')
    return tick_us, system_ids


def prepare(vehicle: Vehicle, request: Request) -> Answer:
    """Set up a vehicle at tick 0; each of these may be repeated."""
    p1, p2, p3, p4 = request.p1, request.p2, request.p3, request.p4
    if request.command == _REBOOT:
        if p1 != 1.0:
            return Answer(Result.UNSUPPORTED, 'Only reboot')
        vehicle.restart()
        return ACCEPTED
    if request.command == _SET_HOME:
        place = home_of(request)
        if place is None:
            return Answer(Result.DENIED, 'Home denied: not a place')
        vehicle.spawn(*place)
        return ACCEPTED
    if request.command == CMD_WIND:
        limit = _MAX_WIND_MPS
        if not (all(-limit <= p <= limit for p in (p1, p2, p3)) and 0.0 <= p4 <= limit):
            return Answer(Result.DENIED, 'Wind denied: out of range')
        vehicle.autopilot.wind.set(p2, p1, -p3, p4)
        return ACCEPTED
    words = [whole(p) for p in (p1, p2, p3, p4)]
    seed = 0
    for shift, word in enumerate(words):
        if word is None or not 0 <= word <= 0xFFFF:
            return Answer(Result.DENIED, 'Seed denied: not 16-bit words')
        seed |= word << (16 * shift)
    vehicle.autopilot.wind.seed(wind_stream(seed, vehicle.system_id))
    return ACCEPTED
