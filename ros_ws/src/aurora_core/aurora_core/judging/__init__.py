# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How each quantity is asked for and judged: one file per quantity in `quantities`."""
