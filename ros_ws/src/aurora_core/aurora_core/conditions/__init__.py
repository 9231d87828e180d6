# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Success conditions: what a specification asks, as formulas with an English sentence."""
