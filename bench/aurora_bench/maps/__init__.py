# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Campaign: maps of anybody's, from their file to a verdict, and files that are none."""
