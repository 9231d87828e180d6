# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What would have to be asked instead, in words."""

from __future__ import annotations

from aurora_core.outcomes.feasibility import Mend


def could_be(mend: Mend, prompt: str) -> str:
    """Return the nearest value that can be, beside what the prompt says.

    Args:
        mend: The value.
        prompt: The words that the request was read from.
    """
    unit = '' if mend.unit == '1' else f' {mend.unit}'
    stated = f'{mend.requested:.6g}{unit}'
    if mend.span is not None:
        stated = f'"{prompt[mend.span.start : mend.span.end]}"'
    return f'{mend.nearest:.6g}{unit} instead of {stated} ({mend.path})'
