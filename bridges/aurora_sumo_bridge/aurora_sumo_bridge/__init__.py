# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ground traffic: `sumo_client.SumoClient` (libsumo, no ROS) and the node around it."""
