# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Find the one JSON object in what a model wrote; nothing in it is ever executed or mended."""

from __future__ import annotations

import json
from typing import Any, NoReturn

MAX_REPLY_CHARACTERS = 256 * 1024
_MOST_STARTS = 1000  # braces that are tried: chatter has a few


class ReplyError(ValueError):
    """The text of a reply does not hold what was asked for; the message goes to the model."""


def json_object(text: str, marks: frozenset[str]) -> str:
    """Return the text of the one JSON object that is the answer, without what is around it.

    Args:
        text: The whole reply, with fences and chatter (which may hold braces of its own).
        marks: An object is the answer when it has one of these keys; parts of an answer have none.

    Raises:
        ReplyError: There is none or more than one, it is cut off, or it is too long.
    """
    if len(text) > MAX_REPLY_CHARACTERS:
        raise ReplyError(f'the answer has more than {MAX_REPLY_CHARACTERS} characters')
    decoder = json.JSONDecoder(object_pairs_hook=_no_repeats, parse_constant=_no_constant)
    found: list[str] = []
    problem = ''
    at = text.find('{')
    for _ in range(_MOST_STARTS):
        if at < 0:
            break
        try:
            value, end = decoder.raw_decode(text, at)
        except (json.JSONDecodeError, RecursionError) as err:
            problem = problem or f'; the first brace opens something else: {err}'
            at = text.find('{', at + 1)
            continue
        if marks & value.keys():
            found.append(text[at:end])
        at = text.find('{', end)
    if len(found) != 1:
        raise ReplyError(
            f'the answer must hold one JSON object with {" or ".join(sorted(marks))}, found '
            f'{len(found)}{problem}'
        )
    return found[0]


def _no_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    names = [name for name, _ in pairs]
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        raise ReplyError(f'keys must not repeat: {", ".join(repeated)}')
    return dict(pairs)


def _no_constant(name: str) -> NoReturn:
    raise ReplyError(f'numbers must be finite, found {name}')
