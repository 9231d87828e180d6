# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Requests at both sides of every limit: what is refused, why, how fast, how surely."""
