# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Standard output, line by line."""

import sys


def emit(text: str) -> None:
    """Write one line and pass it on at once, also into a pipe."""
    sys.stdout.write(f'{text}\n')
    sys.stdout.flush()
