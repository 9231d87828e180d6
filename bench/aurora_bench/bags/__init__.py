# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Campaign against recordings: killed recorders, cut files, flipped bits, forged messages."""
