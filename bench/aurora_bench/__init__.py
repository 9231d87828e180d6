# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Benchmarks and long campaigns; each subpackage is one of them and runs with `python -m`."""
