# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What client and simulator agree on beyond standard MAVLink: ports and the lockstep commands.

Lockstep in five sentences. `CMD_LOCKSTEP` opens a session with a nonce: the vehicles of the
fleet stand reset at tick 0 and simulated time stands still. At tick 0 `DO_SET_HOME`, `CMD_WIND`,
`CMD_SEED` and a reboot may prepare each vehicle; arming, take-off, mode and landing commands act
between ticks. For tick k the client sends one SET_POSITION_TARGET_LOCAL_NED per vehicle with
time_boot_ms = k and `CMD_STEP` with k, in one datagram. The simulator answers, in one datagram,
with LOCAL_POSITION_NED, ATTITUDE_QUATERNION and NAMED_VALUE_INT per vehicle, all with
time_boot_ms = k, and an acknowledgement whose result_param2 is k; asked again for k it answers
again and does not move. If a set-point is missing it answers TEMPORARILY_REJECTED and waits.

Whoever opened a session owns it, by address and by system and component id. Until the owner leaves
or has been silent for some seconds, anybody else who enters is answered TEMPORARILY_REJECTED, with
the owner's address as text, and so is anybody else's command. The owner speaks with every tick;
while a run stands still its heartbeats are enough.

Acknowledgements to the owner carry the nonce in result_param2, except those of steps.

Every frame of the session must be newer, by MAVLink sequence number, than the last one accepted,
so a duplicate or a late frame cannot act twice; a repetition is a new frame.
"""

from __future__ import annotations

from pymavlink.dialects.v20 import common as mavlink

# COMMAND_LONG. Step: param1 = tick.
CMD_STEP = int(mavlink.MAV_CMD_USER_1)
# Lockstep: param1 = 1 enter, 0 leave; param2 = nonce; param3 = tick length in us; param4 to
# param7 = system ids of the fleet, 16 per number: bit b of param(4 + n) is system id 16 n + b + 1.
CMD_LOCKSTEP = int(mavlink.MAV_CMD_USER_2)
# Wind: param1 to param3 = mean north, east, down in m/s; param4 = gust amplitude in m/s.
CMD_WIND = int(mavlink.MAV_CMD_USER_3)
# Seed: param1 to param4 = 16 bits each, lowest first.
CMD_SEED = int(mavlink.MAV_CMD_USER_4)

# A float32 holds every integer up to here.
MAX_NONCE = 2**24 - 1
MAX_TICK = 2**24 - 1
MAX_SYSTEM_ID = 64
MAX_FLEET = 20

# A session whose owner was silent for so long may be taken over. It speaks with every tick, and
# twice a second while its run stands still.
OWNER_SILENCE_S = 3.0

# Magic number of MAV_CMD_COMPONENT_ARM_DISARM param2. Source: MAVLink common.xml.
FORCE_ARM_MAGIC = 21196

AUTOPILOT_COMPONENT = int(mavlink.MAV_COMP_ID_AUTOPILOT1)

# SET_POSITION_TARGET_LOCAL_NED: position, velocity and yaw are given, the rest is ignored.
TYPE_MASK_POSITION_VELOCITY_YAW = 0x9C0
IGNORE_XY = 0x003
IGNORE_Z = 0x004
IGNORE_VXY = 0x018
IGNORE_VZ = 0x020
IGNORE_YAW = 0x400
# Acceleration and yaw rate must be ignored (bits set), force must not be meant (bit 9 clear).
MUST_IGNORE = 0x9C0
FORCE_BIT = 0x200

# Base of the MAVLink ports.
_PORT_BASE = 7600
_PORTS_PER_DOMAIN = 250
_PORTS_PER_SYSTEM = 50
_LAST_DOMAIN = 231


def mavlink_port(domain_id: int, first_system_id: int = 1) -> int:
    """Return the UDP port of a simulator process.

    ROS 2 gives every domain a block of 250 ports from 7400 on, of which DDS uses the lower ones
    (two per participant); this is the top of the same block, so what keeps domains apart keeps
    their simulators apart too.

    Args:
        domain_id: ROS_DOMAIN_ID, 0 to 231.
        first_system_id: Smallest MAVLink system id that the process serves, 1 to 250.

    Raises:
        ValueError: The domain or the system id is out of range.

    Source: DDSI-RTPS 2.2, 9.6.1 (port mapping: PB 7400, DG 250, PG 2).
    """
    if not 0 <= domain_id <= _LAST_DOMAIN:
        raise ValueError(f'expected a ROS domain from 0 to {_LAST_DOMAIN}, found {domain_id}')
    if not 1 <= first_system_id <= 250:
        raise ValueError(f'expected a MAVLink system id from 1 to 250, found {first_system_id}')
    offset = (first_system_id - 1) % _PORTS_PER_SYSTEM
    return _PORT_BASE + _PORTS_PER_DOMAIN * domain_id + offset


def fleet_masks(system_ids: tuple[int, ...]) -> tuple[float, float, float, float]:
    """Return param4 to param7 of `CMD_LOCKSTEP` for these system ids (1 to 64)."""
    bits = 0
    for system_id in system_ids:
        bits |= 1 << (system_id - 1)
    return (
        float(bits & 0xFFFF),
        float(bits >> 16 & 0xFFFF),
        float(bits >> 32 & 0xFFFF),
        float(bits >> 48 & 0xFFFF),
    )


def fleet_from_masks(masks: tuple[int, ...]) -> tuple[int, ...]:
    """Return the system ids, ascending, of param4 to param7."""
    return tuple(
        16 * word + bit + 1
        for word, mask in enumerate(masks)
        for bit in range(16)
        if mask >> bit & 1
    )


def seed_words(seed: int) -> tuple[float, float, float, float]:
    """Return param1 to param4 of `CMD_SEED` for a seed of 64 bits."""
    return (
        float(seed & 0xFFFF),
        float(seed >> 16 & 0xFFFF),
        float(seed >> 32 & 0xFFFF),
        float(seed >> 48 & 0xFFFF),
    )


# NAMED_VALUE_INT of a tick: low 16 bits of the session's nonce above these.
STATUS_NAME = b'AURSTATUS'
_ARMED_BIT = 0x1
_LANDED_BIT = 0x2
_MODE_SHIFT = 4
_MODE_MASK = 0xF
_NONCE_SHIFT = 15


def pack_status(nonce: int, mode: int, armed: bool, landed: bool) -> int:
    """Return the value of a tick's NAMED_VALUE_INT.

    Args:
        nonce: Of the session; tells its states from those of an older one.
        mode: `UavMode`, 0 to 15.
        armed: Motors may turn.
        landed: On the ground.
    """
    bits = (_ARMED_BIT if armed else 0) | (_LANDED_BIT if landed else 0)
    return (nonce & 0xFFFF) << _NONCE_SHIFT | mode << _MODE_SHIFT | bits


def unpack_status(value: int, nonce: int) -> tuple[int, bool, bool] | None:
    """Return (mode, armed, landed), or None when the value is of another session."""
    if value >> _NONCE_SHIFT != nonce & 0xFFFF:
        return None
    return value >> _MODE_SHIFT & _MODE_MASK, bool(value & _ARMED_BIT), bool(value & _LANDED_BIT)
