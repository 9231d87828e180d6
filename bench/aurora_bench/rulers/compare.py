# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.rulers.compare BEFORE.json AFTER.json`: what another code changed.

Lists every trial of two results of the same ruler whose status, motion hash or trace hash differs.
Exit code 0: none ended or moved otherwise (trace hashes may differ: they hold conditions' texts).
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from aurora_core.files import DOCUMENT_BYTES, read_json

Trials = Mapping[tuple[str, int], Mapping[str, Any]]
_DECIDING = ('status', 'motion_sha256')


def differences(before: Trials, after: Trials, fields: Sequence[str]) -> Iterator[str]:
    """Yield a line for each trial that both have and that differs in one of the fields."""
    for key in before:
        old, new = before[key], after.get(key, before[key])
        changed = [name for name in fields if old.get(name, '') != new.get(name, '')]
        if changed:
            told = ', '.join(f'{n} {_short(old.get(n))} -> {_short(new.get(n))}' for n in changed)
            yield f'{key[0]} seed {key[1]}: {told}'


def _short(value: object) -> str:
    return str(value)[:12] or 'none'


def _read(path: Path) -> Trials:
    document = read_json(path, DOCUMENT_BYTES)
    return {(trial['id'], trial['seed']): trial for trial in document['trials']}


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare two results and return 1 when a trial ended or moved otherwise."""
    parser = argparse.ArgumentParser(prog='aurora_bench.rulers.compare')
    parser.add_argument('before', type=Path)
    parser.add_argument('after', type=Path)
    options = parser.parse_args(arguments)
    before, after = _read(options.before), _read(options.after)
    found = list(differences(before, after, _DECIDING))
    sys.stdout.writelines(f'{text}\n' for text in found)
    both = [key for key in before if key in after]
    moved = sum(1 for key in both if before[key].get('motion_sha256'))
    traces = len(list(differences(before, after, ('trace_sha256',))))
    sys.stdout.write(
        f'{len(both)} trials in both, {moved} with a motion hash: {len(found)} ended or moved '
        f'otherwise, {traces} with another trace hash\n'
    )
    return int(bool(found) or not both)


if __name__ == '__main__':
    sys.exit(main())
