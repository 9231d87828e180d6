# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Random streams: one per consumer, so that a new consumer changes nobody else's numbers."""

from __future__ import annotations

import hashlib

import numpy as np


def stream(seed: int, consumer: str) -> np.random.Generator:
    """Return the generator of a consumer.

    Args:
        seed: Seed of the run.
        consumer: Stable name, e.g. `link:l1`; its sha256 separates the streams.
    """
    key = int.from_bytes(hashlib.sha256(consumer.encode('utf-8')).digest()[:8], 'little')
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, key])))
