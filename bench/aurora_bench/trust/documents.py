# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""R9: a damaged document is refused with a reason, quickly."""

from __future__ import annotations

import contextlib
import io
import json
import random
import time
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

from aurora_bench.trust.part import Counter, Found
from aurora_cli.main import run_command_line
from aurora_core.agsg.document import agsg_from_json
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import Verdict
from aurora_core.report.manifest import Manifest
from aurora_core.report.run_documents import Unreadable, read_document
from aurora_core.report.run_report import RunReport
from aurora_core.spec.scenario import ScenarioSpec

_LIMIT_S = 1.0
PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.'
)
_Reader = Callable[[Path], Any]
_KINDS: dict[str, _Reader] = {
    'spec.0.json': lambda path: read_document(path, ScenarioSpec),
    'agsg.0.json': lambda path: read_document(path, Agsg, agsg_from_json),
    'verdict.0.json': lambda path: read_document(path, Verdict),
    'report.json': lambda path: read_document(path, RunReport),
    'manifest.json': lambda path: read_document(path, Manifest),
}
_VALUES: tuple[Any, ...] = (
    None, True, -1, 0, 1e308, -1e-308, 2**63, 10**400, '', 'x' * 10_000, '../../etc/passwd',
    '\x1b[2J', '\u202e', [], {}, [[]], {'kind': 'x'}, 'NaN', float('inf'),
)  # fmt: skip


def quiet_run(folder: Path, *options: str) -> tuple[int, dict[str, Any]]:
    """Run the usual prompt; return exit code and report."""
    answer = io.StringIO()
    with contextlib.redirect_stdout(answer), contextlib.redirect_stderr(io.StringIO()):
        code = run_command_line(['run', PROMPT, '--json', '--out', str(folder), *options])
    return code, json.loads(answer.getvalue())


@cache
def _originals(folder: Path) -> dict[str, Any]:
    _, report = quiet_run(folder)
    run = folder / report['run_id']
    return {name: json.loads((run / name).read_text('utf-8')) for name in _KINDS}


def documents(first: int, count: int, folder: Path) -> Found:
    """Damage the documents of a run; each is refused or read within a second, nothing raises."""
    originals = _originals(folder)
    counter = Counter()
    names = tuple(_KINDS)
    for number in range(first, first + count):
        rng = random.Random(number)
        name = names[number % len(names)]
        path = folder / name
        path.write_bytes(_damaged(rng, originals[name]))
        begun_s = time.process_time()
        try:
            found = _KINDS[name](path)
            problem = ''
            if isinstance(found, Unreadable) and name not in found.why:
                problem = f'{name} {number}: the reason does not name it: {found.why}'
        except Exception as err:  # noqa: BLE001  (whatever it is, it is what is looked for)
            problem = f'{name} {number}: {type(err).__name__}: {err}'
        took_s = time.process_time() - begun_s
        counter.figure('slowest [s]', round(took_s, 3))
        if took_s > _LIMIT_S:
            problem = problem or f'{name} {number} took {took_s:.2f} s'
        counter.add(problem)
    return counter.found()


def _damaged(rng: random.Random, original: Any) -> bytes:
    kind = rng.randrange(8)
    if kind >= 2:
        document = json.loads(json.dumps(original))
        for _ in range(rng.randrange(1, 4)):
            _change(rng, document)
        text = json.dumps(document)
        return text.encode('utf-8', 'surrogatepass')
    data = bytearray(json.dumps(original).encode())
    if kind == 0:
        del data[rng.randrange(len(data)) :]
    else:
        for _ in range(rng.randrange(1, 6)):
            data[rng.randrange(len(data))] = rng.randrange(256)
    return bytes(data)


def _change(rng: random.Random, document: Any) -> None:
    """Change, remove or add one value somewhere."""
    places = list(_places(document))
    inside, key = rng.choice(places)
    kind = rng.randrange(4)
    if kind == 0:
        del inside[key]
    elif kind == 1 and isinstance(inside, dict):
        inside[f'x{rng.randrange(10)}'] = rng.choice(_VALUES)
    elif kind == 2:
        deep: Any = rng.choice(_VALUES)
        for _ in range(rng.randrange(200)):
            deep = [deep]
        inside[key] = deep
    else:
        inside[key] = rng.choice(_VALUES)


def _places(node: Any) -> Iterator[tuple[Any, Any]]:
    items = node.items() if isinstance(node, dict) else enumerate(node)
    for key, value in list(items):
        yield node, key
        if isinstance(value, dict | list):
            yield from _places(value)
