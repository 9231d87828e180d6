# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Programs that a model wrote, run where they can reach nothing but a pipe."""
