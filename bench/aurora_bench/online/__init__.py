# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What it costs to follow the margins of a run while it goes on (`make bench-online`)."""
