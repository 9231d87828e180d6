# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Imported once by a process that nodes are forked off: what they import, and no more."""

from __future__ import annotations

import gc
from contextlib import suppress
from importlib import import_module

# Node name and the module that holds its `main`.
MODULES = {
    'uav_sim': 'aurora_uav_sim.udp_main',
    **{name: f'aurora_{name}.node' for name in ('sync', 'sumo_bridge', 'uav_bridge')},
    **{name: f'aurora_nodes.{name}' for name in ('recorder', 'monitor', 'executor')},
    **{name: f'aurora_nodes.{name}' for name in ('grounding', 'parser', 'repair')},
    'orchestrator': 'aurora_nodes.orchestrator',
}

# Names and no imports: nodes are not below each other. What is missing fails in its own node.
for _module in MODULES.values():
    with suppress(ImportError):
        import_module(_module)
# The collector of a forked node need not look at it, and so not copy it.
gc.collect()
gc.freeze()
