# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Each consumer has its own stream, the same in every process and version."""

from __future__ import annotations

import hashlib

import numpy as np
import pytest

from aurora_core.ports.random_streams import stream


def test_same_seed_and_consumer_same_numbers() -> None:
    assert np.array_equal(stream(7, 'link:l1').random(50), stream(7, 'link:l1').random(50))


def test_streams_do_not_depend_on_each_other() -> None:
    alone = stream(7, 'link:l1').random(20)
    first, second = stream(7, 'link:l2'), stream(7, 'link:l1')
    first.random(1000)
    assert np.array_equal(second.random(20), alone)


def test_every_seed_and_every_consumer_differ() -> None:
    seen = {
        tuple(stream(seed, name).integers(0, 2**63, 4).tolist())
        for seed in range(20)
        for name in ('a', 'b', 'link:l1', 'link:l2', '', 'é')
    }
    assert len(seen) == 20 * 6


def test_construction_is_the_documented_one() -> None:
    """PCG64 over SeedSequence([seed, key]); python's own hash of strings changes per process."""
    key = int.from_bytes(hashlib.sha256(b'grounding:background').digest()[:8], 'little')
    expected = np.random.Generator(np.random.PCG64(np.random.SeedSequence([3, key])))
    assert np.array_equal(stream(3, 'grounding:background').random(9), expected.random(9))


def test_a_negative_seed_is_refused() -> None:
    with pytest.raises(ValueError, match='non-negative'):
        stream(-1, 'x')
