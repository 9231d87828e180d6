# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Campaign: live, from the bag and replayed, every prompt has one set of margins."""
