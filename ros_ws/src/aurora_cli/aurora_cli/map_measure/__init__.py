# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Measuring maps and vehicle models in the simulators: `aurora map measure`."""
