# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""AURORA's pure library: compile, ground, execute, verify; no ROS and no simulator in here."""
