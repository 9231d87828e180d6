# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether there is room for libsumo: where there is none it dies while it is loaded, without a
word.
"""

from __future__ import annotations

import resource
from pathlib import Path

from aurora_core.errors import GroundSimulatorError

# Libraries with their threads and the largest shipped map took 850 MiB of address space.
ROOM_BYTES = 900 << 20


def check_room() -> None:
    """Look, before libsumo is imported, whether the limit of the address space leaves enough.

    Raises:
        GroundSimulatorError: It does not.
    """
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit == resource.RLIM_INFINITY:
        return
    pages = int(Path('/proc/self/statm').read_text(encoding='ascii').split()[0])
    left = limit - pages * resource.getpagesize()
    if left < ROOM_BYTES:
        raise GroundSimulatorError(
            f'SUMO needs {ROOM_BYTES >> 20} MiB of address space, {max(0, left) >> 20} MiB are '
            f'left of {limit >> 20}',
            hint='raise ulimit -v',
        )
