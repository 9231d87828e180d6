# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The aurora command, and the local engine that runs the whole chain in one process."""
