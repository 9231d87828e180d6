# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The message link: latency, loss and retransmission from a seeded generator."""
