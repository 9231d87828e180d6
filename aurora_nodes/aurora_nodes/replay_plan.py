# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ReplayPlan`: what of a bag is published, tick by tick. No ROS."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.bag_reader import BagContent, StoredBag, StoredMessage
from aurora_core.trace.trace import Integrity
from aurora_ros import cdr as wire

DOCUMENTS = (messages.AGSG, messages.ROSTER, messages.WORLD)
# In a run: commands of a tick, the states that they lead to, what is claimed about them.
_ORDER = (
    messages.GROUND_COMMAND,
    messages.UAV_COMMAND,
    messages.GROUND_STATE,
    messages.UAV_STATE,
    messages.COMM,
    messages.SENSING,
    messages.EVENTS,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplayPlan:
    """A recorded run in the order in which it is published.

    Attributes:
        run_number: That the messages carry.
        run_id: That the documents carry.
        iteration: Repair iteration.
        dt_s: Time step.
        documents: Graph, roster and world, one of each.
        ticks: Element k holds the messages of tick k; what belongs to no tick of the run (commands
            after its end) comes last, in one element more.
        last_tick: Last tick with a state.
        damage: What is wrong with the recording.
    """

    run_number: int
    run_id: str
    iteration: int
    dt_s: float
    documents: tuple[StoredMessage, ...]
    ticks: tuple[tuple[StoredMessage, ...], ...]
    last_tick: int
    damage: tuple[tuple[Integrity, str], ...]

    @property
    def counts(self) -> Mapping[str, int]:
        """Messages by topic."""
        return Counter(m.topic for group in (self.documents, *self.ticks) for m in group)


def plan_replay(bag: StoredBag, content: BagContent) -> ReplayPlan:
    """Put the messages of a bag into order.

    Args:
        bag: Its messages.
        content: The same as a trace.

    Raises:
        BagError: There is no tick that could be published.
    """
    by_topic: dict[str, list[StoredMessage]] = {topic: [] for topic in messages.TOPICS}
    for message in bag.messages:
        by_topic[message.topic].append(message)
    documents = [by_topic[topic][-1] for topic in DOCUMENTS if by_topic[topic]]
    stamped = [
        (*wire.run_and_tick(message.cdr), message)
        for topic in _ORDER
        for message in by_topic[topic]
    ]
    last_tick = content.trace.ticks - 1
    if last_tick < 0 or not stamped:
        raise BagError(f'{bag.folder} holds no tick, so nothing can be replayed')
    (run_number, _), *_ = Counter(run for run, _, _ in stamped).most_common(1)
    run_id = wire.run_id(documents[0].cdr)
    ticks: list[list[StoredMessage]] = [[] for _ in range(last_tick + 2)]
    foreign = sum(wire.run_id(message.cdr) != run_id for message in documents)
    for run, tick, message in stamped:
        if run == run_number:
            ticks[min(tick, last_tick + 1)].append(message)
        else:
            foreign += 1
    damage = list(bag.damage)
    if foreign:
        damage.append((Integrity.ALTERED, f'{foreign} messages belong to another run'))
    agsg = content.agsg_message
    return ReplayPlan(
        run_number=run_number,
        run_id=run_id,
        iteration=0 if agsg is None else int(agsg.iteration),
        dt_s=content.trace.roster.dt_s,
        documents=tuple(m for m in documents if wire.run_id(m.cdr) == run_id),
        ticks=tuple(tuple(group) for group in ticks),
        last_tick=last_tick,
        damage=tuple(damage),
    )
