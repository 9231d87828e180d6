# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The message link: latency, retransmission, range and reproducible loss."""

from dataclasses import replace
from itertools import count

from aurora_core.comm.link import LinkSettings, MessageLink, Path, whole_ticks
from aurora_core.comm.reach import Reach
from aurora_core.ports.random_streams import stream
from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason

DT_S = 0.05
NEAR = Path(distance_m=50.0, line_of_sight=True)


def _settings(loss: float = 0.0, latency_s: float = 0.1) -> LinkSettings:
    return LinkSettings(
        link_id='l1',
        sender='uav1',
        receiver='ego',
        loss=loss,
        latency_s=latency_s,
        retransmissions=3,
        interval_s=0.2,
        reach=Reach(sight_m=500.0, blocked_m=200.0),
    )


def _run(link: MessageLink, path: Path, ticks: int = 100) -> list[LinkRecord]:
    sequence = count()
    records: list[LinkRecord] = []
    link.send(10, 1, 'e1')
    for tick in range(10, ticks):
        records += link.step(tick, lambda: path, lambda: next(sequence))
    return records


def test_message_arrives_after_exactly_the_latency() -> None:
    records = _run(MessageLink(_settings(), DT_S, stream(1, 'link:l1')), NEAR)
    assert [(r.kind, r.tick) for r in records] == [
        (LinkEventKind.SENT, 10),
        (LinkEventKind.ATTEMPT_PASSED, 10),
        (LinkEventKind.DELIVERED, 12),
    ]


def test_latency_is_rounded_up_to_whole_ticks_without_representation_errors() -> None:
    assert [whole_ticks(s, DT_S) for s in (0.0, 0.05, 0.1, 0.15, 0.3, 0.35, 0.6, 0.11)] == [
        0,
        1,
        2,
        3,
        6,
        7,
        12,
        3,
    ]


def test_a_link_that_loses_all_gives_up_after_its_retransmissions() -> None:
    link = MessageLink(_settings(), DT_S, stream(1, 'link:l1'), loss_at=lambda _t: 1.0)
    records = _run(link, NEAR)
    lost = [r.tick for r in records if r.kind is LinkEventKind.ATTEMPT_LOST]
    assert lost == [10, 14, 18, 22]
    assert records[-1].kind is LinkEventKind.FAILED
    assert link.idle


def test_out_of_range_is_its_own_reason_and_depends_on_sight() -> None:
    far = Path(distance_m=300.0, line_of_sight=False)
    records = _run(MessageLink(_settings(), DT_S, stream(1, 'link:l1')), far)
    assert {r.reason for r in records if r.kind is LinkEventKind.ATTEMPT_LOST} == {
        LossReason.RANGE
    }
    seen = Path(distance_m=300.0, line_of_sight=True)
    records = _run(MessageLink(_settings(), DT_S, stream(1, 'link:l1')), seen)
    assert records[-1].kind is LinkEventKind.DELIVERED


def test_same_seed_same_losses_and_streams_are_separate() -> None:
    def losses(seed: int, name: str) -> list[bool]:
        link = MessageLink(_settings(loss=0.5), DT_S, stream(seed, name))
        sequence = count()
        out: list[bool] = []
        for number in range(60):
            link.send(number * 100, number, 'e1')
            for tick in range(number * 100, number * 100 + 60):
                for r in link.step(tick, lambda: NEAR, lambda: next(sequence)):
                    if r.kind in (LinkEventKind.ATTEMPT_LOST, LinkEventKind.ATTEMPT_PASSED):
                        out.append(r.kind is LinkEventKind.ATTEMPT_LOST)
        return out

    assert losses(1, 'link:l1') == losses(1, 'link:l1')
    assert losses(1, 'link:l1') != losses(2, 'link:l1')
    assert losses(1, 'link:l1') != losses(1, 'link:l2')
    share = sum(losses(1, 'link:l1')) / len(losses(1, 'link:l1'))
    assert 0.3 < share < 0.7


def test_at_the_edge_of_the_range_a_message_passes() -> None:
    for distance, passes in ((500.0, True), (500.0001, False)):
        edge = Path(distance_m=distance, line_of_sight=True)
        records = _run(MessageLink(_settings(), DT_S, stream(1, 'link:l1')), edge)
        assert (records[-1].kind is LinkEventKind.DELIVERED) is passes


def test_range_counts_where_both_are_when_it_is_sent_again() -> None:
    link = MessageLink(_settings(), DT_S, stream(1, 'link:l1'))
    sequence = count()
    link.send(0, 1, 'e1')
    records: list[LinkRecord] = []
    for tick in range(20):
        path = Path(distance_m=700.0 - 50.0 * tick, line_of_sight=True)
        records += link.step(tick, lambda path=path: path, lambda: next(sequence))  # type: ignore[misc]
    # Out of range at tick 0, in range when it is sent again after 0.2 s.
    passed = next(r for r in records if r.kind is LinkEventKind.ATTEMPT_PASSED)
    assert (passed.tick, passed.attempt, passed.distance_m) == (4, 1, 500.0)
    assert records[-1].kind is LinkEventKind.DELIVERED


def test_several_messages_are_under_way_at_once() -> None:
    link = MessageLink(_settings(latency_s=0.5), DT_S, stream(1, 'link:l1'))
    sequence = count()
    records: list[LinkRecord] = []
    for tick in range(30):
        if tick in (0, 3):
            link.send(tick, tick, f'e{tick}')
        records += link.step(tick, lambda: NEAR, lambda: next(sequence))
    delivered = [
        (r.tick, r.message, r.event) for r in records if r.kind is LinkEventKind.DELIVERED
    ]
    assert delivered == [(10, 0, 'e0'), (13, 3, 'e3')]
    assert [r.sequence for r in records] == list(range(6))
    assert link.idle


def test_out_of_range_uses_up_its_draw() -> None:
    """One draw per attempt: a body that moves out of range changes no later loss."""

    def losses_after_first(first_m: float) -> list[bool]:
        settings = replace(_settings(loss=0.5), retransmissions=0)
        link = MessageLink(settings, DT_S, stream(5, 'link:l1'))
        sequence = count()
        lost = []
        for number in range(30):
            path = Path(distance_m=first_m if number == 0 else 50.0, line_of_sight=True)
            link.send(number, number, 'e1')
            records = link.step(number, lambda path=path: path, lambda: next(sequence))  # type: ignore[misc]
            lost.append(any(r.kind is LinkEventKind.ATTEMPT_LOST for r in records))
        return lost[1:]

    assert losses_after_first(9000.0) == losses_after_first(50.0)


def test_in_an_outage_nothing_passes_and_the_draws_go_on() -> None:
    ticks = {}
    for outage_s in (None, (0.4, 0.8)):
        settings = replace(_settings(loss=0.5), outage_s=outage_s)
        link = MessageLink(settings, DT_S, stream(1, 'link:l1'))
        records = [r for r in _run(link, NEAR) if r.kind is LinkEventKind.ATTEMPT_LOST]
        ticks[outage_s] = {(r.tick, r.reason) for r in records}
    # From 0.4 s on, and at 0.8 s no longer: attempts at 10 and 14, not the one at 18.
    assert {(10, LossReason.RANGE), (14, LossReason.RANGE)} <= ticks[(0.4, 0.8)]
    assert all(reason is not LossReason.RANGE for tick, reason in ticks[(0.4, 0.8)] if tick >= 16)
    assert all(reason is LossReason.RANDOM for _, reason in ticks[None])
