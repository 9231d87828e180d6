# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's experiment: the same prompts with more and more of AURORA switched on."""
