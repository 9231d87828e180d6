# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Processes that execute candidates of repair beside a run, on this machine or on others."""
