# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.stl.worker TASK.json`: one tool, one cell, in a process of its own.

Runs in the environment of the rivals too, which has none of the product's packages: only numpy
and the standard library may be imported here.
"""

from __future__ import annotations

import json
import sys
import time
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np

from aurora_bench.stl.cells import Cell, Kind
from aurora_bench.stl.tools import TOOLS, Floats, NotInToolError

_SEED = 4
# Repeated until this time is over: short calls often, long ones once.
_ENOUGH_S = 0.5
_FEW, _MANY = 5, 200


def trace(samples: int) -> tuple[Floats, Floats]:
    """Return the signals of a cell: noise on a slow one, and noise.

    Values differ from sample to sample, and in `x until y` either side decides now and then.
    """
    chance = np.random.default_rng((_SEED, samples))
    slow = np.convolve(chance.normal(size=samples + 49), np.full(50, 0.2), mode='valid')
    return slow + chance.normal(2.0, 1.0, samples), chance.normal(0.0, 1.0, samples)


def measure(tool: str, cell: Cell) -> tuple[dict[str, Any], Floats]:
    """Time a tool.

    Returns:
        Version, seconds of each repetition; and its values.

    Raises:
        NotInToolError: It has no such formula.
    """
    distribution, prepare = TOOLS[tool]
    timed = prepare(cell, *trace(cell.samples))
    seconds: list[float] = []
    while len(seconds) < _MANY and (len(seconds) < _FEW or sum(seconds) < _ENOUGH_S):
        begin = time.perf_counter()
        values = timed()
        seconds.append(time.perf_counter() - begin)
        if sum(seconds) > 4 * _ENOUGH_S:
            break
    found = np.asarray(values, dtype=float)
    try:
        known = version(distribution)
    except PackageNotFoundError:
        known = ''
    return {'version': known, 'seconds': seconds}, found


def main(task: Path) -> int:
    """Measure as the file says; write `<task>.npy` and say the rest on standard output."""
    given = json.loads(task.read_text(encoding='utf-8'))
    cell = Cell(kind=Kind(given['kind']), samples=given['samples'], window=given['window'])
    try:
        document, values = measure(given['tool'], cell)
    except NotInToolError as err:
        document, values = {'absent': str(err)}, np.empty(0)
    np.save(task.with_suffix('.npy'), values)
    sys.stdout.write(json.dumps(document) + '\n')
    return 0


if __name__ == '__main__':
    sys.exit(main(Path(sys.argv[1])))
