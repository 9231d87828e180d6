# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where each node of the graph is."""

from __future__ import annotations

# Node name and the module that holds its `main`; who imports little comes first.
MODULES = {
    'uav_sim': 'aurora_uav_sim.udp_main',
    **{name: f'aurora_{name}.node' for name in ('sync', 'sumo_bridge', 'uav_bridge')},
    **{name: f'aurora_nodes.{name}' for name in ('recorder', 'monitor', 'executor')},
    **{name: f'aurora_nodes.{name}' for name in ('grounding', 'parser', 'repair')},
    'orchestrator': 'aurora_nodes.orchestrator',
}
