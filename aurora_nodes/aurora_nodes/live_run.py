# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`LiveRun`: the bytes of one run as an observer hears them, and is everything there? No ROS.

While the run goes on a message costs one list entry; it is looked into when the run has ended.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rosbags.serde import SerdeError

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.bag_content import BagContent, StoredMessage, content_of
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.trace import Integrity
from aurora_nodes.recording import Belonging
from aurora_ros import cdr as wire

# Documents say their run id, everything else its run number; these come once per tick.
WATCHED: dict[str, Belonging] = {
    messages.AGSG: Belonging.BY_ID,
    messages.ROSTER: Belonging.BY_ID,
    messages.WORLD: Belonging.BY_ID,
    messages.GROUND_STATE: Belonging.EVERY_TICK,
    messages.UAV_STATE: Belonging.EVERY_TICK,
    messages.GROUND_COMMAND: Belonging.EVERY_TICK,
    messages.UAV_COMMAND: Belonging.EVERY_TICK,
    messages.COMM: Belonging.AT_TICK,
    messages.SENSING: Belonging.AT_TICK,
    messages.EVENTS: Belonging.AT_TICK,
}
_EVERY_TICK = [topic for topic, kind in WATCHED.items() if kind is Belonging.EVERY_TICK]


@dataclass(frozen=True, slots=True, kw_only=True)
class RunTotals:
    """What was sent in a run; see `RunEnd.msg`.

    Attributes:
        counts: Messages by topic.
        replayed: It was no run, but a recording of one.
        damage: Known damage of a recording that is replayed.
    """

    run_number: int
    run_id: str
    iteration: int
    counts: Mapping[str, int]
    replayed: bool = False
    damage: tuple[tuple[Integrity, str], ...] = ()


class LiveRun:
    """The messages of one run.

    Args:
        run_number: Of everything on the tick path.
    """

    def __init__(self, run_number: int) -> None:
        self.run_number = run_number
        self._kept: dict[str, list[bytes]] = {topic: [] for topic in WATCHED}

    def keep(self, topic: str, cdrs: Iterable[bytes]) -> None:
        """Take in messages of a topic, of whatever run they are."""
        self._kept[topic].extend(cdrs)

    def since(self, topic: str, count: int) -> list[bytes]:
        """Return the messages of a topic after the first `count`; valid until the run ends."""
        return self._kept[topic][count:]

    @property
    def stored_tick(self) -> int:
        """Last tick of which every stream that has begun is here, -1 before the first."""
        newest = [wire.run_and_tick(kept[-1]) for t in _EVERY_TICK if (kept := self._kept[t])]
        return min((tick for run, tick in newest if run == self.run_number), default=-1)

    def missing(self, totals: RunTotals) -> dict[str, int]:
        """Return how many messages of which topic have not come yet (negative: too many)."""
        lacks = {
            topic: count - len(self._own(topic, totals))
            for topic, count in totals.counts.items()
            if topic in WATCHED
        }
        return {topic: lack for topic, lack in lacks.items() if lack}

    def content(self, totals: RunTotals, definitions: MessageDefinitions) -> BagContent:
        """Return the run as a bag's content.

        Raises:
            BagError: Roster or world is missing.
        """
        damage = list(totals.damage)
        for topic, lack in self.missing(totals).items():
            kind = Integrity.TRUNCATED if lack > 0 else Integrity.ALTERED
            what = f'{lack} of {totals.counts[topic]} were not heard'
            damage.append((kind, f'{topic}: {what}' if lack > 0 else f'{topic}: {-lack} too many'))
        stored = [
            StoredMessage(topic=topic, cdr=cdr, value=_decoded(topic, cdr, definitions))
            for topic in WATCHED
            for cdr in self._own(topic, totals)
        ]
        return content_of(stored, damage, where=f'what was heard of run {totals.run_id}')

    def _own(self, topic: str, totals: RunTotals) -> Sequence[bytes]:
        """Return the messages of a topic that belong to the run; forget the others.

        A document that came twice counts once: the node that made a scenario graph publishes it
        too, before the run.
        """
        by_id = WATCHED[topic] is Belonging.BY_ID
        own = [
            cdr
            for cdr in self._kept[topic]
            if (
                wire.run_id(cdr) == totals.run_id
                if by_id
                else wire.run_and_tick(cdr)[0] == totals.run_number
            )
        ]
        self._kept[topic] = list(dict.fromkeys(own)) if by_id else own
        return self._kept[topic]


def _decoded(topic: str, cdr: bytes, definitions: MessageDefinitions) -> object:
    """Decode what came off the wire.

    Raises:
        BagError: It is no message of the topic's type.
    """
    try:
        return definitions.decode(messages.TOPICS[topic], cdr)
    except (SerdeError, ValueError, struct.error) as err:
        raise BagError(f'a message on {topic} cannot be decoded: {err}') from err
