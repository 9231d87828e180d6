# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a language model is told beside the prompt: registries, and records that fit the prompt."""
