# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The bad link does what it is told to, and as often."""

from __future__ import annotations

import numpy as np
import pytest

from aurora_uav_bridge.testing.bad_link import BadLink, LinkFaults
from aurora_uav_sim.wire import COMMAND_LONG, Sequence, split

DATAGRAMS = 4000


def link(seed: int = 1, **faults: float) -> BadLink:
    return BadLink(LinkFaults(**faults), np.random.Generator(np.random.PCG64(seed)))


def frame() -> bytes:
    return COMMAND_LONG.frame(
        Sequence(245, 191), 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 31010, 1, 1, 0
    )  # fmt: skip


@pytest.mark.parametrize(
    'name', ['loss', 'duplication', 'reordering', 'truncation', 'corruption', 'delay_s']
)
@pytest.mark.parametrize('value', [-0.1, 1.5, float('nan')])
def test_a_share_out_of_range_is_refused(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f'{name}: expected a number from 0 to 1'):
        LinkFaults(**{name: value})


@pytest.mark.parametrize('name', ['loss', 'duplication', 'reordering', 'truncation', 'corruption'])
def test_each_fault_comes_as_often_as_asked_and_by_itself(name: str) -> None:
    bad = link()
    bad.faults = LinkFaults(**{name: 0.2})
    for _ in range(DATAGRAMS):
        bad.carry(frame())
    assert bad.counts['sent'] == DATAGRAMS
    assert set(bad.counts) == {'sent', name}
    # Five standard deviations.
    assert abs(bad.counts[name] - 0.2 * DATAGRAMS) < 5.0 * (DATAGRAMS * 0.2 * 0.8) ** 0.5


def test_what_each_fault_does() -> None:
    sent = frame()
    (whole,) = link().carry(sent)
    assert (whole.data, whole.late_s) == (sent, 0.0)
    assert link(loss=1.0).carry(sent) == []
    assert [a.data for a in link(duplication=1.0).carry(sent)] == [sent, sent]
    cut = [link(seed, truncation=1.0).carry(sent)[0].data for seed in range(50)]
    assert all(sent.startswith(data) for data in cut)
    assert len({len(data) for data in cut}) > 20
    late = [link(seed, reordering=1.0, delay_s=0.5).carry(sent)[0] for seed in range(50)]
    assert all(0.0 <= arrival.late_s < 0.5 for arrival in late)
    assert max(arrival.late_s for arrival in late) > 0.3


def test_a_corrupted_frame_never_passes_the_checksum() -> None:
    bad = link(corruption=1.0)
    for _ in range(DATAGRAMS):
        (arrival,) = bad.carry(frame())
        assert len(arrival.data) == len(frame())
        assert list(split(arrival.data)) == []
    assert list(split(frame()))


def test_an_empty_datagram_cannot_be_corrupted() -> None:
    assert link(corruption=1.0).carry(b'')[0].data == b''


def test_the_seed_decides() -> None:
    faults = {'loss': 0.3, 'duplication': 0.3, 'truncation': 0.3, 'corruption': 0.3}

    def run(seed: int) -> list[bytes]:
        bad = link(seed, **faults)
        return [arrival.data for _ in range(200) for arrival in bad.carry(frame())]

    assert run(1) == run(1) != run(2)
