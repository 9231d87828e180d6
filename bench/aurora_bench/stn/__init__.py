# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Campaign: Simple Temporal Networks beside SciPy's Bellman-Ford."""
