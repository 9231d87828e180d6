# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who executes candidates of repair for the graph: warm processes with the local engine."""

from __future__ import annotations

import os
from contextlib import AbstractContextManager

from aurora_core.pipeline.beside import Beside


def candidates(processes: int | None, dask: str) -> AbstractContextManager[Beside | None]:
    """Give who executes candidates beside the runs of the context.

    Args:
        processes: Of this machine, at most one for each processor; None: as configured.
        dask: Address of a scheduler whose workers execute instead; '': nobody's.

    Raises:
        AuroraError: The scheduler cannot be used, or the configuration cannot be read.
    """
    # Imported here: a node starts without the local engine.
    from aurora_cli.beside.chosen import Elsewhere, chosen

    most = None if processes is None else min(processes, os.cpu_count() or 1)
    return chosen(Elsewhere(jobs=most, dask=dask or None), here=False)
