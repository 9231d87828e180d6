# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Pairs that are to meet, generated: whether they do, and by how many seconds they miss."""
