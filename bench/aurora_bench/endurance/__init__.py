# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Many runs in one process: nothing may pile up, and no run may change a later one."""
