# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What happened: roster, packed states, commands, records, bags and the trace hash."""
