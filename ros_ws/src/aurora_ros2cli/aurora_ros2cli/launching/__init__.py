# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 launch`: the part of ROS 2's launch files that starts processes."""
