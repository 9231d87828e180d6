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
from aurora_ros.interfaces import Call, Topic
from aurora_ros.matching import wait_until

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


class LoneWriters:
    """Tells when somebody else begins to write what a node hears, however short.

    Args:
        node: The node.
        heard: Its subscriptions.
    """

    def __init__(self, node: Node, heard: Mapping[Topic, Subscription]) -> None:
        self._node = node
        self._topics = {topic.full_name: topic for topic in heard}
        self._events = {topic.full_name: _matched_event(tap) for topic, tap in heard.items()}
        self._totals: dict[str, int] = {}

    def begin(self, names: Collection[str]) -> None:
        """Take those who write now as the ones who should.

        Args:
            names: Full names of topics; those that several nodes write are left out.
        """
        self._totals = {
            name: self._total(name)
            for name, topic in self._topics.items()
            if name in names and len(topic.writers) == 1
        }

    def check(self) -> None:
        """Look whether somebody has come since.

        Raises:
            ExecutionError: Somebody has; it is named if it is still there.
        """
        more = [name for name, total in self._totals.items() if self._total(name) != total]
        if not more:
            return
        topics = [self._topics[name] for name in more]
        everybody = {writer for topic in topics for writer in topic.writers}

        def there() -> list[Stranger]:
            return [s for s in strangers(self._node, topics, everybody) if s.node]

        wait_until(lambda: bool(there()), _NAMED_WITHIN_S)
        for stranger in there():
            raise second_one(stranger)
        raise ExecutionError(
            f'second writer on {", ".join(more)}: a node that is gone again',
            component=COMPONENT,
            hint='run in a ROS_DOMAIN_ID that nobody else uses',
        )

    def close(self) -> None:
        """Let go of the subscriptions."""
        self._totals = {}
        for event in self._events.values():
            event.destroy_when_not_in_use()
        self._events = {}

    def _total(self, name: str) -> int:
        """Return how many writers a subscription was ever matched with."""
        event = self._events[name]
        with event:
            return int(event.take_event().total_count)


def _matched_event(subscription: Subscription) -> rclpy_implementation.EventHandle:
    """Return the event to be asked: one that wakes the node's executor costs each of its waits."""
    handle = subscription.handle
    with handle:
        return rclpy_implementation.EventHandle(
            handle, QoSSubscriptionEventType.RCL_SUBSCRIPTION_MATCHED
        )
