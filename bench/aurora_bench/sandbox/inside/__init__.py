# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What runs inside the sandbox; imports nothing but the standard library."""
