# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How fast the lockstep is, in both engines, and where the time goes (`make bench-lockstep`)."""
