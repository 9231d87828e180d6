# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What words say and elements do not: the checks after the assembly, for every reader."""
