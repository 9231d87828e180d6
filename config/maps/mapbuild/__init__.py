# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Development tools that build the maps shipped in this folder (never imported at run time)."""
