# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.guided.worker`: one fuzzer in a process of its own.

libFuzzer ends its process itself, so what was found is written as it is found.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import sys
import tempfile
import time
import traceback
from pathlib import Path
from typing import Any

# The edges of upper bounds, s: durations are counted in these.
BOUNDS_S = tuple(0.001 * 1.25**k for k in range(48))
_EVERY = 200
# A hang ends the fuzzer, which leaves the input.
_HANG_S = 30
_PACKAGES = ['aurora_core', 'aurora_cli', 'aurora_uav_sim']


class Tally:
    """Counts inputs and how long they took, and keeps what was found.

    Args:
        path: JSON file.
        last: So many inputs are tried at least.
    """

    def __init__(self, path: Path, last: int) -> None:
        self._path, self._last = path, last
        self._tried = 0
        self._counts = [0] * (len(BOUNDS_S) + 1)
        self._slowest_s = 0.0
        self._found: dict[str, dict[str, str]] = {}

    def took(self, seconds: float) -> None:
        """Count an input."""
        self._tried += 1
        self._slowest_s = max(self._slowest_s, seconds)
        self._counts[next((k for k, b in enumerate(BOUNDS_S) if seconds <= b), -1)] += 1
        if self._tried % _EVERY == 0 or self._tried > self._last - _EVERY:
            self.write()

    def failed(self, err: BaseException, data: bytes) -> None:
        """Keep an input for each place at which something was raised."""
        frames = [f for f in traceback.extract_tb(err.__traceback__) if 'aurora' in f.filename]
        last = frames[-1]
        where = f'{type(err).__name__} at {Path(last.filename).name}:{last.lineno}'
        self._found.setdefault(where, {'says': str(err)[:300], 'input': data.hex()})
        self.write()

    def write(self) -> None:
        """Put it on the disk, whole."""
        told: dict[str, Any] = {
            'tried': self._tried,
            'counts': self._counts,
            'slowest_s': self._slowest_s,
            'found': self._found,
        }
        new = self._path.with_suffix('.new')
        new.write_text(json.dumps(told))
        os.replace(new, self._path)


def main() -> None:
    """Fuzz until so many inputs were tried; never returns."""
    parser = argparse.ArgumentParser()
    parser.add_argument('target')
    parser.add_argument('tally', type=Path)
    parser.add_argument('corpora', nargs='+')
    parser.add_argument('--runs', type=int, required=True)
    parser.add_argument('--seed', type=int, required=True)
    parser.add_argument('--words', type=Path, required=True)
    options = parser.parse_args()
    import atheris

    with atheris.instrument_imports(include=_PACKAGES):
        from aurora_bench.guided.targets import TARGETS
    target = TARGETS[options.target]
    tally = Tally(options.tally, options.runs)
    folder = Path(tempfile.mkdtemp(dir=options.tally.parent)).resolve()
    attempt = target.make(folder)

    def one(data: bytes) -> None:
        begun_s = time.process_time()
        try:
            with open(os.devnull, 'w') as nowhere, contextlib.redirect_stderr(nowhere):
                attempt(data)
        except Exception as err:  # noqa: BLE001  (whatever it is, it is what is looked for)
            tally.failed(err, data)
        tally.took(time.process_time() - begun_s)

    atheris.Setup(
        [
            sys.argv[0],
            f'-runs={options.runs}',
            f'-seed={options.seed}',
            f'-max_len={target.most_bytes}',
            f'-timeout={_HANG_S}',
            *([f'-dict={options.words}'] if options.words.stat().st_size else []),
            f'-artifact_prefix={options.tally.parent}/',
            '-rss_limit_mb=4096',
            '-print_final_stats=1',
            *options.corpora,
        ],
        one,
    )
    atheris.Fuzz()


if __name__ == '__main__':
    main()
