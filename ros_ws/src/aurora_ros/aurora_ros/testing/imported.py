# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Imported once by the process that forks the nodes of tests: what nodes import, and no more."""

from __future__ import annotations

import gc
from contextlib import suppress
from importlib import import_module

# Names and no imports: these packages are above this one. Each node imports what is missing.
_MODULES = (
    *(f'aurora_nodes.{name}' for name in ('executor', 'grounding', 'monitor', 'orchestrator')),
    *(f'aurora_nodes.{name}' for name in ('parser', 'recorder', 'repair')),
    *(f'aurora_{name}.node' for name in ('sumo_bridge', 'sync', 'uav_bridge')),
    'aurora_uav_sim.udp_main',
)

for _name in _MODULES:
    with suppress(ImportError):
        import_module(_name)
# The collector of a forked node need not look at it, and so not copy it.
gc.collect()
gc.freeze()
