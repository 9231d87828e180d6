# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Support for tests that start real nodes as processes in a ROS domain of their own."""
