# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The links of a program's scene: the same model as everywhere, between its bodies."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_bench.sandbox.requests import Link, SceneRefusal
from aurora_core.comm.link import LinkSettings, MessageLink, Path, link_stream
from aurora_core.comm.reach import Reach
from aurora_core.execution.scenario_executor import GONE_M
from aurora_core.geometry.sight_line import SightLine
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.world import WorldModel
from aurora_core.quantities import instant
from aurora_core.quantities.world_geometry import WorldGeometry
from aurora_core.trace.records import LinkEventKind, LinkRecord
from aurora_core.trace.roster import Roster
from aurora_core.trace.trace import FloatArray

# Between two transmissions of one message (s).
_INTERVAL_S = 0.5


class Radio:
    """All links of one run.

    Args:
        links: As the program asked for them.
        roster: Rows of the states.
        world: What stands in the way.
        sight_line: Its buildings.
        limits: Ranges of links that state none.
        seed: Of the draws.
    """

    def __init__(
        self,
        links: Sequence[Link],
        roster: Roster,
        world: WorldModel,
        sight_line: SightLine,
        limits: Limits,
        seed: int,
    ) -> None:
        self._roster = roster
        self._geometry = WorldGeometry(world, sight_line)
        self._links = {
            (link.sender, link.receiver): MessageLink(
                LinkSettings(
                    link_id=f'link{k + 1}',
                    sender=link.sender,
                    receiver=link.receiver,
                    loss=link.loss,
                    latency_s=link.latency_s,
                    retransmissions=link.retransmissions,
                    interval_s=_INTERVAL_S,
                    reach=_reach(link, limits),
                ),
                roster.dt_s,
                link_stream(seed, f'link{k + 1}'),
            )
            for k, link in enumerate(links)
        }
        self._sent = 0
        self._sequence = 0
        self._delivered: dict[tuple[str, str], int] = dict.fromkeys(self._links, 0)

    def send(self, tick: int, sender: str, receiver: str) -> None:
        """Send a message at a tick.

        Raises:
            SceneRefusal: There is no such link.
        """
        link = self._links.get((sender, receiver))
        if link is None:
            raise SceneRefusal(f'there is no link from {sender} to {receiver}')
        self._sent += 1
        link.send(tick, self._sent, f'message{self._sent}')

    def delivered(self, sender: str, receiver: str) -> int:
        """Return how many messages have arrived.

        Raises:
            SceneRefusal: There is no such link.
        """
        if (sender, receiver) not in self._delivered:
            raise SceneRefusal(f'there is no link from {sender} to {receiver}')
        return self._delivered[sender, receiver]

    def step(self, tick: int, ground: FloatArray, uav: FloatArray) -> tuple[LinkRecord, ...]:
        """Return the entries of a tick, of its states."""
        records: list[LinkRecord] = []
        for (sender, receiver), link in self._links.items():
            if link.idle:
                continue

            def path(sender: str = sender, receiver: str = receiver) -> Path:
                return self._path(sender, receiver, ground, uav)

            records += link.step(tick, path, self._next)
        for record in records:
            if record.kind is LinkEventKind.DELIVERED:
                self._delivered[record.sender, record.receiver] += 1
        return tuple(records)

    def _next(self) -> int:
        self._sequence += 1
        return self._sequence

    def _path(self, sender: str, receiver: str, ground: FloatArray, uav: FloatArray) -> Path:
        roster = self._roster
        ends = [instant.body_point(roster, ground, uav, name) for name in (sender, receiver)]
        if ends[0] is None or ends[1] is None:
            return Path(distance_m=GONE_M, line_of_sight=False)
        sight = instant.radio_sight(self._geometry, roster, ground, uav, sender, receiver)
        return Path(distance_m=instant.distance_m(ends[0], ends[1]), line_of_sight=sight)


def _reach(link: Link, limits: Limits) -> Reach:
    """Return the reach of a link: as in a run, what it states replaces the fading."""
    if link.range_m is not None:
        return Reach(sight_m=link.range_m, blocked_m=link.range_m)
    return Reach(
        sight_m=limits.link_range_sight_m,
        blocked_m=limits.link_range_blocked_m,
        decade_db=limits.link_decade_db if link.loss == 0.0 else 0.0,
    )
