# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""An answer is about what was asked, or it is not believed."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from rclpy.callback_groups import ReentrantCallbackGroup

from aurora_core.document import Document, first_difference
from aurora_core.errors import ExecutionError
from aurora_msgs.msg import Verdict
from aurora_ros import interfaces as on
from aurora_ros.interfaces import Call
from aurora_ros.matching import wait_until
from aurora_ros.node import AuroraNode
from aurora_ros.writers import second_one, strangers

_SHOWN = 60
_KEPT = 8
# The monitor publishes before it answers.
_PUBLISHED_S = 5.0


def hold(call: Call, **pairs: tuple[object, object]) -> None:
    """Hold an answer against what was asked.

    Args:
        call: What was called.
        pairs: What was asked and what was answered, by name.

    Raises:
        ExecutionError: The answer is about something else; the node that gave it is named.
    """
    for name, (asked, answered) in pairs.items():
        if asked != answered:
            raise ExecutionError(
                f'{call.server} answered {call.name} with another {name.replace("_", " ")}: '
                f'{_told(asked, answered)}',
                component=call.server,
                hint=f'see the log of {call.server}, and who else serves /{on.NAMESPACE}/'
                f'{call.name} in this ROS_DOMAIN_ID',
            )


def _told(asked: object, answered: object) -> str:
    path = ''
    if isinstance(asked, Document) and isinstance(answered, Document):
        found = first_difference(asked, answered)
        if found is not None:
            path, asked, answered = f'{found[0]} ', found[1], found[2]
    return f'{path}{_short(answered)} instead of {_short(asked)}'


def _short(value: object) -> str:
    text = repr(value) if isinstance(value, str) else str(value)
    return text if len(text) <= _SHOWN else f'{text[:_SHOWN]}...'


class PublishedVerdicts:
    """What the monitor publishes about bags: an answer in its name has to say the same.

    Args:
        node: Its executor must be spinning in another thread than the caller's.
    """

    def __init__(self, node: AuroraNode) -> None:
        self._node = node
        self._heard: deque[Verdict] = deque(maxlen=_KEPT)
        node.subscription(on.VERDICT, self._on_verdict, group=ReentrantCallbackGroup())

    def last(self, run_id: str, iteration: int, guard: Callable[[], None]) -> Verdict:
        """Return the last one of a run, waiting a little for it.

        Args:
            run_id: Of the run.
            iteration: Repair iteration.
            guard: Asked meanwhile; raises when waiting makes no sense.

        Raises:
            ExecutionError: There is none, or somebody else publishes as well.
        """

        def heard() -> list[Verdict]:
            guard()
            wanted = (run_id, iteration)
            return [v for v in tuple(self._heard) if (v.run_id, v.iteration) == wanted]

        wait_until(lambda: bool(heard()), _PUBLISHED_S)
        for stranger in strangers(self._node, [on.VERDICT], on.VERDICT.writers):
            raise second_one(stranger)
        found = heard()
        if not found:
            raise ExecutionError(
                f'{on.VERIFY.server} answered {on.VERIFY.name}, but published no verdict',
                component=on.VERIFY.server,
                hint=f'see the log of {on.VERIFY.server}',
            )
        return found[-1]

    def _on_verdict(self, message: Verdict) -> None:
        if message.source == Verdict.BAG:
            self._heard.append(message)
