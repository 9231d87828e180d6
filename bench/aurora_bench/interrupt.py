# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""SIGTERM ends a campaign as Ctrl-C does: what was started is stopped."""

from __future__ import annotations

import signal
import sys


def stop_on_sigterm() -> None:
    """Raise SystemExit (143) in the main thread on SIGTERM instead of dying at once."""
    signal.signal(signal.SIGTERM, lambda _number, _frame: sys.exit(143))
