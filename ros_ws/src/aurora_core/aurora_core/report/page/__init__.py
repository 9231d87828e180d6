# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The page of a run: what it shows of the recording, as data that its scripts draw."""
