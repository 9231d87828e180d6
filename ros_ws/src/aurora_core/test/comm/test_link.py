# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The message link: latency, retransmission, range and reproducible loss."""

from itertools import count

from aurora_core.comm.link import LinkSettings, MessageLink, Path, whole_ticks
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
        range_sight_m=500.0,
        range_blocked_m=200.0,
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
