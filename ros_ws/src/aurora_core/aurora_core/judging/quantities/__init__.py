# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One file per quantity: its arguments, how its signal is measured, the conditions it makes."""
