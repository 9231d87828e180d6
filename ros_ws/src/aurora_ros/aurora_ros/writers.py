# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who writes on the topics of a run and serves its calls: nobody but who the interfaces name.

Two looks at it. The graph of the middleware names every writer, but not one that has gone again.
A subscription counts every writer that it was ever matched with, but names none.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rclpy.event_handler import QoSSubscriptionEventType
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.subscription import Subscription
from rclpy.topic_endpoint_info import TopicEndpointInfo

from aurora_core.errors import ExecutionError
from aurora_ros import qos
from aurora_ros.interfaces import Call, Topic
from aurora_ros.matching import wait_until
from aurora_ros.polling import PolledGroup

# Not the node that notices it, and not the one whose name the stranger may have taken.
COMPONENT = 'network'
# What the middleware says of a writer whose node it has not heard of (yet).
_UNNAMED = '_NODE_NAME_UNKNOWN_'
# How long a writer may be known before its node is (s).
_NAMED_WITHIN_S = 0.3
# The same where nobody waits meanwhile: the call or the run is lost (s).
_KNOWN_WITHIN_S = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Stranger:
    """Who writes or serves and should not.

    Attributes:
        place: What it does where, such as `writer on /clock` or `server of /aurora/parse`.
        node: Full name of its node, empty when the middleware knows none.
    """

    place: str
    node: str


def strangers(
    node: Node, topics: Iterable[Topic], participants: Collection[str]
) -> list[Stranger]:
    """Return the writers on topics that should not be there, as the graph knows them.

    Args:
        node: Asks, and shares its namespace with those who may write.
        topics: With their writers.
        participants: Node names that may not be there twice. Of the others one that was started
            again may stand beside the one that died, until the middleware forgets that.
    """
    found = []
    for topic in topics:
        name = node.resolve_topic_name(topic.name)
        infos = node.get_publishers_info_by_topic(name)
        others = _others(infos, node.get_namespace(), topic.writers, participants)
        found += [Stranger(place=f'writer on {name}', node=other) for other in others]
    return found


def second_servers(node: Node, calls: Iterable[Call]) -> list[Stranger]:
    """Return who serves calls beside the node that should: the first answer would be believed.

    Args:
        node: Asks, and shares its namespace with those who may serve.
        calls: With their servers.
    """
    found: dict[Stranger, None] = {}
    for call in calls:
        for service in call.services:
            # Who may answer is who writes on the topic of the answers.
            replies = f'rr{node.resolve_service_name(service)}Reply'
            infos = node.get_publishers_info_by_topic(replies, no_mangle=True)
            if len(infos) < 2 and _is_unnamed(infos):
                continue  # the server itself, which has just come
            place = f'server of {node.resolve_service_name(call.name)}'
            for other in _others(infos, node.get_namespace(), (call.server,), (call.server,)):
                found[Stranger(place=place, node=other)] = None
    return list(found)


def _is_unnamed(infos: Sequence[TopicEndpointInfo]) -> bool:
    return all(info.node_name == _UNNAMED for info in infos)


def _others(
    infos: Sequence[TopicEndpointInfo],
    namespace: str,
    allowed: Sequence[str],
    participants: Collection[str],
) -> Iterator[str]:
    """Yield the full names of nodes that should not be among these, empty for unknown ones."""
    counts = Counter(i.node_name for i in infos if i.node_namespace == namespace)
    for info in infos:
        if _is_unnamed([info]):
            # One of several that may write has perhaps just been started again.
            if len(allowed) <= 1:
                yield ''
            continue
        known = info.node_namespace == namespace and info.node_name in allowed
        once = counts[info.node_name] == 1 or info.node_name not in participants
        if not (known and once):
            yield f'{info.node_namespace.rstrip("/")}/{info.node_name}'


def named(there: Callable[[], list[Stranger]]) -> list[Stranger]:
    """Return who is there, once the middleware knows the nodes of all or 1 s is over."""
    wait_until(lambda: all(stranger.node for stranger in there()), _KNOWN_WITHIN_S)
    return there()


def second_one(stranger: Stranger) -> ExecutionError:
    """Return the error that ends a run."""
    who = f'node {stranger.node}' if stranger.node else 'a node without a name'
    return ExecutionError(
        f'second {stranger.place}: {who}',
        component=COMPONENT,
        hint='end it, or run in a ROS_DOMAIN_ID that nobody else uses',
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Matched:
    """The writers of a topic at one moment.

    Attributes:
        total: How many a subscription was ever matched with.
        current: How many of them it is matched with now.
        endpoints: Those that the graph knows.
        all_known: Whether the graph knows them all, with their nodes.
    """

    total: int
    current: int
    endpoints: frozenset[bytes]
    all_known: bool


class MatchedWriters:
    """Tells when somebody begins to write what a node hears and should not, however short.

    Args:
        node: The node; those who may write share its namespace.
        heard: Its subscriptions.
    """

    def __init__(self, node: Node, heard: Mapping[Topic, Subscription]) -> None:
        self._node = node
        self._events = {topic: _matched_event(tap) for topic, tap in heard.items()}
        self._seen: dict[Topic, _Matched] = {}

    @classmethod
    def on(cls, node: Node, topics: Iterable[Topic]) -> MatchedWriters:
        """Return one with subscriptions of its own, which take nothing."""
        group = PolledGroup()
        heard = {
            topic: node.create_subscription(
                topic.type, topic.name, _ignore, qos.UNHEARD, raw=True, callback_group=group
            )
            for topic in topics
        }
        return cls(node, heard)

    def begin(self) -> None:
        """Take those who write now as the ones who should."""
        self._seen = {topic: self._look(topic) for topic in self._events}

    def check(self, *, last: bool = False) -> None:
        """Look whether somebody has come since; who should write may come late.

        Args:
            last: There is no later look, at which whoever has no name yet would have one.

        Raises:
            ExecutionError: Somebody has who should not; it is named if it is still there.
        """
        for topic, seen in self._seen.items():
            if self._counts(topic)[0] != seen.total:
                self._seen[topic] = self._accepted(topic, seen, last=last)

    def close(self) -> None:
        """Let go of the subscriptions."""
        self._seen = {}
        for event in self._events.values():
            event.destroy_when_not_in_use()
        self._events = {}

    def _accepted(self, topic: Topic, seen: _Matched, *, last: bool) -> _Matched:
        """Return what is to be compared with from now on; the same until all are known."""
        participants = topic.writers if len(topic.writers) == 1 else ()

        def there() -> list[Stranger]:
            return strangers(self._node, [topic], participants)

        def is_settled() -> bool:
            now = self._look(topic)
            return any(s.node for s in there()) or (now.all_known and not _gone(seen, now))

        wait_until(is_settled, _KNOWN_WITHIN_S if last else _NAMED_WITHIN_S)
        for stranger in there():
            if stranger.node or last:
                raise second_one(stranger)
        now = self._look(topic)
        if _gone(seen, now):
            raise ExecutionError(
                f'second writer on {topic.full_name}: a node that is gone again',
                component=COMPONENT,
                hint='run in a ROS_DOMAIN_ID that nobody else uses',
            )
        if now.all_known:
            return now
        if last:
            raise second_one(Stranger(place=f'writer on {topic.full_name}', node=''))
        return seen

    def _look(self, topic: Topic) -> _Matched:
        total, current = self._counts(topic)
        name = self._node.resolve_topic_name(topic.name)
        infos = self._node.get_publishers_info_by_topic(name)
        return _Matched(
            total=total,
            current=current,
            endpoints=frozenset(bytes(info.endpoint_gid) for info in infos),
            all_known=current <= len(infos) and not any(_is_unnamed([i]) for i in infos),
        )

    def _counts(self, topic: Topic) -> tuple[int, int]:
        """Return how many writers a subscription was ever matched with, and is now."""
        event = self._events[topic]
        with event:
            status = event.take_event()
        return int(status.total_count), int(status.current_count)


def _ignore(_cdr: bytes) -> None:
    """Nothing: the subscription is there to be matched."""


def _gone(before: _Matched, now: _Matched) -> bool:
    """Return whether more have gone than those who were known."""
    gone = (now.total - before.total) - (now.current - before.current)
    return gone > len(before.endpoints - now.endpoints)


def _matched_event(subscription: Subscription) -> rclpy_implementation.EventHandle:
    """Return the event to be asked: one that wakes the node's executor costs each of its waits."""
    handle = subscription.handle
    with handle:
        return rclpy_implementation.EventHandle(
            handle, QoSSubscriptionEventType.RCL_SUBSCRIPTION_MATCHED
        )
