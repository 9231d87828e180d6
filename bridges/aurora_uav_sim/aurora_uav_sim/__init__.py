# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A small multirotor simulator behind MAVLink 2; no ROS inside."""
