# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How much of what a prompt asks for its specification holds (docs/bench/prompts.md)."""
