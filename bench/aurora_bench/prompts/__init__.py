# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Prompts with annotated requirements, and what checks such files (docs/bench/prompts.md)."""
