# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Names of language models as people give them: into every record, so they hold no secret."""

from __future__ import annotations

import re

# The parser of rules: no model, no key, no network.
OFFLINE = 'offline'
# What is recorded is named by a path, which may hold any character.
RECORDED = 'recorded:'

_HIDDEN = '***'
# `@http` separates a model from its address; another `@` behind `://` ends user and password.
_USER = re.compile(r'(://)(?:(?!@https?://).)*@(?!https?://)', re.IGNORECASE | re.DOTALL)
# The same without a scheme, `provider/model@user:password@host`.
_BARE_USER = re.compile(r'@[^@,/]*@(?!https?://)', re.IGNORECASE)
_REST = re.compile(r'[?#].*', re.DOTALL)


def without_secrets(named: str) -> str:
    """Return a name, or several, with what may be a secret in an address taken out.

    Args:
        named: A `--model` as given: names with or without address, between commas.
    """
    if named.startswith(RECORDED):
        return named
    shown = _USER.sub(rf'\1{_HIDDEN}@', named)
    shown = _BARE_USER.sub(f'@{_HIDDEN}@', shown)
    return _REST.sub(f'?{_HIDDEN}', shown)


def check_no_secret(named: str) -> str:
    """Return a name that may be recorded.

    Raises:
        ValueError: An address in it has a user, a password, a query or a fragment; the message
            holds none of them.
    """
    shown = without_secrets(named)
    if shown != named:
        raise ValueError(
            f'the address in {shown} holds a user, a password or a query, and names of models '
            'are recorded: give the key in the environment (OPENAI_API_KEY and the like), or the '
            'whole address in config/models.yaml under a name of its own'
        )
    return named
