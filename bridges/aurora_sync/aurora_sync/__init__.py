# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The shared logical clock: one tick at a time, and only when everybody is done."""
