# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Campaign: every node dies in every stage from start to repair, and the whole graph at once."""
