# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""UAV missions as predicate-guarded state machines, and the paths they fly."""
