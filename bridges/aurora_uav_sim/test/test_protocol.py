# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ports, fleets, seeds and status words."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aurora_uav_sim import protocol


def test_ports_differ_between_domains_and_stay_in_the_domain_block() -> None:
    ports = [protocol.mavlink_port(domain) for domain in range(232)]
    assert len(set(ports)) == 232
    for domain, port in enumerate(ports):
        # DDS takes the ports from the bottom of the block: two per participant.
        assert 200 <= port - (7400 + 250 * domain) < 250
        assert port < 65536
    assert protocol.mavlink_port(0, 3) == protocol.mavlink_port(0) + 2


@pytest.mark.parametrize(('domain', 'system'), [(-1, 1), (232, 1), (0, 0), (0, 251)])
def test_ports_out_of_range_are_refused(domain: int, system: int) -> None:
    with pytest.raises(ValueError, match='expected a'):
        protocol.mavlink_port(domain, system)


@given(st.sets(st.integers(1, 64), min_size=1))
def test_fleet_comes_back(ids: set[int]) -> None:
    masks = protocol.fleet_masks(tuple(ids))
    assert protocol.fleet_from_masks(tuple(int(m) for m in masks)) == tuple(sorted(ids))


@given(st.integers(0, 2**64 - 1))
def test_seed_words_carry_all_bits(seed: int) -> None:
    words = protocol.seed_words(seed)
    assert all(0 <= w <= 0xFFFF for w in words)
    assert sum(int(w) << (16 * i) for i, w in enumerate(words)) == seed


@given(st.integers(1, protocol.MAX_NONCE), st.integers(0, 15), st.booleans(), st.booleans())
def test_status_comes_back_and_knows_its_session(
    nonce: int, mode: int, armed: bool, landed: bool
) -> None:
    value = protocol.pack_status(nonce, mode, armed, landed)
    assert 0 <= value < 2**31
    assert protocol.unpack_status(value, nonce) == (mode, armed, landed)
    assert protocol.unpack_status(value, nonce ^ 1) is None
