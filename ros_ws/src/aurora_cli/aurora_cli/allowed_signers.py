# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Lines of public keys: `<key>.pub` and `allowed_signers` of OpenSSH.

The format is that of ssh-keygen(1), ALLOWED SIGNERS: names of signers, options, a key, a comment.
What stands beside a key limits what it may vouch for, so nothing there is passed over: what
is not known here makes the file unusable.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime

NAMESPACE = 'aurora'

# Blanks and commas inside quotes separate nothing.
_FIELD = re.compile(r'\s*((?:"[^"]*"|[^\s"])+)(?=\s|$)')
_OPTION = re.compile(r'(?:"[^"]*"|[^,"])+')
_KEY_TYPE = re.compile(r'(ssh|ecdsa|sk)-\S+')
_TIME = re.compile(r'\d{8}(\d{4}(\d\d)?)?')


class KeyLineError(ValueError):
    """A line that cannot be used; the text says which, and why."""


@dataclass(frozen=True, slots=True)
class KeyLine:
    """One key.

    Attributes:
        number: Of the line, from 1.
        key: Type and base64, as OpenSSH writes a public key.
        unfit: Why it vouches for nothing now, None when it does.
    """

    number: int
    key: str
    unfit: str | None = None


def key_lines(text: str, now: datetime) -> Iterator[KeyLine]:
    """Give the keys of a file, in its order.

    Args:
        text: Of the file.
        now: With a time zone; in it times without one are meant.

    Raises:
        KeyLineError: A line has a marker, an unknown option, or no key.
    """
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip() or line.lstrip().startswith('#'):
            continue
        try:
            key, options = _parts(line)
            yield KeyLine(number, key, _unfit(options, now))
        except KeyLineError as err:
            raise KeyLineError(f'line {number} {err}') from None


def _parts(line: str) -> tuple[str, str]:
    """Return key and options of a line."""
    before: list[str] = []
    at = 0
    while found := _FIELD.match(line, at):
        if _KEY_TYPE.fullmatch(found[1]):
            break
        before.append(found[1])
        at = found.end()
    if before and before[0].startswith('@'):
        raise KeyLineError(f'has the marker {before[0]}: no key beside one is trusted')
    base64 = _FIELD.match(line, found.end()) if found else None
    if found is None or base64 is None or len(before) > 2:
        raise KeyLineError('holds no public key as ssh-keygen writes it')
    if before and ('=' in before[0] or before[0].lower() == 'cert-authority'):
        raise KeyLineError(f'begins with the option {before[0]}: names of signers come first')
    return f'{found[1]} {base64[1]}', before[1] if len(before) > 1 else ''


def _unfit(options: str, now: datetime) -> str | None:
    """Return why a key with these options vouches for nothing now."""
    seen: dict[str, str] = {}
    for option in _OPTION.findall(options):
        name, _, value = option.partition('=')
        name = name.lower()
        if name not in ('namespaces', 'valid-after', 'valid-before') or name in seen:
            raise KeyLineError(
                f'has the option {name}, which is not known here or stands there twice; known '
                'are namespaces, valid-after and valid-before'
            )
        seen[name] = value.strip('"')
    if NAMESPACE not in seen.get('namespaces', NAMESPACE).split(','):
        return f'is for the namespaces {seen["namespaces"]}, not for {NAMESPACE}'
    if 'valid-after' in seen and now < _time(seen['valid-after'], now):
        return f'is valid after {seen["valid-after"]} only'
    if 'valid-before' in seen and now >= _time(seen['valid-before'], now):
        return f'was valid before {seen["valid-before"]}'
    return None


def _time(value: str, now: datetime) -> datetime:
    digits = value.removesuffix('Z')
    try:
        if not _TIME.fullmatch(digits):
            raise ValueError(value)
        moment = datetime.strptime(digits.ljust(14, '0'), '%Y%m%d%H%M%S')
    except ValueError:
        raise KeyLineError(f'has the time {value}, which is none: YYYYMMDD[HHMM[SS]][Z]') from None
    return moment.replace(tzinfo=UTC if digits != value else now.tzinfo)
