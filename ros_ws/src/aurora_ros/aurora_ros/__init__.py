# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What every ROS node of AURORA shares; the only place beside the nodes that imports rclpy."""
