# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The promises R1 to R22 in one table: target, how many tries it takes, how many were made."""
