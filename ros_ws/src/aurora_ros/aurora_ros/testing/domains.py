# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A ROS domain that no other test on this machine uses."""

from __future__ import annotations

import gc
import socket
from collections.abc import Iterator
from contextlib import contextmanager

_FIRST, _LAST = 110, 199
_LOCK_PORT = 28_000  # plus the domain; outside the ephemeral range and away from DDS


@contextmanager
def own_domain() -> Iterator[int]:
    """Yield a domain id; it is held by a bound port until the block ends.

    Raises:
        RuntimeError: All are taken.
    """
    # What rclpy leaves in cycles keeps its participant, and so its writers and readers, in the
    # domain that the test before gave back.
    gc.collect()
    for domain in range(_FIRST, _LAST + 1):
        lock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            lock.bind(('127.0.0.1', _LOCK_PORT + domain))
        except OSError:
            lock.close()
            continue
        with lock:
            yield domain
        return
    raise RuntimeError(f'every ROS domain from {_FIRST} to {_LAST} is in use by another test')
