# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs that contradict their request: does the checker see it, and does a condition?"""
