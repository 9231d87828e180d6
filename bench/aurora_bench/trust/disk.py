# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""R18: a full disk ends a run as an error that says so; what was there before stays."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

from aurora_bench.trust.documents import PROMPT, quiet_run
from aurora_bench.trust.part import Counter, Found

_STEP_KIB = 24
_LIMIT_S = 120
_ROOM_KIB = 8192
_COMMAND = 'from aurora_cli.main import main; main()'
# In a mount namespace of its own, as the user in a user namespace: a small disk, all of it taken
# but for what is left. Prints what a later look at the disk shows.
_ON_A_SMALL_DISK = """
set -eu
mount -t tmpfs -o size={room}k,mode=700 none "$DISK"
cp -r "$BEFORE" "$DISK/runs"
used=$(du -sk "$DISK" | cut -f1)
fill=$(({room} - used - {left}))
[ "$fill" -le 0 ] || head -c "${{fill}}k" /dev/zero > "$DISK/filler"
cd "$DISK"
code=0
"$PYTHON" -c "$COMMAND" run "$PROMPT" --json > "$OUT/answer" 2> "$OUT/said" || code=$?
echo "$code" > "$OUT/code"
cp -r "$DISK/runs" "$OUT/runs"
"""


def full_disk(first: int, count: int, folder: Path) -> Found:
    """Run on disks with more and more room left; each ends rightly or says where it could not.

    A case holds when the exit code is 0 with a whole verified report, or 4 with a message that
    names the disk; every JSON file that is there is whole, and the older run is untouched.
    """
    before = folder / 'before'
    if not before.exists():
        quiet_run(before)
    counter = Counter()
    for number in range(first, first + count):
        out, disk = folder / f'out{number}', folder / 'disk'
        out.mkdir()
        disk.mkdir(exist_ok=True)
        script = _ON_A_SMALL_DISK.format(room=_ROOM_KIB, left=number * _STEP_KIB)
        environment = {
            **os.environ,
            'BEFORE': str(before),
            'COMMAND': _COMMAND,
            'DISK': str(disk),
            'OUT': str(out),
            'PROMPT': PROMPT,
            'PYTHON': sys.executable,
        }
        done = subprocess.run(
            ['unshare', '-Urm', 'sh', '-c', script],
            env=environment,
            capture_output=True,
            timeout=_LIMIT_S,
            check=False,
        )
        if done.returncode != 0:
            counter.add(f'{number * _STEP_KIB} KiB left: {done.stderr.decode()[-200:]}')
            continue
        problem = _problem(out, before)
        counter.add(f'{number * _STEP_KIB} KiB left: {problem}' if problem else '')
    return counter.found()


def _problem(out: Path, before: Path) -> str:
    code = int((out / 'code').read_text())
    said = (out / 'said').read_text()
    older = {p.relative_to(before): p.read_bytes() for p in before.rglob('*') if p.is_file()}
    if any(_bytes(out / 'runs' / name) != data for name, data in older.items()):
        return 'the older run is not what it was'
    for path in (out / 'runs').rglob('*.json'):
        try:
            json.loads(path.read_bytes())
        except ValueError:
            return f'{path.name} is half written'
    if code == 0:
        return ''
    if code != 4:
        return f'exit code {code}: {said[-200:]}'
    answer = (out / 'answer').read_text()
    if 'No space left' not in said + answer:
        return f'the disk is not named: {(said + answer)[-200:]}'
    return ''


def _bytes(path: Path) -> bytes | None:
    return path.read_bytes() if path.is_file() else None
