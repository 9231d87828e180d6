# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Campaign against the verifier: altered runs, altered documents, executors with planted bugs."""
