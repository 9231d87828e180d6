# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Campaign: nodes that die in every phase of a run, up and down, many prompts in a row."""
