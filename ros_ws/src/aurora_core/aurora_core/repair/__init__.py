# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bounded local repair: from a violated verdict to what is realised otherwise."""
