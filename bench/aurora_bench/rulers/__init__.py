# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Rulers that run prompts and let an independent checker contradict the verdict."""
