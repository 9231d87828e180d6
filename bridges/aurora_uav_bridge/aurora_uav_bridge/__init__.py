# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Flying vehicles: a MAVLink client in lockstep (no ROS), and its ROS 2 node."""
