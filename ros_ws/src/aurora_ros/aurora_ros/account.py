# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Account`: what a bridge was told and what it published, as digests that two can compare.

Whoever writes packets in another's name reaches one node and not the next. So the bridge keeps an
account of what it did, the executor one of what it asked for and heard, and at the end of a run
they have to be alike.
"""

from __future__ import annotations

import hashlib
import json
from array import array
from typing import Any

from aurora_core.errors import ExecutionError
from aurora_msgs.msg import GroundCommand, UavCommand
from aurora_msgs.srv import LoadGround, LoadUav, RunDigest
from aurora_ros.writers import COMPONENT

_LENGTH_BYTES = 4


class Account:
    """One bridge in one run; ticks are added in order from 0.

    Attributes:
        last_tick: That was added, -1 before the first.

    Args:
        load: The request that the bridge is loaded with.
    """

    def __init__(self, load: LoadGround.Request | LoadUav.Request) -> None:
        fields = [_plain(getattr(load, name)) for name in load.get_fields_and_field_types()]
        self._load_sha256 = hashlib.sha256(_json(fields)).hexdigest()
        self._commands = hashlib.sha256()
        self._states = hashlib.sha256()
        self.last_tick = -1

    @property
    def states_sha256(self) -> str:
        """Digest of the state rows of all ticks, float64 row by row, one tick after the other."""
        return self._states.hexdigest()

    def add(self, told: bytes, rows: memoryview | array[float]) -> None:
        """Take in the next tick.

        Args:
            told: What `told` gives of its command; empty for tick 0, which has none.
            rows: The values (float64) of the state at it, row by row.
        """
        self._commands.update(len(told).to_bytes(_LENGTH_BYTES, 'little') + told)
        self._states.update(rows)
        self.last_tick += 1

    def fill(self, response: RunDigest.Response) -> None:
        """Write this account into an answer."""
        response.last_tick = max(0, self.last_tick)
        response.load_sha256 = self._load_sha256
        response.commands_sha256 = self._commands.hexdigest()
        response.states_sha256 = self.states_sha256

    def compare(self, answer: RunDigest.Response, bridge: str) -> None:
        """Hold the executor's account against the bridge's.

        Args:
            answer: The bridge's.
            bridge: Its name.

        Raises:
            ExecutionError: They differ: somebody else wrote to one of the two.
        """
        own = RunDigest.Response()
        self.fill(own)
        if answer.load_sha256 != own.load_sha256:
            what = f'{bridge} was loaded with something else than the executor asked for'
        elif answer.last_tick != own.last_tick:
            what = f'{bridge} went on to tick {answer.last_tick}, the executor to {own.last_tick}'
        elif answer.commands_sha256 != own.commands_sha256:
            what = f'{bridge} applied other commands than the executor sent'
        elif answer.states_sha256 != own.states_sha256:
            what = f'the executor heard other states than {bridge} published'
        else:
            return
        raise tampered(what)


def tampered(what: str) -> ExecutionError:
    """Return the error of a run in which somebody wrote in another node's name."""
    return ExecutionError(
        f'{what}: tampered with?',
        component=COMPONENT,
        hint='use a network that nobody else reaches: up --isolated, or another ROS_DOMAIN_ID',
    )


def told(command: GroundCommand | UavCommand) -> bytes:
    """Return what a command tells a bridge, without its stamp; empty when it tells nothing."""
    if isinstance(command, UavCommand):
        return bytes(command.data)
    if not command.agent:
        return b''
    parts = (command.agent, command.kind, command.value, command.value2, command.text)
    return _json([_plain(part) for part in parts])


def _plain(value: Any) -> Any:
    return value if isinstance(value, (str, int, float)) else list(value)


def _json(value: Any) -> bytes:
    # The shortest text of a float that reads back as the same: the wire changes no bit of it.
    return json.dumps(value).encode()
