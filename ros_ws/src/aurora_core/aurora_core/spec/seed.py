# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which seeds a run can have: the one definition for options, requests and specifications."""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator, Field

# The traffic simulator takes a signed number of 32 bits.
SEED_MAX = 2**31 - 1


_WANTED = f'a seed is a whole number from 0 to {SEED_MAX}'


def check_seed(value: object) -> int:
    """Return a seed of a document or an option.

    Raises:
        ValueError: It is no whole number, or none that every simulator takes; says which do.
    """
    if not isinstance(value, int) or isinstance(value, bool):
        raise ValueError(f'{_WANTED}, found {str(value)[:40]!r}')
    if not 0 <= value <= SEED_MAX:
        raise ValueError(f'{_WANTED}; take another one')
    return value


def typed_seed(text: str) -> int:
    """Return the seed that was typed.

    Raises:
        ValueError: The text is no seed; says which are.
    """
    if not (text.isascii() and text.isdigit()):
        raise ValueError(f'{_WANTED}, found {text[:40]!r}')
    return check_seed(int(text) if len(text) <= len(str(SEED_MAX)) else SEED_MAX + 1)


# A seed in a document: a number, never text, so that one request has one form.
Seed = Annotated[int, BeforeValidator(check_seed), Field(strict=True, ge=0, le=SEED_MAX)]
