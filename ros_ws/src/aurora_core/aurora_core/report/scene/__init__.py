# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What picture and page show of a run: tracks, moments, words, colours. Draws nothing itself."""
