# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The nodes of the chain, each an adapter: convert in, call core, convert out."""
