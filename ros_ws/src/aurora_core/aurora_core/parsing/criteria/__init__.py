# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Success conditions, in whatever words: `no two of them come closer than 15 m to one another`."""
