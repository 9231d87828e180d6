# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Core values to and from `aurora_msgs`, one direction at a time; nothing else crosses."""
