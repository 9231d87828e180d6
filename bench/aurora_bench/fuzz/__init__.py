# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Damaged prompts and damaged model replies: nothing breaks, nothing is invented."""
