# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The mission protocol: plans of items go up and down one by one, and are taken whole.

Source: MAVLink guide, mission protocol.
"""

from __future__ import annotations

from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.plan_items import ACCEPTED, Item, Refusal, item_of
from aurora_uav_sim.vehicle import Vehicle

_MISSION = int(mavlink.MAV_MISSION_TYPE_MISSION)
_FENCE = int(mavlink.MAV_MISSION_TYPE_FENCE)
_ALL = int(mavlink.MAV_MISSION_TYPE_ALL)
MAX_ITEMS = 1000
# An item that does not come is asked for again, so often, then the upload ends.
_AGAIN_S = 1.0
_TRIES = 5

Sender = tuple[int, int]


class Upload:
    """A plan on its way to one vehicle, over one link.

    Args:
        sender: System and component id of who sends it.
        mission_type: MAV_MISSION_TYPE.
        count: Items that were announced.
    """

    def __init__(self, sender: Sender, mission_type: int, count: int) -> None:
        self.sender = sender
        self.mission_type = mission_type
        self.count = count
        self.items: list[Item] = []
        self._due_s: float | None = None
        self._tries = 0

    def request(self) -> Any:
        """The request for the next item."""
        self._due_s = None
        return mavlink.MAVLink_mission_request_int_message(
            *self.sender, len(self.items), self.mission_type
        )

    def take(self, item: Item) -> None:
        """Keep the item that was asked for."""
        self.items.append(item)
        self._tries = 0

    def overdue(self, wall_time_s: float) -> bool:
        """Return whether the item has to be asked for again."""
        if self._due_s is None:
            self._due_s = wall_time_s + _AGAIN_S
        if wall_time_s < self._due_s:
            return False
        self._tries += 1
        return True

    @property
    def given_up(self) -> bool:
        """Asked often enough."""
        return self._tries > _TRIES


Uploads = dict[int, Upload]


def answer(
    m: Any, kind: str, sender: Sender, vehicle: Vehicle, uploads: Uploads, may_change: bool
) -> list[Any]:
    """Return the answers to a message of the protocol (`KINDS`).

    Args:
        m: pymavlink message.
        kind: Its name.
        sender: System and component id of the sender.
        vehicle: Whose plan it is about.
        uploads: Those under way over this link, by system id.
        may_change: The sender may change plans.
    """
    pilot = vehicle.pilot
    mission_type = getattr(m, 'mission_type', _MISSION)
    if kind == 'MISSION_ACK':
        # The end of a download, or the end that the sender put to its upload.
        uploads.pop(vehicle.system_id, None)
        return []
    if kind == 'MISSION_SET_CURRENT':
        if may_change and pilot.active:
            pilot.select_item(m.seq)
        return [pilot.mission_current()]
    if kind == 'MISSION_REQUEST_LIST':
        count = len(_items(vehicle, mission_type))
        return [mavlink.MAVLink_mission_count_message(*sender, count, mission_type)]
    if kind in ('MISSION_REQUEST_INT', 'MISSION_REQUEST'):
        items = _items(vehicle, mission_type)
        if m.seq >= len(items):
            return [_ack(sender, mavlink.MAV_MISSION_INVALID_SEQUENCE, mission_type)]
        current = int(mission_type == _MISSION and m.seq == pilot.mission.current)
        return [_message(items[m.seq], sender, m.seq, current, mission_type)]
    if not may_change or not pilot.active:
        return [_ack(sender, mavlink.MAV_MISSION_DENIED, mission_type)]
    if kind in ('MISSION_ITEM_INT', 'MISSION_ITEM'):
        return _take_item(m, sender, vehicle, uploads)
    if kind == 'MISSION_CLEAR_ALL':
        return [_clear(sender, vehicle, mission_type)]
    return [_begin(m.count, sender, vehicle, uploads, mission_type)]


KINDS = frozenset(
    {
        'MISSION_ACK',
        'MISSION_CLEAR_ALL',
        'MISSION_COUNT',
        'MISSION_ITEM',
        'MISSION_ITEM_INT',
        'MISSION_REQUEST',
        'MISSION_REQUEST_INT',
        'MISSION_REQUEST_LIST',
        'MISSION_SET_CURRENT',
    }
)


def ask_again(vehicle: Vehicle, uploads: Uploads, wall_time_s: float) -> Any | None:
    """Return what an upload that stands still needs: its request again, or its end."""
    upload = uploads.get(vehicle.system_id)
    if upload is None or not upload.overdue(wall_time_s):
        return None
    if upload.given_up:
        del uploads[vehicle.system_id]
        cancelled = mavlink.MAV_MISSION_OPERATION_CANCELLED
        return _ack(upload.sender, cancelled, upload.mission_type)
    return upload.request()


def _items(vehicle: Vehicle, mission_type: int) -> tuple[Item, ...]:
    if mission_type == _MISSION:
        return vehicle.pilot.mission.items
    return vehicle.pilot.fence_items if mission_type == _FENCE else ()


def _ack(sender: Sender, result: int, mission_type: int) -> Any:
    return mavlink.MAVLink_mission_ack_message(*sender, result, mission_type)


def _message(item: Item, sender: Sender, seq: int, current: int, mission_type: int) -> Any:
    return mavlink.MAVLink_mission_item_int_message(
        *sender, seq, item.frame, item.command, current, item.autocontinue,
        item.p1, item.p2, item.p3, item.p4, item.x, item.y, item.z, mission_type,
    )  # fmt: skip


def _take_plan(vehicle: Vehicle, mission_type: int, items: tuple[Item, ...]) -> int:
    """Hand a whole plan to the pilot and say the reason when it is refused."""
    pilot = vehicle.pilot
    take = pilot.take_mission if mission_type == _MISSION else pilot.take_fence
    refusal: Refusal | None = take(items)
    if refusal is None:
        return ACCEPTED
    pilot.say(refusal.reason, mavlink.MAV_SEVERITY_WARNING)
    return refusal.result


def _clear(sender: Sender, vehicle: Vehicle, mission_type: int) -> Any:
    if mission_type in (_MISSION, _ALL):
        _take_plan(vehicle, _MISSION, ())
    if mission_type in (_FENCE, _ALL):
        _take_plan(vehicle, _FENCE, ())
    return _ack(sender, ACCEPTED, mission_type)


def _begin(
    count: int, sender: Sender, vehicle: Vehicle, uploads: Uploads, mission_type: int
) -> Any:
    if mission_type not in (_MISSION, _FENCE):
        return _ack(sender, mavlink.MAV_MISSION_UNSUPPORTED, mission_type)
    if count > MAX_ITEMS:
        return _ack(sender, mavlink.MAV_MISSION_NO_SPACE, mission_type)
    if count == 0:
        return _ack(sender, _take_plan(vehicle, mission_type, ()), mission_type)
    uploads[vehicle.system_id] = Upload(sender, mission_type, count)
    return uploads[vehicle.system_id].request()


def _take_item(m: Any, sender: Sender, vehicle: Vehicle, uploads: Uploads) -> list[Any]:
    upload = uploads.get(vehicle.system_id)
    if upload is None or upload.sender != sender:
        # A repetition of the last item: the acknowledgement was lost, and so is the plan's state.
        return [_ack(sender, mavlink.MAV_MISSION_ERROR, m.mission_type)]
    if m.seq != len(upload.items):
        # Late or twice: ask for the one that is missing.
        return [upload.request()]
    upload.take(item_of(m))
    if len(upload.items) < upload.count:
        return [upload.request()]
    del uploads[vehicle.system_id]
    result = _take_plan(vehicle, upload.mission_type, tuple(upload.items))
    return [_ack(sender, result, upload.mission_type)]
