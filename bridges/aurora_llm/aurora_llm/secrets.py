# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Credentials, wherever they stand, taken out of what goes into a record or onto a terminal.

A server may repeat what it was sent: the key of its header, the user of its address, what an
intermediate proxy was logged in with. Nothing is known of how it says so, hence each secret is
looked for as it is, percent-encoded, decoded, and as HTTP's basic authentication sends it.
"""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Iterator, Mapping
from urllib.parse import parse_qsl, quote, unquote, urlsplit

BLANK = '[key]'

# Words in the name of a variable whose value nobody else should see.
_TELLING = re.compile(
    'APIKEY|AUTH|AUTHORIZATION|COOKIE|CREDENTIALS?|KEYS?|PASS|PASSPHRASE|PASSWD|PASSWORD|PAT'
    '|SECRETS?|SIGNATURE|TOKENS?'
)
# These hold names beside secrets, "Authorization: Bearer abc".
_HEADERS = re.compile('HEADERS?')
_WORDS = re.compile(r'[^\s,;:="\'{}\[\]]+')
# Shorter ones are words of the language: taking them out would only garble an answer.
_LEAST_OF_VARIABLE = 8
_LEAST_OF_ADDRESS = 4


def redacted(text: str, addresses: tuple[str, ...], environment: Mapping[str, str]) -> str:
    """Return text without secrets.

    Args:
        text: What comes from a server or a library.
        addresses: URLs that may hold user, password, query or fragment.
        environment: Variables of the process.
    """
    found = {secret for address in addresses for secret in _of_address(address)}
    for name, value in environment.items():
        found.update(_of_variable(name, value))
    # The longest first: a shorter one may be a part of it.
    for secret in sorted({form for s in found for form in _forms(s)}, key=lambda s: (-len(s), s)):
        text = text.replace(secret, BLANK)
    return text


def _of_address(address: str) -> Iterator[str]:
    """Yield user, password, query and fragment of an address."""
    try:
        parts = urlsplit(address)
    except ValueError:  # no address, but what it is nobody knows
        yield address
        return
    login = parts.netloc.rpartition('@')[0]
    if login:
        plain = unquote(login).encode()
        yield base64.b64encode(plain).decode('ascii')
    given = [login, *login.partition(':')[::2], parts.query, parts.fragment]
    given += [value for _, value in parse_qsl(parts.query)]
    for value in given:
        yield from (v for v in (value, unquote(value)) if len(v) >= _LEAST_OF_ADDRESS)


def _of_variable(name: str, value: str) -> Iterator[str]:
    words = name.upper().split('_')
    if any(map(_TELLING.fullmatch, words)) and len(value) >= _LEAST_OF_VARIABLE:
        yield value
    if any(map(_HEADERS.fullmatch, words)):
        yield from (w for w in _WORDS.findall(value) if len(w) >= _LEAST_OF_VARIABLE)
    if '://' in value and '@' in value:
        yield from _of_address(value)


def _forms(secret: str) -> Iterator[str]:
    """Yield a secret as it may be written."""
    yield secret
    yield from (quote(secret), quote(secret, safe=''))
    yield json.dumps(secret)[1:-1]
