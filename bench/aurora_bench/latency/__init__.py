# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long one answer takes, in a new process and in a warm one (`make bench-latency`)."""
