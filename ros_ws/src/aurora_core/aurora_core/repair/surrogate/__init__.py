# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kinematic replay: what a recorded trace says of edits that were not simulated."""
